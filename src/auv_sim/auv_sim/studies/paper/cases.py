"""The flights of the reproduction by name: the paper's three cases, and extensions."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from typing import Any

from auv_path_following.missions import mission_file
from auv_sim.studies.paper.paper_flights import MISSION, PaperFlight
from auv_sim.studies.paper.variants import PLANT_NAMES

Start = tuple[float, float, float]

#: The paper's current of case 3, m/s, NED.
CURRENT = (0.1, 0.2)
#: Case 1's start to starboard of the path, m: the paper does not give it.
OFFSET = 5.0
#: Heading laws that are compared: name -> (parameter file, controller).
LAWS = {
    "nism": ("paper", "nism"),
    "pid": ("paper", "pid"),
    "smc": ("paper", "smc"),
    "robust": ("robust", "nism"),
}
LAW_LABELS = {"nism": "NISM (Table 4)", "pid": "PID", "smc": "SMC", "robust": "NISM, shaped reference"}


def beside(offset: float) -> Start:
    """Return the start `offset` m to starboard of the path's, heading along it: x, y (m), psi (rad)."""
    x, y, chi = mission_file.load(MISSION).path.start_pose
    return x - offset * math.sin(chi), y + offset * math.cos(chi), chi


def flights(step: float, time_limit: float = 1500.0) -> dict[str, PaperFlight]:
    """Return every flight of the reproduction by name.

    Args:
        step: time between odometries, s.
        time_limit: every flight ends here at the latest, s.
    """
    aside = beside(OFFSET)
    found = [*_cases_1_and_2(aside), *_case_3(aside), *_extensions(aside)]
    return {flight.name: dataclasses.replace(flight, step=step, time_limit=time_limit) for flight in found}


def _cases_1_and_2(aside: Start) -> Iterator[PaperFlight]:
    """Yield case 1 (no circles of acceptance) and case 2 (with them), on each hull with each heading law."""
    for plant in PLANT_NAMES:
        for law, (params, controller) in LAWS.items():
            common: dict[str, Any] = {"plant": plant, "params": params, "controller": controller}
            yield PaperFlight(name=f"1-{law}-{plant}", switching="off", start=aside, **common)
            if law in ("nism", "robust") or plant != "table2":
                yield PaperFlight(name=f"2-{law}-{plant}", **common)
        yield PaperFlight(name=f"1-on-path-{plant}", plant=plant, switching="off")


def _case_3(aside: Start) -> Iterator[PaperFlight]:
    """Yield case 3: in a current, with and without its compensation, and under other guidance laws."""
    variants: tuple[tuple[str, str | None, str, bool], ...] = (
        ("with", None, "paper", True),
        ("without", None, "paper", False),
        ("robust", None, "robust", True),
        ("los", "los", "robust", True),
        ("ilos", "ilos", "robust", True),
    )
    for name, law, params, compensated in variants:
        yield PaperFlight(name=f"3-{name}", params=params, law=law, compensated=compensated, current=CURRENT)
    yield PaperFlight(name="3-aside", start=aside, current=CURRENT)


def _extensions(aside: Start) -> Iterator[PaperFlight]:
    """Yield what the paper leaves open: the adaptive look-ahead, and kp from the rudder."""
    adaptive = {"guidance": {"ailos.adaptive.enabled": True}}
    rate = {"autopilot": {"nism.kp_from_rudder": True}}
    yield PaperFlight(name="4-lookahead", params="robust", changes=adaptive, current=CURRENT)
    yield PaperFlight(name="4-lookahead-aside", params="robust", changes=adaptive, start=aside)
    yield PaperFlight(name="4-fixed-aside", params="robust", start=aside)
    for plant in PLANT_NAMES:
        yield PaperFlight(name=f"4-kp-{plant}", plant=plant, switching="off", start=aside, changes=rate)
