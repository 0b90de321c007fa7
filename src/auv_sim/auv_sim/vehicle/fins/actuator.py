"""Rudder servo: limited in angle and rate; optionally with dead band, backlash and dead time."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, dispatched, pure
from auv_path_following.vehicle import Rudder, Vehicle
from auv_sim.vehicle.fins.late_servo import ROUNDING, LateServo, late_servo_at, late_servo_of, turn_late


@settings
class RudderFlaws:
    """Imperfections of a servo; each is off by default."""

    dead_band_deg: float = setting(
        0.0, "largest difference for which a servo at rest does not start", unit="deg", ge=0.0, le=20.0
    )
    backlash_deg: float = setting(
        0.0, "backlash between servo and rudder, from stop to stop", unit="deg", ge=0.0, le=20.0
    )
    dead_time: float = setting(0.0, "time from a command to the servo's start", unit="s", ge=0.0, le=5.0)


#: A servo that is nearer to its target than this is at rest, rad.
AT_REST = 1e-12
#: Commanded angle, rad, and whether it is new at the begin of this step or held.
Order = tuple[float, bool]
#: Angle of the rudder itself at the beginning, the middle and the end of a step, rad.
Deflection = tuple[float, float, float]


class Servo(NamedTuple):
    """Configuration of an ideal servo: largest angle (rad) and rate (rad/s)."""

    max_angle: float
    max_rate: float


class ServoState(NamedTuple):
    """Measured angle, rad."""

    angle: float = 0.0


@pure
def turn(config: Servo, state: ServoState, inputs: Order, dt: float) -> tuple[ServoState, Deflection]:
    """Move towards the command at the greatest rate, never past the stops."""
    max_angle, max_rate = config
    angle = state.angle
    error = bounded(inputs[0], max_angle) - angle
    end = angle + bounded(error, max_rate * dt)
    return ServoState(end), (angle, angle + bounded(error, max_rate * (0.5 * dt)), end)


class FlawedServo(NamedTuple):
    """Configuration of a servo with flaws.

    Attributes:
        max_angle, max_rate: rad, rad/s.
        band: dead band, rad.
        play: half of the backlash, rad.
        dead_time: s.
        size: most commands within their dead time.
        ring: written; the ends of their dead times (s), then their angles (rad), `size` each.
    """

    max_angle: float
    max_rate: float
    band: float
    play: float
    dead_time: float
    size: int
    ring: list[float]


class FlawedServoState(NamedTuple):
    """State of a servo with flaws.

    Attributes:
        angle: of the servo, as measured, rad.
        target, fin: of the servo, and the angle of the rudder itself, rad.
        clock: s.
        first, after: range of the commands within their dead time, in the count of all commands.
    """

    angle: float = 0.0
    target: float = 0.0
    fin: float = 0.0
    clock: float = 0.0
    first: int = 0
    after: int = 0


def with_rate(vehicle: Vehicle, share: float) -> Vehicle:
    """Return the vehicle with a share of its rudder rate."""
    rate = share * vehicle.rudder.max_rate_deg_s
    return dataclasses.replace(vehicle, rudder=dataclasses.replace(vehicle.rudder, max_rate_deg_s=rate))


def servo_of(rudder: Rudder) -> Servo | LateServo:
    """Return the configuration of a servo that is ideal but for its dead time."""
    if rudder.dead_time > 0.0:
        return late_servo_of(rudder)
    return Servo(rudder.max_angle, rudder.max_rate)


@pure
def ideal_servo_at(config: Servo, ring: Any, angle: float, dt: float) -> tuple[ServoState, float]:
    """Return the first state at an angle (rad), and the angle; it needs no ring."""
    return ServoState(angle), angle


#: First state of a servo: (configuration, ring, angle in rad, 0) -> (state, angle).
servo_begin = dispatched({Servo: ideal_servo_at, LateServo: late_servo_at})


def ring_size(servo: Servo | LateServo) -> int:
    """Return how many numbers the ring of a servo holds."""
    return 2 * servo.size if isinstance(servo, LateServo) else 0


def servo_at(servo: Servo | LateServo) -> Any:
    """Return the state of a servo in neutral."""
    return servo_begin(servo, [0.0] * ring_size(servo), 0.0, 0.0)[0]


def flawed_servo_of(rudder: Rudder, flaws: RudderFlaws, step: float) -> FlawedServo:
    """Return the configuration of a servo with flaws.

    Args:
        rudder: limits, and a dead time that adds to that of the flaws.
        flaws: in degrees and s.
        step: shortest time between two commands, s.
    """
    dead_time = flaws.dead_time + rudder.dead_time
    size = math.ceil(dead_time / step) + 3
    band, play = math.radians(flaws.dead_band_deg), math.radians(0.5 * flaws.backlash_deg)
    limits = rudder.max_angle, rudder.max_rate
    return FlawedServo(*limits, band, play, dead_time, size, [0.0] * (2 * size))


@pure
def turn_flawed(
    config: FlawedServo, state: FlawedServoState, inputs: Order, dt: float
) -> tuple[FlawedServoState, Deflection]:
    """Move towards the last command whose dead time is over; the rudder follows with the backlash.

    Each counts from the moment at which its dead time is over; at most one dead time may end within the step.

    Raises:
        IndexError: more commands within their dead time than the ring holds.
    """
    max_angle, max_rate, band, play, dead_time, size, ring = config
    angle, target, fin, clock, first, after = state
    ordered, is_new = inputs
    if is_new:
        command = bounded(ordered, max_angle)
        if dead_time > 0.0:
            if after - first >= size:
                raise IndexError("more commands within their dead time than the servo's ring holds")
            ring[after % size], ring[size + after % size] = clock + dead_time, command
            after += 1
            target, first = _due(config, angle, target, clock, first, after)
        else:
            target = _aim(band, angle, target, command)
    error = target - angle
    middle, end = angle + bounded(error, max_rate * (0.5 * dt)), angle + bounded(error, max_rate * dt)
    wait = ring[first % size] - clock if dead_time > 0.0 and first < after else dt
    if ROUNDING < wait < dt - ROUNDING:
        then = angle + bounded(error, max_rate * wait)
        target, first = _due(config, then, target, clock + wait, first, after)
        if wait < 0.5 * dt:
            middle = then + bounded(target - then, max_rate * (0.5 * dt - wait))
        end = then + bounded(target - then, max_rate * (dt - wait))
    fins = _dragged(fin, play, angle, middle, end) if play > 0.0 else (angle, middle, end)
    if dead_time > 0.0:
        clock += dt
        target, first = _due(config, end, target, clock, first, after)
    return FlawedServoState(end, target, fins[2], clock, first, after), fins


@pure
def _dragged(fin: float, play: float, begin: float, middle: float, end: float) -> Deflection:
    """Return the rudder's angles where the servo drags it along with a backlash of twice `play`, rad."""
    return (
        min(max(fin, begin - play), begin + play),
        min(max(fin, middle - play), middle + play),
        min(max(fin, end - play), end + play),
    )


@pure
def _due(
    config: FlawedServo, angle: float, target: float, clock: float, first: int, after: int
) -> tuple[float, int]:
    """Take the commands whose dead time is over; return the target and the first that remains."""
    while first < after and config.ring[first % config.size] <= clock + ROUNDING:
        target = _aim(config.band, angle, target, config.ring[config.size + first % config.size])
        first += 1
    return target, first


@pure
def _aim(band: float, angle: float, target: float, command: float) -> float:
    """Return the new target, rad: a servo at rest ignores a command within its dead band."""
    at_rest = abs(target - angle) < AT_REST
    if not at_rest or abs(command - angle) > band or not band > 0.0:
        return command
    return target


#: One step of the servo: (configuration, state, `Order`, dt) -> (state, `Deflection`).
servo_step = dispatched({Servo: turn, FlawedServo: turn_flawed, LateServo: turn_late})
