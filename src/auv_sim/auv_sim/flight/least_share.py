"""The least share of its path that a mission has to fly."""

from __future__ import annotations

from typing import Final

#: A mission of which a smaller share was flown is incomplete.
LEAST_SHARE: Final = 0.99
#: The same at sea, where the vehicle's own navigation may be off by more than `flown_share.REACH`.
LEAST_SHARE_AT_SEA: Final = 0.8
