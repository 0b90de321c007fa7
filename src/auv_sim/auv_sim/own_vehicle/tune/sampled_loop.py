"""Margins of the sampled linear loop: sway, yaw, heading, commands on their way, a delay of any length.

The controller is the autopilot's own step, linearised where the vehicle follows its reference: no law is
written down twice. The fin is taken as fast: what its rate does to large deviations only flights show.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

from auv_msgs_py.values.types import Navigation, Reference
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.hull_model import HullModel, rudder_gain, slopes
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.vehicle import Vehicle

Matrix = npt.NDArray[np.float64]

#: Deviation for derivatives: of every law the bend within it is below rounding.
_SMALL = 1e-6
#: Largest gain factor and longest further delay (s) that are searched.
LARGEST_FACTOR, LONGEST = 16.0, 1.0
_HALVINGS = 20


class LinearPlane(NamedTuple):
    """A hull in one plane, linear: x' = A x + B delta with x = (sway or its equal, rate, angle)."""

    A: Matrix
    B: Matrix


class SampledLoop(NamedTuple):
    """A controller from (angle, rate) to the fin: z' = F z + G y, delta = H z + K y, at each odometry."""

    F: Matrix
    G: Matrix
    H: Matrix
    K: Matrix


class Margins(NamedTuple):
    """How far a loop is from a limit cycle.

    Attributes:
        up, down: factors by which the loop's gain may grow, and by which it may shrink.
        delay: further delay that it bears, s.
        is_stable: as it is; without, the rest is 1, 1 and 0.
    """

    up: float
    down: float
    delay: float
    is_stable: bool


def yaw_plane(vehicle: Vehicle) -> LinearPlane:
    """Return a vehicle in yaw at the speed of its design; without a hull from what was measured."""
    speed = response_of(vehicle).speed
    if vehicle.hull is None:
        return _measured_plane(vehicle)
    model = HullModel(vehicle)
    (vv, vr), (rv, rr) = slopes(model.sway_yaw, speed, 0.0, 0.0)
    sway, yaw = rudder_gain(model.sway_yaw, speed)
    return LinearPlane(
        np.array([[vv, vr, 0.0], [rv, rr, 0.0], [0.0, 1.0, 0.0]]), np.array([[sway], [yaw], [0.0]])
    )


def _measured_plane(vehicle: Vehicle) -> LinearPlane:
    """Return the state space of -b (s - zero)/((s - pole)(s - divergence)), and the heading."""
    f = response_of(vehicle)
    # The lag (s - zero)/(s - pole) = 1 + (pole - zero)/(s - pole), before the growth 1/(s - divergence).
    A = np.array([[f.pole, 0.0, 0.0], [f.pole - f.zero, f.divergence, 0.0], [0.0, 1.0, 0.0]])
    return LinearPlane(A, np.array([[-f.effect], [-f.effect], [0.0]]))


def loop_of(config: AutopilotConfig, vehicle: Vehicle, step: float) -> SampledLoop:
    """Return the heading autopilot, linear where it follows a constant course.

    Args:
        config: controller and gains.
        vehicle: that the autopilot assumes.
        step: between two odometries, s.

    Raises:
        ConfigurationError: the gains need values that the vehicle's file does not have.
    """
    prepared = autopilot.prepare(config, vehicle)
    thrust = vehicle.thrust_max if vehicle.cruise is None else vehicle.cruise.thrust
    reference = Reference(0.0, 0.0, thrust)
    begun, *_ = autopilot.steer(
        prepared, autopilot.first_state(prepared), Navigation(0.0, 0.0, 0.0, 0.0), reference, 0.0
    )

    def respond(inputs: Matrix) -> Matrix:
        state = _with_numbers(begun, iter(inputs[2:].tolist()))
        seen = Navigation(0.0, 0.0, inputs[0], inputs[1])
        after, command, _ = autopilot.steer(prepared, state, seen, reference, step)
        return np.array([command.rudder, *_numbers(after)])

    slopes_of = _jacobian(respond, 2 + len(list(_numbers(begun))))
    return SampledLoop(slopes_of[1:, 2:], slopes_of[1:, :2], slopes_of[:1, 2:], slopes_of[:1, :2])


