"""A servo that follows each command after a dead time of any length, exact within a step."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.pure import bounded, pure
from auv_path_following.vehicle import Rudder

#: Shortest time between two commands, s.
SHORTEST_PERIOD = 0.005
#: Tolerance for the end of a dead time, s: clocks are sums of steps.
ROUNDING = 1e-9


class LateServo(NamedTuple):
    """Configuration.

    Attributes:
        max_angle, max_rate: rad, rad/s.
        dead_time: from a command to the servo's start, s.
        size: most commands within their dead time.
    """

    max_angle: float
    max_rate: float
    dead_time: float
    size: int


class LateServoState(NamedTuple):
    """State.

    Attributes:
        angle, target: of the servo, rad.
        clock: s.
        first, after: range of the commands within their dead time, in the count of all commands.
        ring: written; the ends of their dead times (s), then their angles (rad), each of length `size`.
    """

    angle: float
    target: float
    clock: float
    first: int
    after: int
    ring: Any


def late_servo_of(rudder: Rudder) -> LateServo:
    """Return the configuration of an otherwise ideal servo."""
    size = math.ceil(rudder.dead_time / SHORTEST_PERIOD) + 3
    return LateServo(rudder.max_angle, rudder.max_rate, rudder.dead_time, size)


@pure
def late_servo_at(config: LateServo, ring: Any, angle: float, dt: float) -> tuple[LateServoState, float]:
    """Return the first state at an angle (rad), and the angle; `ring` has 2 `size` numbers."""
    return LateServoState(angle, angle, 0.0, 0, 0, ring), angle


@pure
def turn_late(
    config: LateServo, state: LateServoState, inputs: tuple[float, bool], dt: float
) -> tuple[LateServoState, tuple[float, float, float]]:
    """Move towards the last command whose dead time is over, from the moment at which it is over.

    Args:
        config, state: of the servo.
        inputs: commanded angle (rad), and whether it is new at the begin of this step or held.
        dt: s; at most one dead time may end within it.

    Raises:
        IndexError: more commands within their dead time than the ring holds.
    """
    max_angle, max_rate, dead_time, size = config
    angle, target, clock, first, after, ring = state
    ordered, is_new = inputs
    if is_new:
        if after - first >= size:
            raise IndexError("more commands within their dead time than the servo's ring holds")
        ring[after % size], ring[size + after % size] = clock + dead_time, bounded(ordered, max_angle)
        after += 1
    while first < after and ring[first % size] <= clock + ROUNDING:
        target = ring[size + first % size]
        first += 1
    half = 0.5 * dt
    if first < after and ring[first % size] < clock + dt - ROUNDING:
        wait = ring[first % size] - clock
        then = angle + bounded(target - angle, max_rate * wait)
        middle = angle + bounded(target - angle, max_rate * half)
        target = ring[size + first % size]
        first += 1
        if wait < half:
            middle = then + bounded(target - then, max_rate * (half - wait))
        end = then + bounded(target - then, max_rate * (dt - wait))
    else:
        middle = angle + bounded(target - angle, max_rate * half)
        end = angle + bounded(target - angle, max_rate * dt)
    return LateServoState(end, target, clock + dt, first, after, ring), (angle, middle, end)
