"""The part of the recordings that is left out of an identification, to be predicted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.own_vehicle.identify.time_grid import PlanarData

#: With this much data (s) a part of so many seconds is left out and predicted; step of its choice, s.
ENOUGH, LAST, _STEP = 150.0, 45.0, 15.0
#: Largest share of all turning that is left out by default: the rest must still show the rudder.
_MOST = 0.6
#: Shortest part of a recording that is used beside what is left out, s.
SHORTEST = 10.0


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
