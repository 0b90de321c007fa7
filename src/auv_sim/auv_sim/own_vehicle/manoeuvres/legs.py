"""The manoeuvres of a program as numbers, for one vehicle."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Rudder, Vehicle
from auv_sim.own_vehicle.manoeuvres.program_file import (
    Circle,
    Manoeuvre,
    PitchZigzag,
    PlaneStep,
    Program,
    Straight,
    Zigzag,
)

#: Kinds of legs.
SUBMERGE, STRAIGHT, ZIGZAG, CIRCLE, PITCH_ZIGZAG, DEPTH_ZIGZAG, PLANE_STEP = range(7)
#: Manoeuvres with an angle of the rudder, and with one of the planes.
_OF_RUDDER, _OF_PLANES = (Zigzag, Circle), (PitchZigzag, PlaneStep)
#: Longest way to the depth, and time in which a depth must be held, s.
LONGEST_DIVE = 60.0
#: Rudder for each rad of heading error; the same for the rate in lengths over speed.
PER_HEADING, PER_YAW_RATE = 0.5, 1.25
#: Planes for each rad of pitch error; the same for the rate in lengths over speed.
PER_PITCH, PER_PITCH_RATE = 1.5, 1.5


class Leg(NamedTuple):
    """One manoeuvre.

    Attributes:
        kind: one of the constants above.
        seconds: longest duration, s.
        thrust: N, or per cent.
        fin: first angle of the fin that moves, rad: rudder positive to port, planes positive bow down; of a
            depth zig-zag the first pitch, positive bow up.
        limit: deviation of heading or pitch (rad) or of depth (m) that reverses or ends it.
        course: from the one at the start, rad; NaN: as before.
        homeward: whether the course is that towards the place of the start.
        depth_step: change of the held depth, m.
        per_heading, per_yaw_rate: rudder of the heading loop, for each rad and each rad/s.
        per_pitch, per_pitch_rate: planes of the pitch loop, alike.
    """

    kind: int
    seconds: float
    thrust: float
    fin: float
    limit: float
    course: float
    homeward: bool
    depth_step: float
    per_heading: float
    per_yaw_rate: float
    per_pitch: float
    per_pitch_rate: float


class Manoeuvres(NamedTuple):
    """A program for one vehicle.

    Attributes:
        legs: in the order of their flight.
        max_rudder, max_planes: largest angles, rad; without planes 0.
    """

    legs: tuple[Leg, ...]
    max_rudder: float
    max_planes: float

    @property
    def duration(self) -> float:
        """Longest duration, s."""
        return sum(leg.seconds for leg in self.legs)


def manoeuvres_of(program: Program, vehicle: Vehicle) -> Manoeuvres:
    """Return a program for one vehicle; one that dives goes to its depth first.

    The angles of a program with `fits_fins` are reduced to what the fins can do.

    Raises:
        ConfigurationError: the program needs stern planes and the vehicle has none; an angle exceeds the
            fin's largest.
    """
    legs = []
    planes = vehicle.sternplanes
    shares = fin_shares(program, vehicle)
    if planes is not None:
        legs.append(_leg(Straight(seconds=LONGEST_DIVE), vehicle)._replace(kind=SUBMERGE))
    for number, spec in enumerate(program.legs):
        where = f"{program.name}: legs[{number}]"
        if spec.needs_planes and planes is None:
            raise ConfigurationError(where, f"{vehicle.name}, a vehicle in the plane", "stern planes")
        leg = _leg(spec.manoeuvre, vehicle)
        leg = leg._replace(fin=leg.fin * shares.get(type(spec.manoeuvre), 1.0))
        _check_angle(where, spec.manoeuvre, leg, vehicle.rudder if planes is None else planes, vehicle.rudder)
        legs.append(leg)
    return Manoeuvres(tuple(legs), vehicle.rudder.max_angle, 0.0 if planes is None else planes.max_angle)


def fin_shares(program: Program, vehicle: Vehicle) -> dict[Any, float]:
    """Return by which factor the angles of each kind of manoeuvre are reduced; 1: flown as they stand."""
    shares: dict[Any, float] = {}
    if not program.fits_fins:
        return shares
    of_fins: tuple[tuple[tuple[Any, ...], Rudder | None], ...]
    of_fins = ((_OF_RUDDER, vehicle.rudder), (_OF_PLANES, vehicle.sternplanes))
    for kinds, fin in of_fins:
        fins = [_leg(leg.manoeuvre, vehicle).fin for leg in program.legs if isinstance(leg.manoeuvre, kinds)]
        largest = max(map(abs, fins), default=0.0)
        if fin is not None and largest > fin.max_angle:
            shares.update((kind, fin.max_angle / largest) for kind in kinds)
    return shares


def _check_angle(where: str, spec: Manoeuvre, leg: Leg, planes: Rudder, rudder: Rudder) -> None:
    if not isinstance(spec, (*_OF_RUDDER, *_OF_PLANES)):
        return
    largest = planes if isinstance(spec, _OF_PLANES) else rudder
    if leg.fin == 0.0 or abs(leg.fin) > largest.max_angle + 1e-9:
        found = f"{math.degrees(leg.fin):g} deg"
        raise ConfigurationError(where, found, f"an angle other than 0, up to {largest.max_angle_deg:g} deg")


def _leg(spec: Manoeuvre, vehicle: Vehicle) -> Leg:
    thrust = spec.thrust * vehicle.thrust_max
    time = vehicle.length / vehicle.speed_at(thrust)
    leg = Leg(
        STRAIGHT, spec.seconds, thrust, 0.0, 0.0, math.nan, False, 0.0,
        PER_HEADING, PER_YAW_RATE * time, PER_PITCH, PER_PITCH_RATE * time,
    )  # fmt: skip
    if isinstance(spec, Straight):
        course = math.nan if spec.course_deg is None else math.radians(spec.course_deg)
        return leg._replace(course=course, homeward=spec.towards_start, depth_step=spec.depth_step or 0.0)
    if isinstance(spec, Zigzag):
        return _with(leg, ZIGZAG, spec.rudder_deg, math.radians(spec.heading_deg))
    if isinstance(spec, Circle):
        return _with(leg, CIRCLE, spec.rudder_deg, math.radians(spec.turn_deg))
    if isinstance(spec, PitchZigzag):
        return _with(leg, PITCH_ZIGZAG, spec.planes_deg, math.radians(spec.pitch_deg))
    if isinstance(spec, PlaneStep):
        return _with(leg, PLANE_STEP, spec.planes_deg, math.radians(spec.pitch_deg))
    return _with(leg, DEPTH_ZIGZAG, -spec.pitch_deg, spec.depth)


def _with(leg: Leg, kind: int, fin_deg: float, limit: float) -> Leg:
    return leg._replace(kind=kind, fin=math.radians(fin_deg), limit=limit)
