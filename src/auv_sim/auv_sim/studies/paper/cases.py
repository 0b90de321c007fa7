"""The paper's three cases, and the flights beside them, by name."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from auv_path_following.missions import mission_file
from auv_sim.studies.paper.paper_flights import MISSION, PaperFlight
from auv_sim.studies.paper.variants import PLANT_NAMES

#: The paper's current of case 3, m/s, NED.
CURRENT = (0.1, 0.2)
#: Case 1 starts so far to starboard of the path, m: the paper does not say where.
OFFSET = 5.0
#: Heading laws that are compared: name -> (parameter file, controller).
LAWS = {
    "nism": ("paper", "nism"),
    "pid": ("paper", "pid"),
    "smc": ("paper", "smc"),
    "robust": ("robust", "nism"),
}
LAW_LABELS = {"nism": "NISM (Table 4)", "pid": "PID", "smc": "SMC", "robust": "NISM, shaped reference"}


def beside(offset: float) -> tuple[float, float, float]:
    """`offset` metres to starboard of the path's start, heading along it."""
    x, y, chi = mission_file.load(MISSION).path.start_pose
    return x - offset * math.sin(chi), y + offset * math.cos(chi), chi


def flights(step: float, time_limit: float = 1500.0) -> dict[str, PaperFlight]:
    """Every flight of the reproduction.

    Args:
        step: time between odometries, s.
        time_limit: every flight ends here at the latest, s.
    """
    found: list[PaperFlight] = []
    aside = beside(OFFSET)
    for plant in PLANT_NAMES:
        for law, (params, controller) in LAWS.items():
            common: dict[str, Any] = {
                "plant": plant,
                "params": params,
                "controller": controller,
                "step": step,
            }
            found.append(PaperFlight(name=f"1-{law}-{plant}", switching="off", start=aside, **common))
            if law in ("nism", "robust") or plant != "table2":
                found.append(PaperFlight(name=f"2-{law}-{plant}", **common))
        found.append(PaperFlight(name=f"1-on-path-{plant}", plant=plant, switching="off", step=step))
    case_3: tuple[tuple[str, str | None, str, bool], ...] = (
        ("with", None, "paper", True),
        ("without", None, "paper", False),
        ("robust", None, "robust", True),
        ("los", "los", "robust", True),
        ("ilos", "ilos", "robust", True),
    )
    for name, guidance, params, compensated in case_3:
        found.append(
            PaperFlight(
                name=f"3-{name}",
                params=params,
                law=guidance,
                compensated=compensated,
                current=CURRENT,
                step=step,
            )
        )
    found.append(PaperFlight(name="3-aside", start=aside, current=CURRENT, step=step))
    # What the paper leaves to others: Delta and kp by themselves.
    adaptive = {"guidance": {"ailos.adaptive.enabled": True}}
    rate = {"autopilot": {"nism.kp_from_rudder": True}}
    found.append(
        PaperFlight(name="4-lookahead", params="robust", changes=adaptive, current=CURRENT, step=step)
    )
    found.append(
        PaperFlight(name="4-lookahead-aside", params="robust", changes=adaptive, start=aside, step=step)
    )
    found.append(PaperFlight(name="4-fixed-aside", params="robust", start=aside, step=step))
    for plant in PLANT_NAMES:
        found.append(
            PaperFlight(
                name=f"4-kp-{plant}", plant=plant, switching="off", start=aside, changes=rate, step=step
            )
        )
    return {flight.name: dataclasses.replace(flight, time_limit=time_limit) for flight in found}
