"""The required reaction to each fault: the table that the fault matrix checks the suite against.

docs/safety.md prints it, and a test compares the two.
"""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract import topics
from auv_sim.checks.faults.fault_row import FLOOD, Expectation, Kind, of_command, of_reference

_E = Expectation
_GUIDANCE, _AUTOPILOT, _PLANT, _OBSERVER = topics.GUIDANCE, topics.AUTOPILOT, topics.PLANT, topics.OBSERVER


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


_OFF_PATH: dict[str, Any] = {
    "outcome": "aborts", "safe": 90.0, "set_by": "limits.path_distance, limits.path_speed", "lasts": 90.0,
}  # fmt: skip

PLANAR: tuple[Expectation, ...] = (
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
    _E("odom", "flood", _AUTOPILOT, "odom comes at", **FLOOD),
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
    _E("velocity_through_water", "flood", _GUIDANCE, "velocity_through_water comes at", **FLOOD),
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
    _E("current_estimate", "flood", _GUIDANCE, "current_estimate comes at", **FLOOD),
    *of_reference("desired_yaw"),
    _E("desired_yaw", "freeze", _GUIDANCE, "limit path_", 90.0, **_OFF_PATH),
    *of_reference("desired_yaw_rate"),
    _E("desired_yaw_rate", "freeze", "", "", 0.0, "goes on"),
    *of_reference("desired_thrust"),
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
    *of_command("rudder_cmd"),
    _E("rudder_cmd", "freeze", _GUIDANCE, "limit path_", 90.0, **_OFF_PATH),
    *of_command("thrust_cmd"),
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

_DIVE: dict[str, Any] = {"flight": "dive"}


def _by_gate(bound: str) -> dict[str, Any]:
    return {"set_by": f"depth_gate.{bound}, odometry_timeout, holding.hold_after", **_DIVE}


def _ends(place: str, fault: Kind, says: str, within: float, set_by: str, **more: Any) -> Expectation:
    """A limit of the dive ends the mission."""
    more = {"safe": within, "lasts": within, "set_by": set_by, "outcome": "aborts", **_DIVE, **more}
    return _E(place, fault, _GUIDANCE, says, within, **more)


_DIVING = "diving.depth_patience, diving.pitch_deg"
#: The rows of a vehicle that dives. A hull that takes in water shows it in a hold, which `also` brings about.
DIVING: tuple[Expectation, ...] = (
    _odom("depth_nan", "found x=", **_DIVE),
    _odom("depth_jump", "a depth ", lasts=2.5, **_by_gate("depth_margin")),
    _odom("depth_turn", "above the surface", **_by_gate("above_surface")),
    _odom("planar", "exactly 0", within=3.3, safe=3.9, lasts=6.0, **_by_gate("flat_after")),
    _ends("odom", "depth_freeze", "limit diving.depth_doubt", 40.0, "diving.depth_doubt"),
    _ends("odom", "rolled", "limit diving.roll_deg", 1.6, "diving.roll_deg, diving.tilt_after"),
    *of_reference("desired_pitch", "dive"),
    _ends("desired_pitch", "freeze", "limit diving.", 120.0, _DIVING),
    *of_reference("desired_pitch_rate", "dive"),
    _E("desired_pitch_rate", "freeze", "", "", 0.0, "goes on", **_DIVE),
    *of_command("sternplane_cmd", "dive"),
    _ends("sternplane_cmd", "freeze", "limit diving.", 120.0, _DIVING),
    _E(
        "sternplane_cmd", "freeze", _GUIDANCE, "aborted: abort was called", 0.1, "aborts", 0.1,
        then_abort=True, **_DIVE,
    ),
    _ends("thrust_cmd", "weak", "limit diving.slow_after", 40.0, "diving.slow_after"),
    _ends(_PLANT, "light", "limit diving.", 90.0, "diving.slow_after, diving.broach_after"),
    _ends(
        _PLANT, "heavy", "surfacing: ", 33.0, "diving.hold_sink, ascent.when",
        also="velocity_through_water", lasts=150.0, surfaces=True,
    ),
)  # fmt: skip


def _altitude(fault: Kind, says: str, within: float = 0.1, **more: Any) -> Expectation:
    """The depth is held without a range to the bottom: the mission goes on."""
    more = {"set_by": "guidance.vertical.altitude.patience" if says else "", **more}
    noticed_by, within = (_GUIDANCE, within) if says else ("", 0.0)
    return _E("altitude", fault, noticed_by, says, within, "goes on", flight="bottom", **more)


#: The rows of a flight above the bottom.
ALTITUDE: tuple[Expectation, ...] = (
    _altitude("stop", "no usable range", 2.2, set_by="water_velocity_timeout"),
    _altitude("delay", "no usable range", 2.2, set_by="water_velocity_timeout"),
    _altitude("nan", "no usable range", 1.2),
    _altitude("freeze", ""),
    _altitude("jump", "no usable range", 1.2, set_by="guidance.vertical.altitude.largest_drop"),
    _altitude("reverse", "altitude: found a stamp"),
    _altitude("frameless", ""),
    _altitude("timeless", "altitude: found a stamp of"),
    _altitude("cut", "bytes that do not decode"),
    _E("altitude", "flood", _GUIDANCE, "altitude comes at", flight="bottom", **FLOOD),
)
TABLE: tuple[Expectation, ...] = (*PLANAR, *DIVING, *ALTITUDE)
#: What the tests run: one of each way to notice and of each outcome.
REPRESENTATIVE = (
    "odom jump", "odom stop", "velocity_through_water reverse", "desired_yaw nan",
    "rudder_cmd stop", "mission_state forge", "thrust_cmd freeze then abort", "heading_autopilot kill",
    "ailos_guidance kill",
)  # fmt: skip
#: What the command runs without --full: the same, and some of a vehicle that dives.
QUICK = (
    *REPRESENTATIVE, "odom depth_turn", "odom rolled", "sternplane_cmd stop", "remus_plant heavy",
    "altitude jump",
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
