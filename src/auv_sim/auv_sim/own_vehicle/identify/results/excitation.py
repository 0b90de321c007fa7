"""What recordings lack: refusals where nothing can be identified, remarks where something cannot."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.time_grid import FOLLOWED, LONGEST_GAP, PlanarData, shared_time

#: Least duration (s), new samples of the log, deviation of the rudder (deg) and rms yaw rate (deg/s).
_LEAST_TIME, _LEAST_SAMPLES, _LEAST_RUDDER, _LEAST_RATE = 40.0, 50, 1.0, 1.0
#: Least time with all measurements and commands in each recording, more than a log's latency, s.
_LEAST_TOGETHER = 5.0
_EXPECTED = "zig-zags and circles: `vehicle.py manoeuvres` flies them"


def check_excitation(recordings: Sequence[PlanarData], where: str) -> None:
    """Check that a hull can be identified at all.

    Raises:
        ConfigurationError: too short, too few samples, or hardly any motion; names the missing manoeuvre.
    """
    for data in recordings:
        if not data.t.size:
            found = "no finite yaw rate while there are commands"
            raise ConfigurationError(f"{data.name}: odom", found, "that of a gyro")
        together = shared_time(data)
        if together < _LEAST_TOGETHER:
            found = f"{together:.0f} s with odometry, commands and velocity through the water"
            expected = f"at least {_LEAST_TOGETHER:.0f} s in each recording, by one clock"
            raise ConfigurationError(data.name, found, expected)
    time = sum(_duration(data) for data in recordings)
    if time < _LEAST_TIME:
        found = f"{time:.0f} s of manoeuvres without gaps in the odometry"
        raise ConfigurationError(where, found, f"at least {_LEAST_TIME:.0f} s")
    samples = sum(data.u.size for data in recordings)
    if samples < _LEAST_SAMPLES:
        raise ConfigurationError(
            where, f"{samples} samples of velocity_through_water", f"at least {_LEAST_SAMPLES}"
        )
    rudder = math.degrees(float(np.std(_all(recordings, "rudder"))))
    rate = math.degrees(float(np.sqrt(np.mean(_all(recordings, "r") ** 2))))
    if rudder < _LEAST_RUDDER or rate < _LEAST_RATE:
        found = f"a rudder that moves by {rudder:.1f} deg and turns by {rate:.1f} deg/s (rms)"
        raise ConfigurationError(where, found, _EXPECTED)
    forward = float(np.median(_all(recordings, "u")))
    if not forward > 0.1:
        expected = "a vehicle under way, and axes with x ahead"
        raise ConfigurationError(
            f"{where}: velocity_through_water", f"a median speed ahead of {forward:.2f} m/s", expected
        )


def remarks(recordings: Sequence[PlanarData], vehicle: Vehicle) -> list[str]:
    """Return which manoeuvres would show more, one line each."""
    found = []
    thrust, speeds = _all(recordings, "thrust"), _all(recordings, "u")
    if np.std(thrust) < 0.05 * max(float(np.mean(thrust)), 1e-9) and np.std(speeds) < 0.05 * np.mean(speeds):
        found.append(
            "no thrust steps: mass and drag ahead stay nearly as assumed; fly straights at 0.5 and 1"
        )
    rate = _all(recordings, "r")
    right = float(np.mean(rate[np.abs(rate) > 0.02] > 0.0)) if np.any(np.abs(rate) > 0.02) else 0.5
    if not 0.15 < right < 0.85:
        side = "port" if right > 0.5 else "starboard"
        found.append(f"nearly all turns to one side: fly circles to {side} too")
    largest = float(np.max(np.abs(_all(recordings, "rudder")))) / vehicle.rudder.max_angle
    if largest < 0.3:
        found.append(f"only {largest:.0%} of the rudder used: the tightest turn is an extrapolation")
    return found


def _all(recordings: Sequence[PlanarData], name: str) -> Numbers:
    return np.concatenate([getattr(data, name) for data in recordings])


def _duration(data: PlanarData) -> float:
    """Return the time that is used: without gaps, and without that in which the fin is unknown after each."""
    if not data.t.size:
        return 0.0
    gaps = np.diff(data.t)
    gaps = gaps[gaps >= LONGEST_GAP]
    return max(float(data.t[-1] - data.t[0] - gaps.sum() - FOLLOWED * gaps.size), 0.0)
