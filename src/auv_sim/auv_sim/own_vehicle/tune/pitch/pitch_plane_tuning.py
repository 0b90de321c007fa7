"""Gains, flights and figures of the vertical plane, for tuning the stern planes.

Seen from the side pitch takes the place of heading and depth that of the distance to the path, as in
`control.pitch_plane`. So search, objective and acceptance are those of the rudder.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from auv_msgs_py.values.types import Current
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.control.rule.gain_rule import PlaneGains, gains_for
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.spatial.depth_profile import DepthProfile, RampKind
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.spatial.spatial_limits import steepest_at, steepest_of
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch.flight_figures import Flights, SpatialFlights
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.tune.drawn_courses import drawn_course, water
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace, Vector, with_lookahead
from auv_sim.own_vehicle.tune.trial_flights import (
    LATER,
    PATIENCE,
    STRONGEST,
    Amount,
    Conditions,
    Flight,
    line_time,
    thrust_of,
)
from auv_sim.own_vehicle.tune.tuning_problem import TunedPlane
from auv_sim.vehicle.hulls.rigid_body import body_at
from auv_sim.vehicle.sea import Sea

#: Depths that are flown: at most this wide a range (m), and the least in which planes can be tuned.
WIDEST_ROOM, LEAST_ROOM = 40.0, 4.0
#: Hard starts: largest distance above or below the line (m), and largest pitch (share of the steepest).
BELOW, PITCHED = 8.0, 0.8
#: Slope of a ramp over the steepest that the vehicle flies, drawn evenly; level time between ramps, s.
GENTLEST, STEEPEST, LEVEL = 0.2, 0.8, (30.0, 60.0)
#: Flights of one generation and of the acceptance; legs are ramps.
SEARCHED_DIVES = Amount(starts=1, courses=1, legs=3, at_sea=1)
HELD_OUT_DIVES = Amount(starts=8, courses=3, legs=5, at_sea=3)


class PitchSpace(GainSpace):
    """Gains of the stern planes and the vertical look-ahead, beside gains of the heading that stay.

    Args:
        whole: the diving vehicle.
        heading: guidance and autopilot of the horizontal plane.
        delay, step: as of `GainSpace`.
    """

    def __init__(self, whole: Vehicle, heading: GainSet, delay: float, step: float) -> None:
        super().__init__(pitch_plane_of(whole), heading.guidance, delay, step)
        ruled = gains_for(whole, delay, step)
        assert ruled.pitch is not None  # it has planes
        self.model, self._heading, self._pitch = whole, heading, ruled.pitch
        self.ruled = ruled._replace(heading=ruled.pitch)
        self.first = self._clipped(self._point_of_rule())

    @property
    def pitch(self) -> PlaneGains:
        """Gains of the rule for the planes."""
        return self._pitch

    def rule(self) -> GainSet:
        """Return the rule's gains of the planes."""
        return self._beside(self._heading.guidance, self._pitch.autopilot, self._pitch.lookahead)

    def gains(self, point: Sequence[float] | Vector) -> GainSet:
        """Return the gains at a point; its corners have no meaning here."""
        side = super().gains(point)
        return self._beside(self._heading.guidance, side.autopilot, side.guidance.lookahead)

    def point_of(self, gains: GainSet) -> Vector:
        """Return the point of given gains of the planes, as `GainSpace.point_of`."""
        guidance = with_lookahead(gains.guidance, gains.guidance.vertical.lookahead, law="ailos")
        return super().point_of(GainSet(guidance, gains.pitch, gains.pitch))

    def with_planes_of(self, gains: GainSet) -> GainSet:
        """Return the heading's gains of this space with the planes' gains of others."""
        return self._beside(self._heading.guidance, gains.pitch, gains.guidance.vertical.lookahead)

    def _beside(self, guidance: PathFollowerConfig, pitch: AutopilotConfig, lookahead: float) -> GainSet:
        vertical = dataclasses.replace(guidance.vertical, lookahead=lookahead)
        return self._heading._replace(guidance=dataclasses.replace(guidance, vertical=vertical), pitch=pitch)


def room_of(vehicle: Vehicle) -> tuple[float, float]:
    """Return the smallest and the largest depth of the flights, m."""
    top = max(vehicle.depth.surface, vehicle.shallowest) + 1.0
    return top, min(vehicle.depth.max - 1.0, top + WIDEST_ROOM)


def can_be_tuned(vehicle: Vehicle) -> bool:
    """Return whether a vehicle has planes, and the range of depth and the speed that let them work."""
    top, bottom = room_of(vehicle)
    is_fast = vehicle.speed_at(thrust_of(vehicle)) >= vehicle.depth.minimum_speed
    return vehicle.dives and is_fast and bottom - top >= LEAST_ROOM


def draw_dives(
    vehicle: Vehicle, conditions: Conditions, amount: Amount, random: np.random.Generator
) -> list[Flight]:
    """Draw the flights of one hull: level lines, then ramps of depth; arguments as of `draw_flights`."""
    n, at_sea = amount.courses, amount.at_sea if conditions.sea is not None else 0
    kinds: list[tuple[RampKind, bool, float, Sea | None, int]] = [
        ("linear", True, 0.0, None, n), ("smooth", True, STRONGEST, None, n), ("smooth", False, 0.0, None, n),
        ("linear", True, 0.0, conditions.sea, at_sea),
    ]  # fmt: skip
    return [
        *(
            _level(vehicle, conditions, step, random)
            for step in conditions.steps
            for _ in range(amount.starts)
        ),
        *(
            _ramps(vehicle, conditions, kind, is_straight, amount.legs, strongest, sea, random)
            for kind, is_straight, strongest, sea, number in kinds
            for _ in range(number)
        ),
    ]


