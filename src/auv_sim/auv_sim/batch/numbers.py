"""What the compiled flight reads: the fields of the suite's settings as plain numbers, by the same names.

A law that only reads `config.k1` cannot tell such a tuple from the settings object it was made from, so one
function serves both. Words (which law, which controller) become their index.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_path_following.control.autopilot import Autopilot
from auv_path_following.guidance.acceptance import Cornering
from auv_sim.plant.remus import Plant

SWITCHING = ("off", "g0", "all")


class Guidance(NamedTuple):
    """`PathFollowerConfig` and `Agility`; `law` is the chosen law's configuration, with its first state;
    `switching` is an index of `SWITCHING`.

    `lookahead` is `PathFollowerConfig.lookahead`, which the law may not use at every distance.
    """

    law: Any
    law_begins: Any
    compensate_current: bool
    minimum_speed: float
    k: float
    saturation: float
    approach_radius: float
    turn_rate: float
    switching: int
    radius: float
    cornering: Cornering
    lookahead: float


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
    guidance: Guidance
    observer: Any
    autopilot: Autopilot
    thrust: float
    Vx: float
    Vy: float
    dt: float
    steps: int
