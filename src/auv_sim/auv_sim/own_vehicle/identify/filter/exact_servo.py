"""A servo with dead time, dead band and play, solved exactly between commands: smooth in its parameters."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.fins.actuator import AT_REST


@pure
def fin_angles(
    times: Any,
    issued: Any,
    commands: Any,
    rate: float,
    dead_time: float,
    dead_band: float,
    half_play: float,
    means: Any,
    changes: Any,
) -> None:
    """Fill in the mean angle of the fin in each step, and the change within it of the line of best fit.

    The servo moves at its rate to the last command whose dead time is over; at rest it ignores a command
    within its dead band. The fin follows the servo with the play. Both begin in neutral.

    Args:
        times: shape (n,), s, increasing.
        issued, commands: times (s, increasing) and angles (rad) of the commands.
        rate: rad/s.
        dead_time: s.
        dead_band, half_play: rad.
        means, changes: written, shape (n - 1,), rad.
    """
    angle = target = fin = 0.0
    following = 0
    for k in range(len(times) - 1):
        t, end = times[k], times[k + 1]
        length, middle = end - t, 0.5 * (t + end)
        area = moment = 0.0
        while True:
            target, following = due(issued, commands, following, t, dead_time, angle, target, dead_band)
            if t >= end:
                break
            stop = end
            if following < len(issued) and issued[following] + dead_time < stop:
                stop = issued[following] + dead_time
            after, last, contact = angle, fin, stop
            if target != angle:
                after, stop = moved(angle, target, rate, t, stop)
                last, contact = dragged(fin, angle, after, half_play, t, stop)
            # The fin rests until the servo has crossed the play, then moves with it.
            area += fin * (contact - t) + 0.5 * (fin + last) * (stop - contact)
            moment += fin * (contact - t) * (0.5 * (t + contact) - middle)
            moment += _line(fin, last, contact - middle, stop - middle)
            angle, fin, t = after, last, stop
        means[k] = area / length
        changes[k] = 12.0 * moment / (length * length)


@pure
def due(
    issued: Any,
    commands: Any,
    following: int,
    t: float,
    dead_time: float,
    angle: float,
    target: float,
    dead_band: float,
) -> tuple[float, int]:
    """Return the servo's target (rad) by the commands whose dead time is over, and the next command."""
    while following < len(issued) and issued[following] + dead_time <= t:
        command = commands[following]
        if abs(target - angle) >= AT_REST or abs(command - angle) > dead_band or not dead_band > 0.0:
            target = command
        following += 1
    return target, following


@pure
def moved(angle: float, target: float, rate: float, t: float, stop: float) -> tuple[float, float]:
    """Return the servo's angle (rad) at `stop`, or at the earlier moment at which it arrives, and that."""
    reached = t + abs(target - angle) / rate
    if reached <= stop:
        return target, reached
    return angle + (rate if target > angle else -rate) * (stop - t), stop


@pure
def dragged(
    fin: float, angle: float, after: float, half_play: float, t: float, stop: float
) -> tuple[float, float]:
    """Return the fin's angle (rad) at `stop`, and when the servo has crossed the play (s)."""
    free = fin - angle + (half_play if after > angle else -half_play)
    if free * (after - angle) < 0.0:
        free = 0.0
    if abs(free) >= abs(after - angle):
        return fin, stop
    last = after - half_play if after > angle else after + half_play
    return last, t + (stop - t) * free / (after - angle)


@pure
def _line(first: float, last: float, begin: float, end: float) -> float:
    """Return the first moment about 0 of a line from (begin, first) to (end, last)."""
    return (end - begin) * (first * (2.0 * begin + end) + last * (begin + 2.0 * end)) / 6.0
