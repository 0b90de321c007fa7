"""One row of the table of faults, and the rows that topics of a kind have in common."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

from auv_msgs_py.contract import topics
from auv_sim.sim_parameters import Fault

#: What a busy machine may add to every bound, s of wall time; in ROS time `speed` times as much.
MACHINE_DELAY = 0.25
#: Faults of the hull: it takes in water, or loses weight.
Ballast = Literal["heavy", "light"]
Kind = Fault | Ballast | Literal["kill"]
#: The flight that is spoiled: in the plane, at the depths of a profile, or above the bottom.
Flight = Literal["plane", "dive", "bottom"]

#: goes on     the mission does not stop.
#: stops       the vehicle is stopped, and goes on when the fault is over.
#: holds       guidance holds, and goes on from there when the fault is over.
#: aborts      the mission ends, and the vehicle is stopped.
#: waits       the vehicle is stopped until the mission is started again.
Outcome = Literal["goes on", "stops", "holds", "aborts", "waits"]


class Expectation(NamedTuple):
    """One row: a fault and the required reaction.

    Attributes:
        place: the topic, or the node that is killed.
        fault: what is done to it.
        noticed_by: the node that names it in /diagnostics; empty where it looks like normal operation.
        says: part of its report.
        within: latest time of that report, s of ROS time after the fault began.
        outcome: what becomes of the mission.
        safe: latest time at which rudder and thrust are 0, s of ROS time; 0: they need not be.
        set_by: the parameters that set the bounds.
        lasts: duration of the fault, s of ROS time.
        delay: of the fault `delay`, s.
        then_abort: the matrix calls `abort` meanwhile, and the bounds count from there.
        wall: whether `within` is s of wall time, for faults in which the ROS clock may stand still.
        flight: that is spoiled.
        also: a further topic that is stopped meanwhile.
        surfaces: whether the vehicle is at the surface when the mission has ended.
    """

    place: str
    fault: Kind
    noticed_by: str
    says: str
    within: float
    outcome: Outcome
    safe: float = 0.0
    set_by: str = ""
    lasts: float = 3.0
    delay: float = 2.0
    then_abort: bool = False
    wall: bool = False
    flight: Flight = "plane"
    also: str = ""
    surfaces: bool = False

    @property
    def name(self) -> str:
        """The name by which a row is printed and chosen."""
        return f"{self.place} {self.fault}" + (" then abort" if self.then_abort else "")


#: What the rows of a flood have in common.
FLOOD: dict[str, Any] = {"within": 1.5, "outcome": "goes on", "set_by": "flood_rate", "wall": True}


def of_reference(place: str, flight: Flight = "plane") -> list[Expectation]:
    """Return the rows of a reference of guidance; but for `freeze`."""
    stops: dict[str, Any] = {"outcome": "stops", "safe": 0.6, "set_by": "reference_timeout"}
    rows = [
        Expectation(place, "stop", topics.AUTOPILOT, "guidance is silent", 0.6, **stops),
        Expectation(place, "delay", topics.AUTOPILOT, "guidance is silent", 0.6, **stops),
        Expectation(place, "nan", topics.AUTOPILOT, f"{place}: found nan", 0.1, **stops),
        Expectation(place, "cut", topics.AUTOPILOT, "bytes that do not decode", 0.1, **stops),
        Expectation(place, "jump", topics.AUTOPILOT, "expected from", 0.1, **stops),
        Expectation(place, "reverse", "", "", 0.0, "goes on"),
        Expectation(place, "flood", topics.AUTOPILOT, f"{place} comes at", **FLOOD),
    ]
    return [row._replace(flight=flight) for row in rows]


def of_command(place: str, flight: Flight = "plane") -> list[Expectation]:
    """Return the rows of a command of the autopilot; but for `freeze`."""
    stops: dict[str, Any] = {"outcome": "stops", "safe": 1.1, "set_by": "command_timeout"}
    rows = [
        Expectation(place, "stop", topics.PLANT, f"no {place}", 1.1, **stops),
        Expectation(place, "delay", topics.PLANT, f"no {place}", 1.1, **stops),
        Expectation(place, "nan", topics.PLANT, f"{place}: found nan", 0.1, **stops),
        Expectation(place, "cut", topics.PLANT, "bytes that do not decode", 0.1, **stops),
        Expectation(place, "jump", topics.PLANT, "expected from", 0.1, **stops),
        Expectation(place, "reverse", "", "", 0.0, "goes on"),
        Expectation(place, "flood", topics.PLANT, f"{place} comes at", **FLOOD),
    ]
    return [row._replace(flight=flight) for row in rows]