def margins(plane: LinearPlane, loop: SampledLoop, step: float, delay: float) -> Margins:
    """Return the margins of a loop.

    Args:
        plane: the hull.
        loop: the controller.
        step: between two odometries, s.
        delay: from a measurement to the fin, of any length, s.
    """
    if not is_stable(plane, loop, step, delay):
        return Margins(1.0, 1.0, 0.0, False)
    up = _edge(lambda e: is_stable(plane, loop, step, delay, math.exp(e)), math.log(LARGEST_FACTOR))
    down = _edge(lambda e: is_stable(plane, loop, step, delay, math.exp(-e)), math.log(LARGEST_FACTOR))
    later = _edge(lambda more: is_stable(plane, loop, step, delay + more), LONGEST)
    return Margins(math.exp(up), math.exp(down), later, True)


def is_stable(plane: LinearPlane, loop: SampledLoop, step: float, delay: float, factor: float = 1.0) -> bool:
    """Return whether every deviation decays, with the loop's gain times `factor`."""
    return spectral_radius(plane, loop, step, delay, factor) < 1.0 - 1e-9


def spectral_radius(
    plane: LinearPlane, loop: SampledLoop, step: float, delay: float, factor: float = 1.0
) -> float:
    """Return the factor by which the slowest deviation changes from one odometry to the next."""
    whole = math.floor(delay / step + 1e-9)
    part = max(delay - whole * step, 0.0)
    after, new, old = _sampled(plane, step, part)
    n, m = 3, len(loop.F)
    size = n + m + whole + 1
    # State: hull, controller, then the last commands, the newest first.
    closed = np.zeros((size, size))
    seen = np.zeros((2, n))
    seen[0, 2] = seen[1, 1] = 1.0
    command = np.zeros((1, size))
    command[:, :n], command[:, n : n + m] = factor * loop.K @ seen, factor * loop.H
    closed[:n, :n] = after
    closed[:n] += new @ (command if whole == 0 else _picked(size, n + m + whole - 1))
    closed[:n] += old @ _picked(size, n + m + whole)
    closed[n : n + m, :n], closed[n : n + m, n : n + m] = loop.G @ seen, loop.F
    closed[n + m] = command[0]
    for k in range(1, whole + 1):
        closed[n + m + k, n + m + k - 1] = 1.0
    return float(np.abs(np.linalg.eigvals(closed)).max())


def _picked(size: int, k: int) -> Matrix:
    row = np.zeros((1, size))
    row[0, k] = 1.0
    return row


def _sampled(plane: LinearPlane, step: float, part: float) -> tuple[Matrix, Matrix, Matrix]:
    """Return x after a step: matrices of x, of the command that arrives after `part` s, of the one before."""

    def held(seconds: float) -> tuple[Matrix, Matrix]:
        block = np.zeros((4, 4))
        block[:3, :3], block[:3, 3:] = plane.A * seconds, plane.B * seconds
        both = expm(block)
        return both[:3, :3], both[:3, 3:]

    rest, new = held(step - part)
    begin, old = held(part)
    return rest @ begin, new, rest @ old


def _edge(holds: Callable[[float], bool], largest: float, steps: int = 24) -> float:
    """Return up to where something holds that holds at 0, searched in equal steps, then by halves."""
    for k in range(1, steps + 1):
        if not holds(largest * k / steps):
            low, high = largest * (k - 1) / steps, largest * k / steps
            for _ in range(_HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if holds(middle) else (low, middle)
            return low
    return largest


def _jacobian(function: Callable[[Matrix], Matrix], size: int) -> Matrix:
    columns = []
    for k in range(size):
        away = np.zeros(size)
        away[k] = _SMALL
        columns.append((function(away) - function(-away)) / (2.0 * _SMALL))
    return np.stack(columns, axis=1)


def _numbers(state: Any) -> Iterator[float]:
    """Yield the numbers of a nested state that are no flags."""
    for value in state:
        if isinstance(value, tuple):
            yield from _numbers(value)
        elif not isinstance(value, bool):
            yield float(value)


def _with_numbers(state: Any, numbers: Iterator[float]) -> Any:
    values = [
        _with_numbers(value, numbers)
        if isinstance(value, tuple)
        else value
        if isinstance(value, bool)
        else next(numbers)
        for value in state
    ]
    return type(state)(*values)
