"""Checks that a recording is in the units of the wire contract, and that what was identified explains it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.innovations import filtered
from auv_sim.own_vehicle.identify.predictions import predictions_of
from auv_sim.own_vehicle.identify.refine.own_trims import derivative, shifts_of
from auv_sim.own_vehicle.identify.results.rudder_plausibility import (
    EXCEEDING,
    check_rudder,
    check_rudder_sign,
)
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, LATENCY

#: Largest thrust over the file's.
_MORE_THRUST = 1.1
#: Range of the heading's change over that by the yaw rate; changes in longer gaps (s) are left out.
_RATE, _LONGEST_STEP = (0.7, 1.4), 0.5
#: Correlation of sway with the yaw rate (-0.86 to -0.98 on 21 hulls in a rough sea) of another sign.
_INWARD = 0.5
#: Horizon of predictions of the identified data (s), and their largest error over the rms yaw rate.
_HORIZON, _LARGEST_ERROR = 2.0, 0.2
#: Factor between the speed that the file expects at the recorded thrust, and the measured one: that of a
#: notice, and that of a thrust in another unit, whose square is the factor between the forces.
_SPEEDS, _OTHER_UNIT = 2.5, 4.0
#: Dead time below which the commands were recorded too late, s.
_LATE = -0.01
#: A given latency of the log is doubted where the data would move it by more than this (s), and by so many
#: standard deviations; step of the derivative, s.
_LEAST_SHIFT, _CLEARLY, _STEP = 0.05, 4.0, 1e-3
#: The thrust's mean error at high and at low thrust (shares of the largest) is compared where each was
#: held for some time in all (s), after the filter has settled (s). A larger difference is a doubt: up to
#: 0.028 with drag by the square of the speed, 0.034 to 0.083 with 30 % of it linear in the speed.
_HIGH, _LOW, _HELD, _SETTLED, _SHAPE = 0.85, (0.2, 0.7), 10.0, 10.0, 0.03


def check_commands(
    rudder: Numbers, thrust: Numbers, vehicle: Vehicle, where: str, is_unit_given: bool = False
) -> None:
    """Check that commands have the units of the wire contract and of the vehicle's file.

    Args:
        rudder, thrust: as recorded.
        vehicle: limits.
        where: name of the recording.
        is_unit_given: whether the owner has stated the rudder's unit: angles that end at 1 are no shares.

    Raises:
        ConfigurationError: angles that no rudder has, or this one, or more thrust than the vehicle has.
    """
    check_rudder(rudder, vehicle, where, is_unit_given)
    if thrust.size and np.mean(thrust > _MORE_THRUST * vehicle.thrust_max) > EXCEEDING:
        symbol = vehicle.thrust_symbol
        expected = f"up to thrust_max of {vehicle.name}, {vehicle.thrust_max:g} {symbol}, in that unit"
        raise ConfigurationError(f"{where}: thrust_cmd", f"up to {np.max(thrust):.3g}", expected)


def check_motion(recordings: Sequence[PlanarData], vehicle: Vehicle, drag: float, where: str) -> None:
    """Check that rates, velocities and thrust have the units and axes of the wire contract.

    Args:
        recordings: with thrust in N.
        vehicle: known beforehand.
        drag: as for `doubts`.
        where: name of the recordings.

    Raises:
        ConfigurationError: as `check_yaw_rate`, `check_sway`, `check_rudder_sign` and `check_speed`.
    """
    check_yaw_rate(recordings, where)
    check_sway(recordings, where)
    check_rudder_sign(recordings, where)
    check_speed(recordings, vehicle, drag, where)


def check_yaw_rate(recordings: Sequence[PlanarData], where: str) -> None:
    """Check that the yaw rate is the derivative of the heading.

    Raises:
        ConfigurationError: it is not, as with a rate in deg/s, another sign, or a stamp that is none.
    """
    turned = rates = 0.0
    for data in recordings:
        step, change = np.diff(data.t), np.mod(np.diff(data.psi) + math.pi, 2.0 * math.pi) - math.pi
        by_rate = 0.5 * (data.r[1:] + data.r[:-1]) * step
        kept = (step < _LONGEST_STEP) & np.isfinite(change) & np.isfinite(by_rate)
        turned += float(np.sum(change[kept] * by_rate[kept]))
        rates += float(np.sum(by_rate[kept] ** 2))
    if rates > 0.0 and not _RATE[0] <= turned / rates <= _RATE[1]:
        shown = "0" if turned == 0.0 else f"{rates / turned:.3g}"
        expected = "its derivative in rad/s, by the stamps, with the sign of its frame"
        raise ConfigurationError(
            f"{where}: odom", f"a yaw rate of {shown} times that of the heading", expected
        )


def check_sway(recordings: Sequence[PlanarData], where: str) -> None:
    """Check that the vehicle drifts to the outside of its turns, as every hull with a stern rudder does.

    Raises:
        ConfigurationError: it drifts to the inside.
    """
    v = np.concatenate([data.v for data in recordings])
    r = np.concatenate([np.interp(data.water_t, data.t, data.r) for data in recordings])
    inward = float(np.sum(v * r)) / max(float(np.sqrt(np.sum(v * v) * np.sum(r * r))), 1e-12)
    if inward > _INWARD:
        raise ConfigurationError(
            f"{where}: velocity_through_water",
            "sway to the inside of turns",
            "sway to the outside: check the axes of its frame id (--frame ID=AXES), and that it is the "
            "velocity of the odometry's body, not of a log far ahead of it",
        )


def check_speed(recordings: Sequence[PlanarData], vehicle: Vehicle, drag: float, where: str) -> None:
    """Check that the measured speed is about that which the file expects at the recorded thrust.

    Raises:
        ConfigurationError: it is not, as with a thrust in another unit.
    """
    speed, expected = _speeds(recordings, drag)
    if not expected / _OTHER_UNIT <= speed <= expected * _OTHER_UNIT:
        raise ConfigurationError(
            f"{where}: thrust_cmd",
            f"thrust at which {vehicle.name} makes {expected:.2f} m/s, and {speed:.2f} m/s measured",
            f"thrust in {vehicle.thrust_symbol}, up to {vehicle.thrust_max:g}, and a velocity in m/s",
        )


def _speeds(recordings: Sequence[PlanarData], drag: float) -> tuple[float, float]:
    """Return the measured speed, and that by the file's drag at the thrust in force, m/s.

    Both are medians over the samples of the speed during which there is thrust, or over all without any.
    """
    last = [np.searchsorted(data.thrust_t, data.water_t, side="right") - 1 for data in recordings]
    held = [data.thrust[np.maximum(rows, 0)] for data, rows in zip(recordings, last, strict=True)]
    thrust, speed = np.concatenate(held), np.concatenate([data.u for data in recordings])
    pushed = thrust > 0.0 if (thrust > 0.0).any() else np.ones(thrust.size, bool)
    return float(np.median(speed[pushed])), math.sqrt(max(float(np.median(thrust[pushed])), 0.0) / drag)


def check_fit(found: Identified, where: str) -> None:
    """Check that the identified hull predicts its own recordings over 2 s.

    Raises:
        ConfigurationError: it does not.
    """
    with np.errstate(all="ignore"):  # the prediction of a wrong hull can overflow
        (prediction,) = predictions_of(found.channels, found.physical, (_HORIZON,))
    if prediction.starts and not prediction.error <= _LARGEST_ERROR:
        error = f"{prediction.error:.0%}" if prediction.error < 10.0 else "more than 1000 %"
        raise ConfigurationError(
            where,
            f"a hull that predicts the yaw rate over {_HORIZON:g} s to {error}",
            f"{_LARGEST_ERROR:.0%} or better: check sign and unit of rudder_cmd (--unit), and the stamps",
        )


def doubts(found: Identified, recordings: Sequence[PlanarData], vehicle: Vehicle, drag: float) -> list[str]:
    """Return what a person should look at, one line each.

    Args:
        found: what was identified.
        recordings: that it was identified from.
        vehicle: known beforehand.
        drag: of the known hull straight ahead over the speed squared, kg/m.
    """
    lines = []
    dead_time = float(found.physical[DEAD_TIME])
    if dead_time < _LATE:
        lines.append(
            f"a dead time of {dead_time:.3f} s: the commands are recorded later than they take effect. "
            "The file has 0: write its true rudder.dead_time into it"
        )
    speed, expected = _speeds(recordings, drag)
    if not expected / _SPEEDS <= speed <= expected * _SPEEDS:
        lines.append(
            f"{speed:.2f} m/s where {vehicle.name} makes {expected:.2f} m/s with the recorded thrust: "
            "check the unit of thrust_cmd"
        )
    return lines


def latency_doubts(found: Identified) -> list[str]:
    """Return one line where the data contradict the latency of the log that was given."""
    if found.scaling.sheet.latency_deviation > 0.0:
        return []
    parts = found.channels, found.scaling, found.estimate
    shifts = shifts_of(*parts, derivative(*parts, LATENCY, _STEP)[:, None])
    shift, deviation = float(shifts.values[0]), float(shifts.deviations[0])
    if abs(shift) < max(_LEAST_SHIFT, _CLEARLY * deviation):
        return []
    given, how = found.scaling.sheet.latency, "less" if shift < 0.0 else "more"
    return [
        f"--log-latency {given:g}: the data show {how} than {given:g} s, and the hull is off with it: "
        "leave the option out to find the latency from the data"
    ]


def thrust_doubts(found: Identified) -> list[str]:
    """Return one line where the thrust's error differs between high and low thrust."""
    errors, shares, steps = [], [], []
    largest = max(float(np.max(passage.grid.thrust)) for passage in found.channels.passages)
    for passage in found.channels.passages:
        error = filtered(passage, found.channels, found.physical)[:, 3]
        known = np.isfinite(error) & (passage.times[:-1] > passage.times[0] + _SETTLED)
        errors.append(error[known])
        shares.append(passage.grid.thrust[known] / max(largest, 1e-9))
        steps.append(passage.grid.step[known])
    error, share, step = (np.concatenate(parts) for parts in (errors, shares, steps))
    means = []
    for level in (share > _HIGH, (share > _LOW[0]) & (share < _LOW[1])):
        if step[level].sum() < _HELD:
            return []
        means.append(float(np.average(error[level], weights=step[level])))
    more = means[0] - means[1]
    if abs(more) < _SHAPE:
        return []
    return [
        f"the thrust's error at high thrust less that at low thrust is {100.0 * more:+.0f} %: the drag is "
        "not by the square of the speed, or thrust_table has another shape. The speed at full thrust may be "
        "some per cent off. For thrust in per cent or rpm, `vehicle.py new` with --speed at two thrusts "
        "shapes the table"
    ]
