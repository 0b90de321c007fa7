"""The required reaction to each fault: the table that the fault matrix checks the suite against.

docs/safety.md prints it, and a test compares the two.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

from auv_msgs_py.contract import topics
from auv_sim.sim_parameters import Fault

Kind = Fault | Literal["kill"]

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

    @property
    def name(self) -> str:
        """The name by which a row is printed and chosen."""
        return f"{self.place} {self.fault}" + (" then abort" if self.then_abort else "")


_E = Expectation
_GUIDANCE, _AUTOPILOT, _PLANT, _OBSERVER = topics.GUIDANCE, topics.AUTOPILOT, topics.PLANT, topics.OBSERVER
_FLOOD: dict[str, Any] = {"within": 1.5, "outcome": "goes on", "set_by": "flood_rate", "wall": True}


def _odom(fault: Kind, says: str, within: float = 0.1, safe: float = 0.6, **more: Any) -> Expectation:
    more = {"set_by": "odometry_timeout, holding.hold_after", "outcome": "holds", **more}
    return _E("odom", fault, _AUTOPILOT, says, within=within, safe=safe, **more)


def _water(fault: Kind, says: str, within: float = 0.1, **more: Any) -> Expectation:
    more = {"set_by": "water_velocity_timeout, holding.hold_after", "outcome": "holds", **more}
    return _E("velocity_through_water", fault, _GUIDANCE, says, within=within, safe=2.2, lasts=4.0, **more)


def _current(fault: Kind, says: str, within: float = 0.1, **more: Any) -> Expectation:
    more = {"set_by": "gate.current" if says else "", **more}
    within = within if says else 0.0
    return _E(
        "current_estimate", fault, _GUIDANCE if says else "", says, within=within, outcome="goes on", **more
    )


def _reference(place: str) -> list[Expectation]:
    stops: dict[str, Any] = {"outcome": "stops", "safe": 0.6, "set_by": "reference_timeout"}
    return [
        _E(place, "stop", _AUTOPILOT, "guidance is silent", 0.6, **stops),
        _E(place, "delay", _AUTOPILOT, "guidance is silent", 0.6, **stops),
        _E(place, "nan", _AUTOPILOT, f"{place}: found nan", 0.1, **stops),
        _E(place, "cut", _AUTOPILOT, "bytes that do not decode", 0.1, **stops),
        _E(place, "jump", _AUTOPILOT, "expected from", 0.1, **stops),
        _E(place, "reverse", "", "", 0.0, "goes on"),
        _E(place, "flood", _AUTOPILOT, f"{place} comes at", **_FLOOD),
    ]


def _command(place: str) -> list[Expectation]:
    stops: dict[str, Any] = {"outcome": "stops", "safe": 1.1, "set_by": "command_timeout"}
    return [
        _E(place, "stop", _PLANT, f"no {place}", 1.1, **stops),
        _E(place, "delay", _PLANT, f"no {place}", 1.1, **stops),
        _E(place, "nan", _PLANT, f"{place}: found nan", 0.1, **stops),
        _E(place, "cut", _PLANT, "bytes that do not decode", 0.1, **stops),
        _E(place, "jump", _PLANT, "expected from", 0.1, **stops),
        _E(place, "reverse", "", "", 0.0, "goes on"),
        _E(place, "flood", _PLANT, f"{place} comes at", **_FLOOD),
    ]


_OFF_PATH: dict[str, Any] = {
    "outcome": "aborts", "safe": 90.0, "set_by": "limits.path_distance, limits.path_speed", "lasts": 90.0,
}  # fmt: skip

TABLE: tuple[Expectation, ...] = (
    _odom("stop", "no usable odom", within=0.6),
    _odom("delay", "no usable odom", within=0.6, lasts=4.0),
    _odom("nan", "found x="),
    _odom(
        "freeze",
        "the same pose for",
        within=2.1,
        safe=2.7,
        lasts=5.0,
        set_by="gate.frozen_after, odometry_timeout, holding.hold_after",
    ),
    _odom(
        "jump",
        "from the last accepted one",
        lasts=2.5,
        set_by="gate.position_margin, odometry_timeout, holding.hold_after",
    ),
    _odom("reverse", "odom: found a stamp"),
    _odom("frameless", "frame_id ''"),
    _odom("timeless", "odom: found a stamp of"),
    _odom("cut", "bytes that do not decode"),
    _E("odom", "flood", _AUTOPILOT, "odom comes at", **_FLOOD),
    _water("stop", "no fresh velocity_through_water", within=1.1),
    _water("delay", "no fresh velocity_through_water", within=1.1),
    _water("nan", "velocity_through_water: found (nan"),
    _E("velocity_through_water", "freeze", "", "", 0.0, "goes on"),
    _water(
        "jump",
        "velocity_through_water: found (10",
        set_by="gate.current, water_velocity_timeout, holding.hold_after",
    ),
    _water("reverse", "velocity_through_water: found a stamp"),
    _water("frameless", "velocity_through_water: found frame_id ''"),
    _water("timeless", "velocity_through_water: found a stamp of"),
    _water("cut", "bytes that do not decode"),
    _E("velocity_through_water", "flood", _GUIDANCE, "velocity_through_water comes at", **_FLOOD),
    _current("stop", "no fresh current_estimate", within=5.2, lasts=6.0, set_by="current_timeout"),
    _current(
        "delay", "no fresh current_estimate", within=5.2, delay=6.0, lasts=8.0, set_by="current_timeout"
    ),
    _current("nan", "current_estimate: found"),
    _current("freeze", ""),
    _current("jump", "current_estimate: found"),
    _current("reverse", "current_estimate: found a stamp"),
    _current("frameless", "current_estimate: found frame_id ''"),
    _current("timeless", "current_estimate: found a stamp of"),
    _current("cut", "bytes that do not decode"),
    _E("current_estimate", "flood", _GUIDANCE, "current_estimate comes at", **_FLOOD),
    *_reference("desired_yaw"),
    _E("desired_yaw", "freeze", _GUIDANCE, "limit path_", 90.0, **_OFF_PATH),
    *_reference("desired_yaw_rate"),
    _E("desired_yaw_rate", "freeze", "", "", 0.0, "goes on"),
    *_reference("desired_thrust"),
    _E("desired_thrust", "freeze", "", "", 0.0, "goes on"),
    _E(
        "desired_thrust",
        "freeze",
        _AUTOPILOT,
        "though the mission is aborted",
        0.7,
        "aborts",
        0.7,
        "reference_timeout",
        then_abort=True,
    ),
    *_command("rudder_cmd"),
    _E("rudder_cmd", "freeze", _GUIDANCE, "limit path_", 90.0, **_OFF_PATH),
    *_command("thrust_cmd"),
    _E("thrust_cmd", "freeze", "", "", 0.0, "goes on"),
    _E("thrust_cmd", "freeze", _GUIDANCE, "aborted: abort was called", 0.1, "aborts", 0.1, then_abort=True),
    _E("mission_state", "stop", _GUIDANCE, "aborted: abort was called", 0.1, "aborts", 0.2, then_abort=True),
    _E("mission_state", "delay", _GUIDANCE, "aborted: abort was called", 0.1, "aborts", 0.2, then_abort=True),
    _E("mission_state", "nan", _AUTOPILOT, "mission_state: found 'nan'", 0.1, "aborts", 0.2, then_abort=True),
    _E("mission_state", "cut", _AUTOPILOT, "bytes that do not decode", 0.1, "aborts", 0.2, then_abort=True),
    _E("mission_state", "forge", _AUTOPILOT, "'complete' once among 'running'", 2.5, "goes on", wall=True),
    _E(
        "mission_state", "freeze", _GUIDANCE, "aborted: abort was called", 0.1, "aborts", 0.2, then_abort=True
    ),
    _E("mission_state", "flood", _GUIDANCE, "aborted: abort was called", 0.1, "aborts", 0.2, then_abort=True),
    _E(
        _OBSERVER,
        "kill",
        _GUIDANCE,
        "no fresh current_estimate",
        5.2,
        "goes on",
        set_by="current_timeout",
        lasts=6.0,
    ),
    _E(_AUTOPILOT, "kill", _PLANT, "no rudder_cmd", 1.1, "stops", 1.1, "command_timeout"),
    _E(_GUIDANCE, "kill", _AUTOPILOT, "guidance is silent", 0.6, "waits", 0.6, "reference_timeout"),
    _E(topics.RECORDER, "kill", "", "", 0.0, "goes on"),
    _E(_PLANT, "kill", _GUIDANCE, "the clock stands still", 4.0, "goes on", wall=True),
)
#: What the tests run: one of each way to notice and of each outcome.
REPRESENTATIVE = (
    "odom jump", "odom stop", "velocity_through_water reverse", "desired_yaw nan",
    "rudder_cmd stop", "mission_state forge", "thrust_cmd freeze then abort", "heading_autopilot kill",
    "ailos_guidance kill",
)  # fmt: skip


def chosen(names: tuple[str, ...]) -> list[Expectation]:
    """Return the rows of these names, in the table's order.

    Raises:
        KeyError: there is no such row.
    """
    by_name = {row.name: row for row in TABLE}
    names_chosen = {by_name[name].name for name in names}
    return [row for row in TABLE if row.name in names_chosen]


def as_markdown() -> str:
    """Return the table as docs/safety.md prints it."""
    lines = [
        "| place | fault | noticed by | within (s) | stopped (s) | mission | set by |",
        "| --- | --- | --- | ---: | ---: | --- | --- |",
    ]
    for row in TABLE:
        fault = row.fault + (", then `abort`" if row.then_abort else "")
        within = f"{row.within:g}{' of wall time' if row.wall else ''}" if row.noticed_by else "-"
        set_by = ", ".join(f"`{name}`" for name in row.set_by.split(", ") if name)
        lines.append(
            f"| `{row.place}` | {fault} | {row.noticed_by or '-'} | {within} |"
            f" {f'{row.safe:g}' if row.safe else '-'} | {row.outcome} | {set_by} |"
        )
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(as_markdown(), end="")
