"""Recordings as the identification takes them, and the part that is left out of it."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_msgs_py.contract.frames import FrameIds
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.bags.content.recorded_manoeuvres import READ, Manoeuvring, manoeuvres_in
from auv_sim.flight.run_record import SpatialRun
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData, coupling_of
from auv_sim.own_vehicle.identify.dive.vertical_motion import VerticalMotion, vertical_loads_of
from auv_sim.own_vehicle.identify.results.known_vehicle import forces
from auv_sim.own_vehicle.identify.results.plausibility import check_commands
from auv_sim.own_vehicle.identify.time_grid import PlanarData

#: With this much data (s) a part of so many seconds is left out and predicted; step of its choice, s.
ENOUGH, LAST, _STEP = 150.0, 45.0, 15.0
#: Largest share of all turning that is left out by default: the rest must still show the rudder.
_MOST = 0.6
#: Shortest part of a recording that is used beside what is left out, s.
SHORTEST = 10.0
#: Heave and pitch need at least so many odometries and samples, and planes that move (deviation, rad).
_LEAST_ROWS, _LEAST_SAMPLES, _LEAST_ANGLE = 800, 100, 0.01

#: Axes of a frame -> fields of `FrameIds` with the frame ids that have them, and with those that have the
#: opposite ones.
_AXES = {
    "enu": ("enu_world", "ned_world"), "ned": ("ned_world", "enu_world"),
    "flu": ("flu_body", "frd_body"), "frd": ("frd_body", "flu_body"),
}  # fmt: skip


class Recorded(NamedTuple):
    """One recording: in the plane, and in the vertical where there are commands of stern planes."""

    plane: PlanarData
    dive: DiveData | None


def add_reading_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that name what a recording of another make has."""
    topics = ", ".join(topic.name for topic in READ)
    parser.add_argument(
        "--topic", action="append", default=[], metavar="NAME=TOPIC",
        help=f"other name of a topic; NAME is one of {topics}",
    )  # fmt: skip
    parser.add_argument(
        "--frame", action="append", default=[], metavar="ID=AXES",
        help=f"axes of a further frame id, such as base_footprint=flu; AXES is one of {', '.join(_AXES)}",
    )  # fmt: skip
    parser.add_argument("--namespace", metavar="NAME", help="which vehicle, where there are several")


def read(options: argparse.Namespace, vehicle: Vehicle, hull: Hull) -> list[Recorded]:
    """Read recordings.

    Args:
        options: those of `add_reading_arguments`, and `bag`: the recordings.
        vehicle, hull: limits, unit of the thrust, drag.

    Raises:
        ConfigurationError: as `manoeuvres_in` and `check_commands`; also an unknown name or axes.
    """
    names: dict[str, str] = {}
    for name, other in map(_renaming, options.topic):
        if name in names:
            raise ConfigurationError(f"--topic {name}", f"{names[name]} and {other}", "one topic")
        names[name] = other
    frames, found = frames_with(options.frame), []
    for path in options.bag:
        recorded = manoeuvres_in(path, names, options.namespace, frames=frames)
        check_commands(recorded.rudder.value, recorded.thrust.value, vehicle, str(path))
        found.append(Recorded(planar(recorded, vehicle, hull, str(path)), diving(recorded, vehicle, hull)))
    return found


def _renaming(text: str) -> tuple[str, str]:
    name, equals, other = text.partition("=")
    allowed = [topic.name for topic in READ]
    if name not in allowed or not equals or not other:
        raise ConfigurationError("--topic", text, f"NAME=TOPIC with NAME one of {', '.join(allowed)}")
    return name, other


def frames_with(given: Sequence[str]) -> FrameIds:
    """Return the accepted frame ids with those that are given, ID=AXES.

    Raises:
        ConfigurationError: a text that is not ID=AXES, or unknown axes.
    """
    ids = FrameIds()
    for text in given:
        name, equals, axes = text.rpartition("=")
        if not equals or not name or axes not in _AXES:
            raise ConfigurationError("--frame", text, f"ID=AXES with AXES one of {', '.join(_AXES)}")
        same, opposite = _AXES[axes]
        bare = name.strip("/").rsplit("/", 1)[-1]  # a frame id counts without its prefix
        others = [other for other in getattr(ids, opposite) if other != bare]
        ids = dataclasses.replace(ids, **{same: [*getattr(ids, same), bare], opposite: others})
    return ids


