"""Which joints of a path have a circle of acceptance, Eq. (44): the words of files and options."""

from __future__ import annotations

from typing import Literal, get_args

#: No joint, corners (G0) only, or every joint.
SwitchingMode = Literal["off", "g0", "all"]
#: The same in their order; pure steps have the index.
MODES: tuple[SwitchingMode, ...] = get_args(SwitchingMode)
OFF, ONLY_CORNERS, ALL_JOINTS = range(len(MODES))
#: How the text of a setting or an option lists them.
LISTED = "off, g0 (corners only) or all"
