"""What the compiled flight reads: the fields of the suite's settings as plain numbers, by the same names.

A law that only reads `config.k1` cannot tell such a tuple from the settings object it was made from, so one
function serves both. Words (which law, which controller) become their index.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_path_following.control.autopilot import Autopilot
from auv_path_following.guidance.follow import FollowerConfig
from auv_sim.plant.remus import Plant


class Flight(NamedTuple):
    """One flight: everything that decides its course but its path.

    Attributes:
        plant, guidance, observer, autopilot: as above.
        thrust: what the autopilot orders while the mission runs, N.
        Vx, Vy: current, m/s, NED.
        dt: between two odometries, s.
        steps: at most so many odometries.
    """

    plant: Plant
    guidance: FollowerConfig
    observer: Any
    autopilot: Autopilot
    thrust: float
    Vx: float
    Vy: float
    dt: float
    steps: int
