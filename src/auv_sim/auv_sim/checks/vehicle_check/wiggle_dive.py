"""The commands of the small test of a vehicle that dives: pulses of the planes around a held pitch. ROS-free.

Most torpedoes do not hold their pitch with neutral planes, so the test steers it with the contract's signs.
With a wrong sign the pitch runs away, which shows the sign, and the bounds below end the test.
"""

from __future__ import annotations

import itertools
import math
from collections import deque

from auv_msgs_py.contract.frames import is_ned
from auv_msgs_py.values.attitude import angles_of_quaternion
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialCommand
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.samples import OdometrySample, Recording
from auv_sim.checks.vehicle_check.wiggle import THRUST_SHARE

#: The whole test, s, and the speed through the water (m/s) or the time (s) from which the planes move.
END, _SPEED, _LATEST = 27.0, 0.5, 5.0
#: (until, rudder in degrees).
_RUDDER = ((13.0, 0.0), (16.0, 10.0), (21.0, -10.0), (24.0, 20.0), (26.0, 0.0))
#: (until, pitch to hold in degrees, bow up): level, a climb, a dive, level.
_PITCH = ((9.0, 0.0), (14.0, 6.0), (19.0, -5.0), (END, 0.0))
#: Times between the pulses, s, of no common period: a late response is not taken for a turned one.
_PULSES = (1.2, 1.9, 0.9, 2.2, 1.5, 0.8, 1.7, 1.1)
#: Angle of a pulse, and the largest that steers, rad; steering for each rad of pitch and each rad/s.
_PULSE, _STEERING, _PER_PITCH, _PER_RATE = math.radians(6.0), math.radians(10.0), 1.5, 1.5
#: Time over which the rate of pitch is taken, s.
_RATE_OVER = 0.5
#: Largest change of depth, m, largest pitch, rad, and least altitude of the test, m.
LARGEST_DIVE, STEEPEST, LOWEST = 4.0, math.radians(35.0), 1.5


class DivingWiggle:
    """The sequence for one vehicle; it needs 4 m of water below and a circle of some 40 m radius.

    Args:
        vehicle: whose limits are kept.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        assert vehicle.sternplanes is not None
        self._vehicle = vehicle
        self._thrust = THRUST_SHARE * vehicle.thrust_max
        self._planes = vehicle.sternplanes.max_angle
        self._pulses_from: float | None = None
        self._pitches: deque[tuple[float, float]] = deque()

    def at(self, seconds: float, recording: Recording) -> SpatialCommand:
        """Return the command at a time after the beginning, s, by what has been recorded."""
        if not 0.0 <= seconds < END:
            return SPATIAL_STOP
        degrees = next((angle for until, angle in _RUDDER if seconds < until), 0.0)
        rudder = math.copysign(min(abs(math.radians(degrees)), self._vehicle.rudder.max_angle), degrees)
        thrust = self._thrust if 1.0 <= seconds < END - 1.0 else 0.0
        return SpatialCommand(rudder, self._planes_at(seconds, recording), thrust)

    def _planes_at(self, seconds: float, recording: Recording) -> float:
        if not recording.odom:
            return 0.0
        pitch, rate = self._pitch_of(recording.odom[-1])
        if self._pulses_from is None:
            speed = recording.water[-1].u if recording.water else 0.0
            if not (seconds >= _LATEST or (seconds >= 1.0 and speed > _SPEED)):
                return 0.0
            self._pulses_from = seconds
        hold = math.radians(next(angle for until, angle in _PITCH if seconds < until))
        steering = _PER_PITCH * (pitch - hold) + _PER_RATE * rate
        pulse = _PULSE * _side(seconds - self._pulses_from)
        planes = min(max(steering, -_STEERING), _STEERING) + pulse
        return min(max(planes, -self._planes), self._planes)

    def _pitch_of(self, sample: OdometrySample) -> tuple[float, float]:
        """Return pitch and its rate over the last odometries, rad and rad/s, bow up; 0 where they fail."""
        x, y, z, w = sample.orientation
        pitch = (1.0 if is_ned(sample.frame) else -1.0) * angles_of_quaternion(w, x, y, z)[1]
        kept = self._pitches
        if not math.isfinite(pitch + sample.stamp):
            return 0.0, 0.0
        if not kept or sample.stamp > kept[-1][0]:
            kept.append((sample.stamp, pitch))
        elif sample.stamp < kept[-1][0] - 1.0:
            kept.clear()
        while len(kept) > 2 and kept[-1][0] - kept[1][0] >= _RATE_OVER:
            kept.popleft()
        if len(kept) < 2:
            return pitch, 0.0
        (begin, first), (end, last) = kept[0], kept[-1]
        return pitch, (last - first) / (end - begin)


def _side(seconds: float) -> float:
    """Return the side of the pulse at a time after their beginning, s: bow up first."""
    side = -1.0
    for length in itertools.cycle(_PULSES):
        if seconds < length:
            return side
        seconds, side = seconds - length, -side
    raise AssertionError  # the pulses have no end


def danger(recording: Recording, origin: OdometrySample, vehicle: Vehicle) -> str:
    """Return what makes it dangerous to go on: depth or pitch beyond the bounds; empty if nothing."""
    last = recording.odom[-1]
    x, y, z, w = last.orientation
    depth = last.z if is_ned(last.frame) else -last.z
    if not math.isfinite(depth) or not math.isfinite(origin.z):
        return "a depth that is no number"
    if abs(last.z - origin.z) > LARGEST_DIVE:
        return f"{abs(last.z - origin.z):.1f} m above or below where it began"
    if depth > vehicle.depth.max:
        return f"{depth:.1f} m deep, deeper than depth.max, {vehicle.depth.max:g} m"
    if recording.altitude and recording.altitude[-1].range < LOWEST:
        return f"{recording.altitude[-1].range:.1f} m above the bottom"
    pitch = angles_of_quaternion(w, x, y, z)[1]
    if abs(pitch) > STEEPEST:
        return f"a pitch of {math.degrees(abs(pitch)):.0f} deg"
    return ""
