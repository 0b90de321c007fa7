"""From command to response: sign, scale, rate limit and dead time of the rudder; whether the thrust pushes.

The vehicle's own file is the model: the same commands go through the simulated hull, with several rudder
rates, and what was measured is compared with that, shifted by several dead times. A file without a hull has
the measured turn and cruise in its place (`turning.py`).
"""

from __future__ import annotations

import math

import numpy as np

from auv_msgs_py.contract.frames import Convention
from auv_msgs_py.values.types import Command
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.fits import STEP, WAYS, Fit, best, servo
from auv_sim.checks.vehicle_check.items.turning import fit_turning
from auv_sim.checks.vehicle_check.items.values import convention_of
from auv_sim.checks.vehicle_check.samples import Array, Motion, Recording, Value
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown, warned
from auv_sim.vehicle.fins.actuator import with_rate
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

#: Least commanded rudder, rad rms.
_LEAST_RUDDER = math.radians(2.0)
#: Dead time above which the rudder begins to swing (docs/driver.md), and above which the test fails, s.
GOOD_DELAY, WORST_DELAY = 0.15, 0.4
#: Least time of thrust for a speed, s; the test of a vehicle that dives may be cut short.
_LEAST_PUSH, _LONGER_PUSH = 8.0, 24.0

#: What is judged here.
ITEMS = ("rudder: sign and scale", "rudder: rate", "rudder: dead time", "thrust: push")
_NEEDED = "rudder commands of some degrees while the vehicle moves: --wiggle, or a mission under way"


def check_response(recording: Recording, motion: Motion, vehicle: Vehicle) -> list[Verdict]:
    """Judge the responses of rudder and thrust to the commands."""
    items = ITEMS
    t, rudder, thrust = _commands(recording)
    if not motion.enough or t.size == 0 or float(np.sqrt(np.mean(rudder**2))) < _LEAST_RUDDER:
        return [unknown(item, "no commands to follow", _NEEDED) for item in items]
    push = _push(items[3], recording, t, thrust, vehicle)
    state = _fit_state(recording, t, rudder, vehicle)
    # A stationary vehicle does not respond to its rudder.
    moves = push.mistake is not Mistake.THRUST_DEAD
    yaw = _fit_yaw(recording, motion, t, rudder, thrust, vehicle) if moves else None
    loosely = vehicle.dives and state is None
    return [_sign(items[0], state, yaw, loosely), *_rate_and_delay(items[1:3], state, yaw, vehicle), push]


def _commands(recording: Recording) -> tuple[Array, Array, Array]:
    """Return the times of a grid, s, and both commands on it; each of shape (n,)."""
    if not recording.rudder_cmd or not recording.thrust_cmd:
        return np.empty(0), np.empty(0), np.empty(0)
    begin = min(recording.rudder_cmd[0].received, recording.thrust_cmd[0].received)
    end = max(recording.rudder_cmd[-1].received, recording.thrust_cmd[-1].received)
    t = np.arange(begin, end, STEP)
    return t, held(recording.rudder_cmd, t), held(recording.thrust_cmd, t)


def held(values: list[Value], t: Array) -> Array:
    """Return values that hold until the next one, at times t (s); 0 before the first."""
    times = np.array([value.received for value in values])
    row = np.searchsorted(times, t, side="right") - 1
    held = np.array([value.value for value in values])
    return np.where(row >= 0, held[np.maximum(row, 0)], 0.0)


def _fit_state(recording: Recording, t: Array, rudder: Array, vehicle: Vehicle) -> Fit | None:
    samples = [
        s for s in recording.rudder_state if math.isfinite(s.value) and t[0] <= s.received <= t[-1] + 1.0
    ]
    if len(samples) < 20:
        return None
    times, values = np.array([s.received for s in samples]), np.array([s.value for s in samples])
    if float(np.abs(values).max()) < 1e-4:
        return Fit(0.0, 1.0, 0.0, 1.0)
    return best(t, {way: servo(way.scale * rudder, vehicle, way.rate) for way in WAYS}, times, values)


def _fit_yaw(
    recording: Recording, motion: Motion, t: Array, rudder: Array, thrust: Array, vehicle: Vehicle
) -> Fit | None:
    """Fit the yaw rate to the file's hull; a positive gain has the contract's sign."""
    inside = (motion.t >= t[0]) & (motion.t <= t[-1] + 1.0)
    if inside.sum() < 20:
        return None
    ned = convention_of(recording) is Convention.NED_FRD
    if vehicle.hull is None:
        through_water = [s for s in recording.water if math.isfinite(s.u)]
        if len(through_water) < 20:
            return None
        speed = np.interp(t, [s.received for s in through_water], [s.u for s in through_water])
        sign = -1.0 if ned else 1.0
        return fit_turning(t, rudder, speed, motion.t[inside], sign * motion.r[inside], vehicle)
    models = {}
    for way in WAYS:
        begin = PlantState(0.0, 0.0, 0.0, _speed(recording, t[0]), 0.0, 0.0)
        plant = SimulatedVehicle(with_rate(vehicle, way.rate), begin)
        model = np.empty_like(t)
        for k in range(t.size):
            model[k] = plant.motion.r if ned else -plant.motion.r
            plant.advance(Command(way.scale * float(rudder[k]), float(thrust[k])), STEP)
        models[way] = model
    return best(t, models, motion.t[inside], motion.r[inside])