def planar(recorded: Manoeuvring, vehicle: Vehicle, hull: Hull, name: str) -> PlanarData:
    """Return what the identification in the plane needs of a recording."""
    run, rudder = recorded.run, recorded.rudder
    largest = vehicle.rudder.max_angle
    known = np.isfinite(run.r)
    return PlanarData(
        name, run.t[known], run.r[known], recorded.water_t, recorded.water[:, 0], recorded.water[:, 1],
        rudder.t, np.clip(rudder.value, -largest, largest), recorded.thrust.t,
        forces(vehicle, hull, np.clip(recorded.thrust.value, 0.0, vehicle.thrust_max)), run.psi[known],
        recorded.over[known, 0], recorded.over[known, 1], np.zeros(int(known.sum())),
        vertical_motion(recorded, hull),
    )  # fmt: skip


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


def diving(recorded: Manoeuvring, vehicle: Vehicle, hull: Hull) -> DiveData | None:
    """Return what the identification of heave and pitch needs; None without planes, or a hull in space."""
    run, planes, limits = recorded.run, recorded.sternplanes, vehicle.sternplanes
    if planes is None or limits is None or hull.vertical is None or not isinstance(run, SpatialRun):
        return None
    known = np.isfinite(run.q) & np.isfinite(run.theta) & np.isfinite(run.r)
    water = np.isfinite(recorded.water[:, 2])
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
        recorded.thrust.t,
        forces(vehicle, hull, np.clip(recorded.thrust.value, 0.0, vehicle.thrust_max)),
        coupling_of(hull, hull.vertical),
    )


def motion_within(command_t: Numbers, commands: Numbers, t: Numbers) -> float:
    """Return the standard deviation of the commands between the first and last of the times; 0 of none."""
    within = commands[(command_t >= t[0]) & (command_t <= t[-1])]
    return float(np.std(within)) if within.size else 0.0


def turning_part(data: PlanarData) -> tuple[float, float]:
    """Return begin and end (s) of the last part of `LAST` that turns as much as the whole recording does.

    Of a part that hardly turns, the yaw rate's error is the noise of the gyro.
    """
    begin, end = data.t[0], data.t[-1]
    firsts = (
        np.arange(end - LAST, begin + LAST, -_STEP) if end - begin > 3.0 * LAST else np.array([end - LAST])
    )
    squares = [float(np.mean(data.between(first, first + LAST).r ** 2)) for first in firsts]
    enough = np.flatnonzero(np.array(squares) >= float(np.mean(data.r**2)))
    first = firsts[enough[0] if enough.size else int(np.argmax(squares))]
    return float(first), float(first + LAST)


def turning_of(recordings: Sequence[PlanarData]) -> float:
    """Return the sum of the squared yaw rates, rad^2/s^2."""
    return sum(float(np.sum(data.r**2)) for data in recordings)


def divided(
    recordings: list[PlanarData], left_out: list[float] | None
) -> tuple[list[PlanarData], PlanarData | None]:
    """Return recordings without the part that is left out, and that part.

    Args:
        recordings: in the plane.
        left_out: begin and end of the part of the last recording, s from its begin; None: see `turning_part`,
            unless that part has most of the turning.

    Raises:
        ConfigurationError: the part lies outside the recording, or ends before it begins.
    """
    last = recordings[-1]
    begin, end = last.t[0], last.t[-1]
    if left_out is None:
        total = sum(data.t[-1] - data.t[0] for data in recordings)
        if total < ENOUGH:
            return recordings, None
        first, until = turning_part(last)
        if turning_of([last.between(first, until)]) > _MOST * turning_of(recordings):
            return recordings, None
    elif left_out == [0.0, 0.0]:
        return recordings, None
    else:
        if not left_out[0] < min(left_out[1], end - begin):
            found, expected = (
                " ".join(f"{x:g}" for x in left_out),
                f"begin and end within 0 to {end - begin:.0f} s",
            )
            raise ConfigurationError("--left-out", found, expected)
        first, until = begin + left_out[0], begin + left_out[1]
    parts = [last.between(begin - 1.0, first), last.between(until, end + 1.0)]
    kept = [part for part in parts if part.t.size and part.t[-1] - part.t[0] > SHORTEST]
    return [*recordings[:-1], *kept], last.between(first, until)
