"""Drivers of a vehicle that dives, with one mistake each, in the vertical plane; `planted` has the others."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from auv_msgs_py.values.attitude import angles_of_quaternion, quaternion_of, turned_over
from auv_msgs_py.values.types import SpatialCommand
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.samples import OdometrySample, WaterSample
from auv_sim.checks.vehicle_check.verdict import Mistake

#: Depth of the start, and farthest range of the altimeter, m.
DEPTH, FARTHEST = 6.0, 60.0


@dataclass(frozen=True)
class PlantedDiver:
    """One driver.

    Attributes:
        name: for people and for `--self-test`.
        mistake: what has to be found, None for an honest driver.
        odom, water: change an honest sample (ENU/FLU); the number counts the samples.
        altitude: changes the range, m; from (range, depth, count). None: no altimeter.
        command: changes a command before it reaches the vehicle.
        state: changes the measured angle of the planes, rad.
        dead_time: of the commands, s.
        planes_rate: share of the file's.
        bare: has no sternplane_state.
        depth: of the start, m.
    """

    name: str
    mistake: Mistake | None
    odom: Callable[[OdometrySample, int], OdometrySample] = lambda sample, _: sample
    water: Callable[[WaterSample, int], WaterSample] = lambda sample, _: sample
    altitude: Callable[[float, float, int], float] | None = lambda found, depth, _: found
    command: Callable[[SpatialCommand], SpatialCommand] = lambda command: command
    state: Callable[[float], float] = lambda angle: angle
    dead_time: float = 0.0
    planes_rate: float = 1.0
    bare: bool = False
    depth: float = DEPTH

    def file(self, vehicle: Vehicle) -> Vehicle:
        """Return the vehicle file that the driver is judged by."""
        return vehicle


def as_ned(sample: OdometrySample) -> OdometrySample:
    """Return an odometry of ENU/FLU as NED/FRD, under its names."""
    x, y, z, w = sample.orientation
    qw, qx, qy, qz = turned_over(w, x, y, z)
    return sample._replace(
        frame="map_ned", child="base_link_frd", x=sample.y, y=sample.x, z=-sample.z,
        orientation=(qx, qy, qz, qw),
        v=-sample.v, w=-sample.w, q=-sample.q, r=-sample.r,
    )  # fmt: skip


def water_as_ned(sample: WaterSample) -> WaterSample:
    """Return a velocity through the water of FLU as FRD, under its name."""
    return sample._replace(frame="base_link_frd", v=-sample.v, w=-sample.w)


def _angles(change: Callable[[float, float, float], tuple[float, float, float]]) -> Callable[
    [OdometrySample, int], OdometrySample
]:  # fmt: skip
    """Return a driver that changes roll, pitch and yaw, rad."""

    def odom(sample: OdometrySample, _: int) -> OdometrySample:
        x, y, z, w = sample.orientation
        qw, qx, qy, qz = quaternion_of(*change(*angles_of_quaternion(w, x, y, z)))
        return sample._replace(orientation=(qx, qy, qz, qw))

    return odom


def _pitch_up(sample: OdometrySample, count: int) -> OdometrySample:
    """Give pitch and pitch rate positive bow up."""
    turned = _angles(lambda roll, pitch, yaw: (roll, -pitch, yaw))(sample, count)
    return turned._replace(q=-turned.q)


def _planar(sample: OdometrySample, count: int) -> OdometrySample:
    level = _angles(lambda roll, pitch, yaw: (0.0, 0.0, yaw))(sample, count)
    return level._replace(z=0.0, w=0.0, p=0.0, q=0.0)


def _in_world(sample: OdometrySample, _: int) -> OdometrySample:
    """Give the vertical velocity of the world."""
    x, y, z, w = sample.orientation
    roll, pitch, _yaw = angles_of_quaternion(w, x, y, z)
    up = -math.sin(pitch) * sample.u + math.cos(pitch) * (
        math.sin(roll) * sample.v + math.cos(roll) * sample.w
    )
    return sample._replace(w=up)


def _names_of_enu(sample: OdometrySample) -> OdometrySample:
    return sample._replace(frame="map", child="base_link")


def _planes(share: float) -> Callable[[SpatialCommand], SpatialCommand]:
    return lambda command: command._replace(sternplanes=share * command.sternplanes)


_DEGREE, _FOOT = math.pi / 180.0, 0.3048

PLANTED_DIVERS = (
    PlantedDiver("diver", None),
    PlantedDiver("diver-ned", None, odom=lambda s, _: as_ned(s), water=lambda s, _: water_as_ned(s)),
    PlantedDiver("diver-bare", None, altitude=None, bare=True,
                 odom=lambda s, _: s._replace(w=math.nan), water=lambda s, _: s._replace(w=math.nan)),
    PlantedDiver("diver-afloat", None, depth=0.0),
    PlantedDiver("planar-odometry", Mistake.PLANAR_ODOMETRY, odom=_planar),
    PlantedDiver("depth-frozen", Mistake.DEPTH_FROZEN, odom=lambda s, _: s._replace(z=-6.0)),
    PlantedDiver("attitude-flat", Mistake.ATTITUDE_FLAT,
                 odom=_angles(lambda roll, pitch, yaw: (0.0, 0.0, yaw))),
    PlantedDiver("upside-down", Mistake.ATTITUDE_TILTED,
                 odom=_angles(lambda roll, pitch, yaw: (roll + math.pi, pitch, yaw))),
    PlantedDiver("depth-sign", Mistake.DEPTH_SIGN, odom=lambda s, _: s._replace(z=-s.z)),
    PlantedDiver("depth-sign-afloat", Mistake.DEPTH_SIGN, odom=lambda s, _: s._replace(z=-s.z), depth=0.0),
    PlantedDiver("depth-feet", Mistake.DEPTH_UNITS, odom=lambda s, _: s._replace(z=s.z / _FOOT)),
    PlantedDiver("pitch-sign", Mistake.PITCH_SIGN, odom=_pitch_up),
    PlantedDiver("pitch-sign-afloat", Mistake.PITCH_SIGN, odom=_pitch_up, depth=0.0),
    PlantedDiver("orientation-pitch-sign", Mistake.PITCH_SIGN,
                 odom=_angles(lambda roll, pitch, yaw: (roll, -pitch, yaw))),
    PlantedDiver("dive-ned", Mistake.DIVE_OTHER_CONVENTION,
                 odom=lambda s, k: _pitch_up(s, k)._replace(z=-s.z, w=-s.w)),
    PlantedDiver("all-ned", Mistake.AXES_OTHER_CONVENTION, odom=lambda s, _: _names_of_enu(as_ned(s)),
                 water=lambda s, _: water_as_ned(s)._replace(frame="base_link")),
    PlantedDiver("pitch-rate-sign", Mistake.PITCH_RATE_SIGN, odom=lambda s, _: s._replace(q=-s.q)),
    PlantedDiver("pitch-rate-degrees", Mistake.PITCH_RATE_DEGREES,
                 odom=lambda s, _: s._replace(q=s.q / _DEGREE)),
    PlantedDiver("roll-sign", Mistake.ROLL_SIGN, odom=_angles(lambda roll, pitch, yaw: (-roll, pitch, yaw))),
    PlantedDiver("heave-sign", Mistake.HEAVE_SIGN, odom=lambda s, _: s._replace(w=-s.w)),
    PlantedDiver("heave-in-world", Mistake.HEAVE_IN_WORLD, odom=_in_world),
    PlantedDiver("water-heave-sign", Mistake.WATER_HEAVE_SIGN, water=lambda s, _: s._replace(w=-s.w)),
    PlantedDiver("altitude-is-depth", Mistake.ALTITUDE_SIGN, altitude=lambda found, depth, _: depth),
    PlantedDiver("altitude-feet", Mistake.ALTITUDE_UNITS, altitude=lambda found, depth, _: found / _FOOT),
    PlantedDiver("altitude-no-echo", Mistake.ALTITUDE_NO_ECHO,
                 altitude=lambda found, depth, k: FARTHEST if k > 200 else found),
    PlantedDiver("altitude-nan", Mistake.NOT_A_NUMBER,
                 altitude=lambda found, depth, k: math.nan if k > 200 else found),
    PlantedDiver("depth-nan", Mistake.NOT_A_NUMBER,
                 odom=lambda s, k: s._replace(z=math.nan) if k % 40 == 7 else s),
    PlantedDiver("planes-sign", Mistake.PLANES_SIGN, command=_planes(-1.0)),
    PlantedDiver("planes-degrees", Mistake.PLANES_DEGREES, command=_planes(_DEGREE)),
    PlantedDiver("planes-scale", Mistake.PLANES_SCALE, command=_planes(0.4)),
    PlantedDiver("planes-dead", Mistake.PLANES_DEAD, command=_planes(0.0)),
    PlantedDiver("planes-slow", Mistake.PLANES_SLOW, planes_rate=0.3),
    PlantedDiver("planes-state-sign", Mistake.PLANES_STATE_SIGN, state=lambda angle: -angle),
    PlantedDiver("bare-planes-sign", Mistake.PLANES_SIGN, command=_planes(-1.0), bare=True),
    PlantedDiver("bare-planes-dead", Mistake.PLANES_DEAD, command=_planes(0.0), bare=True),
)  # fmt: skip