def _speed(recording: Recording, at: float) -> float:
    """Return the speed through the water when the commands begin, m/s."""
    before = [s.u for s in recording.water if s.received <= at + 0.5 and math.isfinite(s.u)]
    return min(max(float(np.median(before[-5:])) if before else 0.0, 0.0), 5.0)


def _sign(item: str, state: Fit | None, yaw: Fit | None, loosely: bool = False) -> Verdict:
    """Judge sign and scale; `loosely`: of the scale only the order, which a rolled and pitched hull shows."""
    expected = "1: positive turns to port, radians"
    measured = "; ".join(
        f"{name} {fit.scale * fit.gain:.2g}"
        for name, fit in (("rudder_state", state), ("yaw rate", yaw))
        if fit is not None
    )
    measured = f"per command and file: {measured}"
    if yaw is None and state is None:
        return unknown(item, "neither rudder_state nor enough yaw rate and speed through the water", _NEEDED)
    judge = yaw if yaw is not None and yaw.unexplained < 0.5 else state if yaw is None else yaw
    assert judge is not None
    for fit in (state, yaw):
        if fit is not None and fit.scale != 1.0 and fit.unexplained < 0.5 and 0.3 < abs(fit.gain) < 3.0:
            return failed(item, Mistake.RUDDER_DEGREES, measured, expected)
    if judge.unexplained > 0.8 or abs(judge.gain) < 0.05:
        return failed(item, Mistake.RUDDER_DEAD, measured, expected)
    if judge.gain < 0.0:
        return failed(item, Mistake.RUDDER_SIGN, measured, expected)
    if state is not None and state.gain < 0.0:
        return failed(item, Mistake.RUDDER_STATE_SIGN, measured, expected)
    scale = state.gain if state is not None and state.gain else judge.gain
    if not 0.5 < judge.gain < 2.0 or not (loosely or 0.7 < scale < 1.4):
        if state is not None and 0.7 < scale < 1.4:
            return warned(item, measured, "a hull as the vehicle's file has it", Mistake.RUDDER_SCALE)
        return failed(item, Mistake.RUDDER_SCALE, measured, expected)
    return passed(item, measured, expected)


def _rate_and_delay(
    items: tuple[str, ...], state: Fit | None, yaw: Fit | None, vehicle: Vehicle
) -> list[Verdict]:
    fit = state if state is not None and state.unexplained < 0.3 else yaw
    if fit is None or fit.unexplained > 0.5 or fit.scale != 1.0:
        return [unknown(item, "the rudder does not follow closely enough", _NEEDED) for item in items]
    file = vehicle.rudder.max_rate_deg_s
    measured, expected = f"about {fit.rate * file:.0f} deg/s", f"{file:g} deg/s, from the vehicle's file"
    if fit.rate < 0.55:
        rate = failed(items[0], Mistake.RUDDER_SLOW, measured, expected)
    else:
        rate = passed(items[0], measured, expected)
    measured = f"{fit.delay * 1e3:.0f} ms"
    expected = f"{GOOD_DELAY * 1e3:.0f} ms or less, or the rudder swings"
    if fit.delay > WORST_DELAY:
        return [rate, failed(items[1], Mistake.DEAD_TIME, measured, expected)]
    if fit.delay > GOOD_DELAY:
        return [rate, warned(items[1], measured, expected, Mistake.DEAD_TIME)]
    return [rate, passed(items[1], measured, expected)]


def _push(item: str, recording: Recording, t: Array, thrust: Array, vehicle: Vehicle) -> Verdict:
    """Judge the speed through the water against the file's speed at this thrust."""
    pushed = t[thrust > 0.5 * float(thrust.max(initial=0.0))] if thrust.size else t
    if pushed.size == 0 or float(thrust.max()) <= 0.0:
        return unknown(item, "no thrust was commanded", _NEEDED)
    late = [
        s.u for s in recording.water if pushed[-1] - 3.0 < s.received <= pushed[-1] and math.isfinite(s.u)
    ]
    least = _LONGER_PUSH if vehicle.dives else _LEAST_PUSH
    if not late or pushed[-1] - pushed[0] < least:
        return unknown(item, "thrust for too short a time", f"{least:g} s at least")
    expected_speed = vehicle.speed_at(float(np.median(thrust[thrust > 0.0])))
    speed = float(np.median(late))
    measured, expected = (
        f"{speed:.2f} m/s through the water",
        f"about {expected_speed:.2f} m/s, from the vehicle's file",
    )
    if speed < 0.25 * expected_speed:
        return failed(item, Mistake.THRUST_DEAD, measured, expected)
    if not 0.5 < speed / expected_speed < 1.6:
        return failed(item, Mistake.THRUST_SCALE, measured, expected)
    return passed(item, measured, expected)
