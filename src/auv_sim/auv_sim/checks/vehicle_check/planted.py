"""Drivers with one mistake each, which the check must find: a simulated vehicle, misreported on the wire.

The samples of an honest driver (ENU/FLU) are changed on their way, and so are its commands.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw, quaternion_of_yaw, swap_axes, yaw_of_quaternion
from auv_msgs_py.values.types import STOP, Command, Current
from auv_path_following.abilities import Cruise, Turning
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.samples import OdometrySample, WaterSample
from auv_sim.checks.vehicle_check.verdict import Mistake
from auv_sim.vehicle.fins.actuator import with_rate
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

#: Between two odometries of an honest driver, s; and the time after which a command is forgotten, s.
PERIOD, COMMAND_TIMEOUT = 0.05, 1.0
CURRENT = Current(0.12, -0.08)
#: The start, turned away from every axis.
START = PlantState(10.0, 30.0, math.radians(25.0), 0.0, 0.0, 0.0)
_STALE_CLOCK = 1.7e9


@dataclass(frozen=True)
class Planted:
    """One driver.

    Attributes:
        name: for people and for `--self-test`.
        mistake: what has to be found, None for an honest driver.
        odom, water: change an honest sample; the number counts the samples.
        command: changes a command before it reaches the vehicle.
        period: until the next odometry, s; from the count and seeded dice.
        dead_time: of the commands, s.
        rudder_rate: share of the file's.
        water_type: of the message on velocity_through_water.
        latched_commands: subscribes to commands as transient local.
        bare: has no rudder_state, and a vehicle file with measured values in place of a hull.
    """

    name: str
    mistake: Mistake | None
    odom: Callable[[OdometrySample, int], OdometrySample] = lambda sample, _: sample
    water: Callable[[WaterSample, int], WaterSample] = lambda sample, _: sample
    command: Callable[[Command], Command] = lambda command: command
    period: Callable[[int, np.random.Generator], float] = lambda count, dice: PERIOD
    dead_time: float = 0.0
    rudder_rate: float = 1.0
    water_type: str = topics.WATER_VELOCITY.type
    latched_commands: bool = False
    bare: bool = False

    def file(self, vehicle: Vehicle) -> Vehicle:
        """Return the vehicle file that the driver is judged by; `vehicle` is what really moves."""
        if not self.bare:
            return vehicle
        cruise = Cruise(thrust=vehicle.thrust_max, speed=vehicle.top_speed)
        turning = Turning(radius=round(tightest_turn(vehicle).radius, 1))
        return replace(vehicle, hull=None, cruise=cruise, turning=turning)


def _turned(change: Callable[[float], float]) -> Callable[[OdometrySample, int], OdometrySample]:
    def odom(sample: OdometrySample, _: int) -> OdometrySample:
        z, w = quaternion_of_yaw(change(yaw_of_quaternion(*sample.orientation)))
        return sample._replace(orientation=(0.0, 0.0, z, w))

    return odom


def _in_world(sample: OdometrySample, _: int) -> OdometrySample:
    yaw = yaw_of_quaternion(*sample.orientation)
    cos, sin = math.cos(yaw), math.sin(yaw)
    return sample._replace(u=sample.u * cos - sample.v * sin, v=sample.u * sin + sample.v * cos)


def _swapped(sample: OdometrySample, _: int) -> OdometrySample:
    x, y = swap_axes(sample.x, sample.y)
    return sample._replace(x=x, y=y)


def _shifted(shift: Callable[[int], float]) -> Callable[[OdometrySample, int], OdometrySample]:
    return lambda sample, count: sample._replace(stamp=sample.stamp + shift(count))


def _odom(
    **changes: Callable[[OdometrySample, int], Any],
) -> Callable[[OdometrySample, int], OdometrySample]:
    return lambda sample, count: sample._replace(
        **{k: change(sample, count) for k, change in changes.items()}
    )


def _command(**shares: float) -> Callable[[Command], Command]:
    return lambda c: c._replace(**{name: share * getattr(c, name) for name, share in shares.items()})


_KNOT, _DEGREE = 1.944, math.pi / 180.0

PLANTED = (
    Planted("honest", None),
    Planted("yaw-ned", Mistake.YAW_OTHER_CONVENTION, odom=_turned(flip_yaw)),
    Planted("yaw-sign", Mistake.YAW_SIGN, odom=_turned(lambda yaw: -yaw)),
    Planted("yaw-degrees", Mistake.YAW_DEGREES, odom=_turned(math.degrees)),
    Planted("yaw-rate-sign", Mistake.YAW_RATE_SIGN, odom=_odom(r=lambda s, _: -s.r)),
    Planted("yaw-rate-degrees", Mistake.YAW_RATE_DEGREES, odom=_odom(r=lambda s, _: s.r / _DEGREE)),
    Planted("velocity-in-world", Mistake.VELOCITY_IN_WORLD, odom=_in_world),
    Planted("velocity-in-knots", Mistake.VELOCITY_UNITS, odom=_odom(u=lambda s, _: _KNOT * s.u)),
    Planted("swapped-axes", Mistake.SWAPPED_AXES, odom=_swapped),
    Planted("sway-sign", Mistake.SWAY_SIGN, odom=_odom(v=lambda s, _: -s.v)),
    Planted("water-sway-sign", Mistake.WATER_SWAY_SIGN, water=lambda s, _: s._replace(v=-s.v)),
    Planted("wall-clock", Mistake.OTHER_CLOCK, odom=_shifted(lambda _: _STALE_CLOCK)),
    Planted("stamp-jump", Mistake.STAMP_JUMPS, odom=_shifted(lambda k: 5.0 if k > 400 else 0.0)),
    Planted("out-of-order", Mistake.OUT_OF_ORDER, odom=_shifted(lambda k: -0.12 if k % 10 == 0 else 0.0)),
    Planted("too-slow", Mistake.TOO_SLOW, period=lambda k, dice: 0.5),
    Planted("jittery", Mistake.JITTERY, period=lambda k, dice: 0.01 + 0.05 * round(4.0 * dice.random())),
    Planted("nan", Mistake.NOT_A_NUMBER, odom=_odom(y=lambda s, k: math.nan if k % 40 == 7 else s.y)),
    Planted("unknown-frame", Mistake.UNKNOWN_FRAME, odom=_odom(frame=lambda s, _: "world")),
    Planted("two-conventions", Mistake.CONTRADICTING_FRAMES, odom=_odom(child=lambda s, _: "base_link_frd")),
    Planted("covariance", Mistake.BAD_COVARIANCE, odom=_odom(pose_covariance=lambda s, _: (-1.0,) * 6)),
    Planted("wrong-type", Mistake.WRONG_TYPE, water_type="geometry_msgs/msg/TwistStamped"),
    Planted("qos-mismatch", Mistake.QOS_MISMATCH, latched_commands=True),
    Planted("rudder-sign", Mistake.RUDDER_SIGN, command=_command(rudder=-1.0)),
    Planted("rudder-degrees", Mistake.RUDDER_DEGREES, command=_command(rudder=_DEGREE)),
    Planted("rudder-slow", Mistake.RUDDER_SLOW, rudder_rate=0.25),
    Planted("dead-time", Mistake.DEAD_TIME, dead_time=0.7),
    Planted("no-thrust", Mistake.THRUST_DEAD, command=_command(thrust=0.02)),
    Planted("bare", None, bare=True),
    Planted("bare-rudder-sign", Mistake.RUDDER_SIGN, command=_command(rudder=-1.0), bare=True),
    Planted("bare-rudder-degrees", Mistake.RUDDER_DEGREES, command=_command(rudder=_DEGREE), bare=True),
    Planted("bare-rudder-scale", Mistake.RUDDER_SCALE, command=_command(rudder=0.3), bare=True),
    Planted("bare-rudder-slow", Mistake.RUDDER_SLOW, rudder_rate=0.25, bare=True),
    Planted("bare-dead-time", Mistake.DEAD_TIME, dead_time=0.7, bare=True),
    Planted(
        "bare-noisy", Mistake.NOT_JUDGED, odom=_odom(r=lambda s, k: s.r + 0.21 * math.sin(k * k)), bare=True
    ),
)


class PlantedVehicle:
    """The simulated vehicle behind one of these drivers; time comes from outside, s.

    Args:
        planted: the driver.
        vehicle: the hull.
        begin: the time it begins with.
    """

    def __init__(self, planted: Planted, vehicle: Vehicle, begin: float) -> None:
        self.planted = planted
        self.plant = SimulatedVehicle(with_rate(vehicle, planted.rudder_rate), START, current=CURRENT)
        self._dice = np.random.default_rng(4)
        self._now = self._next = begin
        self._count = 0
        self._under_way: deque[tuple[float, Command]] = deque()
        self._command, self._commanded_at = STOP, begin
        #: In its launching tube until the first thrust.
        self.moving = False

    def order(self, command: Command) -> None:
        """Take a command that arrives now."""
        if not self.planted.latched_commands:
            self._under_way.append((self._now + self.planted.dead_time, self.planted.command(command)))

    def live(self, until: float) -> list[tuple[OdometrySample, WaterSample, float]]:
        """Let time pass until `until`, s.

        Returns:
            The published samples: odometry, velocity through the water, rudder angle (rad).
        """
        samples = []
        while self._next <= until + 1e-9:
            self._advance(self._next - self._now)
            samples.append(self._measure())
            self._next += self.planted.period(self._count, self._dice)
        return samples

    def _advance(self, dt: float) -> None:
        end = self._now + dt
        while self._now < end - 1e-9:
            while self._under_way and self._under_way[0][0] <= self._now + 1e-9:
                self._command, self._commanded_at = self._under_way.popleft()[1], self._now
            silent = self._now - self._commanded_at > COMMAND_TIMEOUT
            step = min(0.01, end - self._now)
            self.moving = self.moving or self._command.thrust > 0.0
            if self.moving:
                self.plant.advance(STOP if silent else self._command, step)
            self._now += step

    def _measure(self) -> tuple[OdometrySample, WaterSample, float]:
        self._count += 1
        state = self.plant.motion
        x, y = swap_axes(state.x, state.y)
        z, w = quaternion_of_yaw(flip_yaw(state.psi))
        u, v = self.plant.ground_velocity if self.moving else (0.0, 0.0)
        odom = OdometrySample(
            self._now, self._now, "map", "base_link", x, y, (0.0, 0.0, z, w), u, -v, -state.r, w=0.0
        )
        ur, vr = (state.ur, state.vr) if self.moving else (0.0, 0.0)
        water = WaterSample(self._now, self._now, "base_link", ur, -vr, w=0.0)
        planted = self.planted
        return planted.odom(odom, self._count), planted.water(water, self._count), self.plant.rudder
