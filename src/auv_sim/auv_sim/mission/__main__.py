"""`python -m auv_sim.mission`: the same as `scripts/mission.py`, where the packages are installed already."""

from __future__ import annotations

from auv_sim.mission.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
