"""Recordings as the identification takes them."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import FrameIds
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.bags.content.recorded_commands import TimedCommands
from auv_sim.bags.content.recorded_manoeuvres import Manoeuvring, manoeuvres_in
from auv_sim.bags.reading.manoeuvre_topics import READ
from auv_sim.flight.run_record import SpatialRun
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.command_silence import outside, silences
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData, coupling_of
from auv_sim.own_vehicle.identify.dive.vertical_motion import VerticalMotion, vertical_loads_of
from auv_sim.own_vehicle.identify.results.known_vehicle import forces
from auv_sim.own_vehicle.identify.results.plausibility import check_commands
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.verbs.reading.fin_units import add_unit_argument, check_effect, in_radians, units_of

#: Heave and pitch need at least so many odometries and samples, and planes that move (deviation, rad).
_LEAST_ROWS, _LEAST_SAMPLES, _LEAST_ANGLE = 800, 100, 0.01

#: Axes of a frame -> fields of `FrameIds` with the frame ids that have them, and with those that have the
#: opposite ones.
_AXES = {
    "enu": ("enu_world", "ned_world"), "ned": ("ned_world", "enu_world"),
    "flu": ("flu_body", "frd_body"), "frd": ("frd_body", "flu_body"),
}  # fmt: skip
Spans = Sequence[tuple[float, float]]


class Recorded(NamedTuple):
    """One recording.

    Attributes:
        plane: motion in the plane.
        dive: vertical motion where there are commands of stern planes, else None.
        silence: time without commands while the odometry runs, which is left out, s.
        notes: what was converted, one line each.
    """

    plane: PlanarData
    dive: DiveData | None
    silence: float
    notes: tuple[str, ...] = ()


def add_reading_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that name what a recording of another make has."""
    names = ", ".join(topic.name for topic in READ)
    parser.add_argument(
        "--topic", action="append", default=[], metavar="NAME=TOPIC[:PART]",
        help=f"other name of a topic; NAME is one of {names}; PART is a joint, an index or a field in its "
        "messages",
    )  # fmt: skip
    parser.add_argument(
        "--frame", action="append", default=[], metavar="ID=AXES",
        help="axes of a further frame id, such as base_footprint=flu, or of an empty one, =flu; "
        f"AXES is one of {', '.join(_AXES)}",
    )  # fmt: skip
    add_unit_argument(parser)
    parser.add_argument("--namespace", metavar="NAME", help="which vehicle, where there are several")


def read(options: argparse.Namespace, vehicle: Vehicle, hull: Hull) -> list[Recorded]:
    """Read recordings.

    Args:
        options: those of `add_reading_arguments`, and `bag`: the recordings.
        vehicle, hull: limits, unit of the thrust, drag.

    Raises:
        ConfigurationError: as `manoeuvres_in`, `units_of`, `in_radians`, `check_commands` and `check_effect`;
            also an unknown name or axes.
    """
    names: dict[str, str] = {}
    for name, other in map(_renaming, options.topic):
        if name in names:
            raise ConfigurationError(f"--topic {name}", f"{names[name]} and {other}", "one topic")
        names[name] = other
    frames, units, found = frames_with(options.frame), units_of(options.unit), []
    with_planes = False
    for path in options.bag:
        recorded = manoeuvres_in(path, names, options.namespace, frames=frames)
        recorded = in_radians(recorded, units, vehicle, str(path))
        is_given = topics.RUDDER_CMD.name in units
        check_commands(recorded.rudder.value, recorded.thrust.value, vehicle, str(path), is_given)
        spans = silences_of(recorded)
        plane = planar(recorded, vehicle, hull, str(path), spans)
        dive = diving(recorded, vehicle, hull, spans)
        first, last = recorded.run.t[[0, -1]]
        silence = sum(max(min(end, last) - max(begin, first), 0.0) for begin, end in spans)
        found.append(Recorded(plane, dive, float(silence), recorded.notes))
        with_planes |= recorded.sternplanes is not None
    check_effect(units, vehicle, with_planes)
    return found


def _renaming(text: str) -> tuple[str, str]:
    name, equals, other = text.partition("=")
    allowed = [topic.name for topic in READ]
    if name not in allowed or not equals or not other:
        raise ConfigurationError("--topic", text, f"NAME=TOPIC[:PART] with NAME one of {', '.join(allowed)}")
    return name, other


def frames_with(given: Sequence[str]) -> FrameIds:
    """Return the accepted frame ids with those that are given, ID=AXES.

    Raises:
        ConfigurationError: a text that is not ID=AXES, or unknown axes.
    """
    ids = FrameIds()
    for text in given:
        name, equals, axes = text.rpartition("=")
        if not equals or axes not in _AXES:
            raise ConfigurationError("--frame", text, f"ID=AXES with AXES one of {', '.join(_AXES)}")
        same, opposite = _AXES[axes]
        bare = name.strip("/").rsplit("/", 1)[-1]  # a frame id counts without its prefix
        others = [other for other in getattr(ids, opposite) if other != bare]
        ids = dataclasses.replace(ids, **{same: [*getattr(ids, same), bare], opposite: others})
    return ids


