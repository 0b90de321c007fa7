"""How long the checks wait for other processes."""

from __future__ import annotations

#: Longest wall time for anything that has to happen at all, s: nodes find each other late on a busy machine.
PATIENCE = 180.0