def _level(vehicle: Vehicle, conditions: Conditions, step: float, random: np.random.Generator) -> Flight:
    """Draw one start above or below a level line, pitched, and up to `LATER` more delay."""
    thrust, late = thrust_of(vehicle), conditions.delay
    planes = vehicle.sternplanes or vehicle.rudder
    top, bottom = room_of(vehicle)
    middle, speed = 0.5 * (top + bottom), vehicle.speed_at(thrust)
    below = random.uniform(-1.0, 1.0) * min(BELOW, 0.5 * (bottom - top))
    theta = random.uniform(-1.0, 1.0) * PITCHED * _steepest(vehicle, thrust)
    length = 2.0 * speed * line_time(vehicle)
    scenario = Scenario(
        path=CompositePath([Line(0.0, 0.0, length, 0.0)]), vehicle=vehicle, thrust=thrust, step=step,
        spatial=SpatialPath([Line(0.0, 0.0, length, 0.0)], DepthProfile.constant(middle, length)),
        time_limit=line_time(vehicle), initial=body_at(0.0, 0.0, middle + below, 0.0, theta, 0.0, speed),
        command_delay=late + random.uniform(0.0, LATER) * (late + planes.dead_time),
    )  # fmt: skip
    return Flight(scenario, True)


def _ramps(
    vehicle: Vehicle, conditions: Conditions, kind: RampKind, is_straight: bool, ramps: int,
    strongest: float, sea: Sea | None, random: np.random.Generator,
) -> Flight:  # fmt: skip
    """Draw ramps along a straight or through rounded corners, and a current of up to `strongest`."""
    thrust = thrust_of(vehicle)
    speed = vehicle.speed_at(thrust)
    (top, bottom), steepest = room_of(vehicle), math.tan(_steepest(vehicle, thrust))
    way, depth = 0.0, random.uniform(top, bottom)
    knots = [(way, depth)]
    for _ in range(ramps):
        way += speed * random.uniform(*LEVEL)
        knots.append((way, depth))
        # Into the wider part of the room.
        other = random.uniform(top, depth) if depth - top > bottom - depth else random.uniform(depth, bottom)
        slope = random.uniform(GENTLEST, STEEPEST) * steepest * (1.0 if kind == "linear" else 0.5)
        way += max(abs(other - depth) / slope, 2.0 * vehicle.length)
        depth = other
        knots.append((way, depth))
    knots.append((way + speed * LEVEL[0], depth))
    path = CompositePath([Line(0.0, 0.0, knots[-1][0], 0.0)])
    if not is_straight:
        path = drawn_course("rounded", tightest_turn(vehicle).radius, ramps, random)
        length = math.fsum(segment.length for segment in path.segments)
        knots = _fitted(knots, length)
    spatial = SpatialPath(path.segments, DepthProfile(knots, kind))
    x, y, z, _, chi = spatial.start_pose
    size, course = random.uniform(0.3, 1.0) * strongest * speed, random.uniform(-math.pi, math.pi)
    scenario = Scenario(
        path=path, spatial=spatial, vehicle=vehicle, thrust=thrust, step=conditions.step, sea=sea,
        initial=body_at(x, y, z, 0.0, 0.0, chi, speed), seed=int(random.integers(2**31)),
        current=Current(size * math.cos(course), size * math.sin(course)), command_delay=conditions.delay,
        time_limit=PATIENCE * spatial.length / speed + 60.0,
    )  # fmt: skip
    return Flight(scenario, False, f"{kind} ramps {water(strongest > 0.0, sea is not None)}")


def _fitted(knots: Sequence[tuple[float, float]], length: float) -> list[tuple[float, float]]:
    """Return knots for a path of a length (m): cut off, or with a level rest."""
    kept = [knot for knot in knots if knot[0] < length - 1.0]
    return [*kept, (length, kept[-1][1])]


def _steepest(vehicle: Vehicle, thrust: float) -> float:
    """Return the steepest pitch that guidance requests, rad."""
    return max(steepest_at(steepest_of(vehicle, thrust), vehicle.speed_at(thrust)), math.radians(2.0))


def seen_from_the_side(flights: Flights) -> Flights:
    """Return flights with depth errors, planes and pitch rate as distances, rudder and yaw rate."""
    if not isinstance(flights, SpatialFlights):
        return flights
    return dataclasses.replace(
        flights,
        rms_distance=flights.rms_depth_error,
        off_corners_rms_distance=flights.steady_rms_depth_error,
        rudder_travel_per_metre=flights.sternplane_travel_per_metre,
        late_rms_yaw_rate=flights.late_rms_pitch_rate,
    )


#: Pitch, by the stern planes.
PITCH = TunedPlane(draw_dives, seen_from_the_side, pitch_plane_of, lambda gains: gains.pitch)