def silences_of(recorded: Manoeuvring) -> Spans:
    """Return the intervals in which a kind of commands is silent; see `silences`."""
    kinds = (recorded.rudder, recorded.thrust, recorded.sternplanes)
    return silences([commands for commands in kinds if commands is not None], float(recorded.run.t[-1]))


def planar(recorded: Manoeuvring, vehicle: Vehicle, hull: Hull, name: str, silent: Spans = ()) -> PlanarData:
    """Return what the identification in the plane needs of a recording, without the silent intervals."""
    run, largest = recorded.run, vehicle.rudder.max_angle
    known = np.isfinite(run.r) & outside(silent, run.t)
    rudder, thrust = (obeyed(commands, silent) for commands in (recorded.rudder, recorded.thrust))
    log = outside(silent, recorded.water_t)
    water = recorded.water[log]
    return PlanarData(
        name, run.t[known], run.r[known], recorded.water_t[log], water[:, 0], water[:, 1],
        rudder.t, np.clip(rudder.value, -largest, largest), thrust.t,
        forces(vehicle, hull, np.clip(thrust.value, 0.0, vehicle.thrust_max)), run.psi[known],
        recorded.over[known, 0], recorded.over[known, 1], np.zeros(int(known.sum())),
        vertical_motion(recorded, hull),
    )  # fmt: skip


def obeyed(commands: TimedCommands, silent: Spans) -> TimedCommands:
    """Return the commands outside the silent intervals: a vehicle that misses one kind obeys none.

    The last command within an interval takes effect at its end, if it has one.
    """
    t, kept = commands.t.copy(), outside(silent, commands.t)
    for begin, end in silent:
        inside = np.flatnonzero((commands.t > begin) & (commands.t < end))
        if inside.size and np.isfinite(end):
            kept[inside[-1]], t[inside[-1]] = True, end
    return TimedCommands(t[kept], commands.value[kept])


def vertical_motion(recorded: Manoeuvring, hull: Hull) -> VerticalMotion | None:
    """Return heave, roll and pitch beside the motion in the plane; None without them, or a hull in space."""
    run = recorded.run
    if hull.vertical is None or not isinstance(run, SpatialRun):
        return None
    known = np.isfinite(run.phi) & np.isfinite(run.theta) & np.isfinite(run.q)
    water = np.isfinite(recorded.water[:, 2])
    if min(known.sum(), water.sum()) < _LEAST_SAMPLES:
        return None
    return VerticalMotion(
        run.t[known], run.phi[known], run.theta[known], run.q[known],
        recorded.water_t[water], recorded.water[water, 2], vertical_loads_of(hull, hull.vertical),
    )  # fmt: skip


def diving(recorded: Manoeuvring, vehicle: Vehicle, hull: Hull, silent: Spans = ()) -> DiveData | None:
    """Return what the identification of heave and pitch needs, without the silent intervals.

    None without planes, a hull in space, or enough of all.
    """
    run, limits = recorded.run, vehicle.sternplanes
    if (
        recorded.sternplanes is None
        or limits is None
        or hull.vertical is None
        or not isinstance(run, SpatialRun)
    ):
        return None
    planes, thrust = obeyed(recorded.sternplanes, silent), obeyed(recorded.thrust, silent)
    known = np.isfinite(run.q) & np.isfinite(run.theta) & np.isfinite(run.r) & outside(silent, run.t)
    water = np.isfinite(recorded.water[:, 2]) & outside(silent, recorded.water_t)
    if known.sum() < _LEAST_ROWS or water.sum() < _LEAST_SAMPLES:
        return None
    if motion_within(planes.t, planes.value, run.t[known]) < _LEAST_ANGLE:
        return None
    log = recorded.water[water]
    return DiveData(
        "dive",
        *(run.t[known], run.q[known], run.theta[known], run.phi[known], run.r[known]),
        *(recorded.water_t[water], log[:, 0], log[:, 1], log[:, 2]),
        *(planes.t, np.clip(planes.value, -limits.max_angle, limits.max_angle)),
        thrust.t,
        forces(vehicle, hull, np.clip(thrust.value, 0.0, vehicle.thrust_max)),
        coupling_of(hull, hull.vertical),
    )


def motion_within(command_t: Numbers, commands: Numbers, t: Numbers) -> float:
    """Return the standard deviation of the commands between the first and last of the times; 0 of none."""
    within = commands[(command_t >= t[0]) & (command_t <= t[-1])]
    return float(np.std(within)) if within.size else 0.0
