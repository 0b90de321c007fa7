"""The flights by which gains are judged: straight lines from hard starts, courses in currents, a sea.

Starts, rates, delays, courses and currents are drawn. Search and acceptance draw from different seeds.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from auv_msgs_py.values.types import Current
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.rule.fin_response import COURSE_LENGTHS, COURSE_TURNS
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.approach import ApproachConfig
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.flight.batch.tally import calm_time
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.tune.drawn_courses import TIGHTEST, WORDS, Kind, drawn_course, water
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sea import Sea

#: Share by which the delay of a flight on a line may be longer than stated.
LATER = 0.15
#: Starts on a line: largest distance beside it over the radius of the turn, largest rate over the turn's.
BESIDE, TURNING = 4.0, 0.75
#: Current over the speed through the water, drawn evenly up to this.
STRONGEST = 0.25
#: Least radius that the hull's turn counts as where courses are drawn, hull lengths; as in the rule.
NARROWEST = COURSE_LENGTHS / COURSE_TURNS
#: Courses in the sea by which gains are proven: legs, and least radius of their turns over the hull's.
PROVEN_LEGS, PROVEN_TURN = 5, 2.5
#: A flight along a course ends at this many times the time that it takes straight ahead, and 60 s later.
PATIENCE = 1.6
#: Kinds of proven courses; those of straight legs are for the laws that know no others.
COURSES: tuple[Kind, ...] = ("sharp", "rounded", "survey")
STRAIGHT: tuple[Kind, ...] = ("sharp",)


class Conditions(NamedTuple):
    """What the gains are for.

    Attributes:
        delay: from a measurement to the arrival of its command, s; dead times of the fins are added.
        step: between two odometries on courses, s.
        steps: between two odometries on lines, s; each is flown.
        sea: imperfections of one flight; None for none.
        kinds: of the courses, in turn; the first replaces missing ones. Gentle bends go with rounded corners.
    """

    delay: float
    step: float
    steps: tuple[float, ...]
    sea: Sea | None
    kinds: tuple[Kind, ...] = COURSES


class Flight(NamedTuple):
    """One flight without its gains: a scenario whose laws are replaced.

    Attributes:
        is_line: whether it is along a line.
        kind: of a course and its water, in words; empty on a line.
    """

    scenario: Scenario
    is_line: bool
    kind: str = ""


class Amount(NamedTuple):
    """How many flights: starts on the line for each rate; courses of each kind and water; legs; at sea."""

    starts: int
    courses: int
    legs: int
    at_sea: int


#: Of one generation of the search, and of the acceptance.
SEARCHED = Amount(starts=2, courses=1, legs=5, at_sea=1)
HELD_OUT = Amount(starts=16, courses=3, legs=7, at_sea=4)


def draw_flights(
    vehicle: Vehicle, conditions: Conditions, amount: Amount, random: np.random.Generator
) -> list[Flight]:
    """Draw the flights of one hull.

    Args:
        vehicle: the plant.
        conditions: delay, rates, sea.
        amount: how many.
        random: where the numbers come from.
    """
    return [
        *_on_lines(vehicle, conditions, amount.starts, random),
        *_along_courses(vehicle, conditions, amount, random),
    ]


def _on_lines(
    vehicle: Vehicle, conditions: Conditions, starts: int, random: np.random.Generator
) -> list[Flight]:
    return [
        _on_line(vehicle, conditions.delay, step, random) for step in conditions.steps for _ in range(starts)
    ]


def _on_line(vehicle: Vehicle, late: float, step: float, random: np.random.Generator) -> Flight:
    """Draw one start beside a line, and up to `LATER` more delay than `late` (s)."""
    thrust, turn = thrust_of(vehicle), tightest_turn(vehicle)
    whole, speed = late + vehicle.rudder.dead_time, vehicle.speed_at(thrust)
    beside = random.uniform(-1.0, 1.0) * BESIDE * turn.radius
    heading, rate = random.uniform(-math.pi, math.pi), random.uniform(-1.0, 1.0) * TURNING * turn.rate
    scenario = Scenario(
        path=LINE, vehicle=vehicle, thrust=thrust, step=step, time_limit=line_time(vehicle),
        initial=start_at(vehicle, beside, heading, speed, rate),
        command_delay=late + random.uniform(0.0, LATER) * whole,
    )  # fmt: skip
    return Flight(scenario, True)


def draw_starts(
    hulls: Sequence[Vehicle], conditions: Conditions, random: np.random.Generator
) -> list[Flight]:
    """Draw one start beside a line for each hull; the odometry rates have equal shares of them."""
    each = math.ceil(len(hulls) / len(conditions.steps))
    return [
        _on_line(hull, conditions.delay, conditions.steps[k // each], random) for k, hull in enumerate(hulls)
    ]


def _along_courses(
    vehicle: Vehicle, conditions: Conditions, amount: Amount, random: np.random.Generator
) -> list[Flight]:
    n, sharp = amount.courses, conditions.kinds[0]
    rounded, survey = (kind if kind in conditions.kinds else sharp for kind in COURSES[1:])
    kinds: list[tuple[Kind, float, Sea | None, int]] = [
        (sharp, 0.0, None, n), (sharp, STRONGEST, None, n),
        (rounded, 0.0, None, n), (rounded, STRONGEST, None, n), (survey, STRONGEST, None, n),
        (rounded, 0.0, conditions.sea, amount.at_sea if conditions.sea is not None else 0),
        ("gentle" if rounded != sharp else sharp, STRONGEST, None, n),
    ]  # fmt: skip
    return [
        _along(vehicle, conditions, kind, amount.legs, strongest, sea, random)
        for kind, strongest, sea, number in kinds
        for _ in range(number)
    ]


def draw_sea_flights(
    hulls: Sequence[Vehicle], conditions: Conditions, random: np.random.Generator
) -> list[Flight]:
    """Draw one flight for each hull, in the sea and a further current; the kinds of courses take turns."""
    kinds = conditions.kinds
    # 0: the hull's own turn counts, however tight.
    further = PROVEN_LEGS, STRONGEST, conditions.sea, random, PROVEN_TURN, 0.0
    return [_along(hull, conditions, kinds[k % len(kinds)], *further) for k, hull in enumerate(hulls)]


def _along(
    vehicle: Vehicle, conditions: Conditions, kind: Kind, legs: int, strongest: float, sea: Sea | None,
    random: np.random.Generator, tightest: float = TIGHTEST, narrowest: float = NARROWEST,
) -> Flight:  # fmt: skip
    """Draw one course, and a current of up to `strongest` times the speed.

    Turns have at least `tightest` times the hull's radius, which counts as at least `narrowest` lengths.
    """
    thrust, turn = thrust_of(vehicle), tightest_turn(vehicle)
    speed = vehicle.speed_at(thrust)
    path = drawn_course(kind, max(turn.radius, narrowest * vehicle.length), legs, random, tightest)
    size, course = random.uniform(0.3, 1.0) * strongest * speed, random.uniform(-math.pi, math.pi)
    scenario = Scenario(
        path=path, vehicle=vehicle, thrust=thrust, initial=_on_path(vehicle, path, speed),
        current=Current(size * math.cos(course), size * math.sin(course)), sea=sea,
        seed=int(random.integers(2**31)), step=conditions.step, command_delay=conditions.delay,
        time_limit=PATIENCE * path.length / speed + 60.0,
    )  # fmt: skip
    return Flight(scenario, False, f"{WORDS[kind]} {water(strongest > 0.0, sea is not None)}")


def line_time(vehicle: Vehicle) -> float:
    """Return how long a flight on a line lasts, s; its yaw rate counts in the second half."""
    return 2.0 * calm_time(vehicle)


def thrust_of(vehicle: Vehicle) -> float:
    """Return the thrust of the design: that of the measured cruise, else the largest, N."""
    return vehicle.thrust_max if vehicle.cruise is None else vehicle.cruise.thrust


def start_at(
    vehicle: Vehicle, y: float, heading: float, speed: float, rate: float, x: float = 0.0
) -> PlantState | BodyState:
    """Return a first state: position and speed in m and m/s, heading and yaw rate in rad and rad/s."""
    if not vehicle.dives:
        return PlantState(x, y, heading, speed, 0.0, rate)
    depth = max(vehicle.depth.surface, vehicle.shallowest)
    return body_at(x, y, depth, 0.0, 0.0, heading, speed)._replace(r=rate)


def _on_path(vehicle: Vehicle, path: CompositePath, speed: float) -> PlantState | BodyState:
    x, y, chi = path.start_pose
    return start_at(vehicle, y, chi, speed, 0.0, x)


def with_laws(flight: Flight, flown: GainSet, model: Vehicle) -> Scenario:
    """Return a flight with gains; on a line guidance begins at once, without an approach.

    Args:
        flight: without its gains.
        flown: the gains.
        model: the vehicle that guidance and autopilots assume.
    """
    guidance = flown.guidance
    if flight.is_line:
        guidance = dataclasses.replace(guidance, approach=ApproachConfig(enabled=False))
    return dataclasses.replace(
        flight.scenario, guidance=guidance, autopilot=flown.autopilot, pitch=flown.pitch,
        controller_vehicle=model, peer=flown.peer,
    )  # fmt: skip


def fly_all(
    flights: Sequence[Flight], candidates: Sequence[GainSet], model: Vehicle, threads: int, courses: Courses
) -> list[Flights]:
    """Fly every flight with every set of gains; return the figures of each set."""
    scenarios = [with_laws(flight, flown, model) for flown in candidates for flight in flights]
    found = engine.fly(scenarios, threads, courses=courses)
    n = len(flights)
    return [_rows(found, slice(k * n, (k + 1) * n)) for k in range(len(candidates))]


def _rows(flights: Flights, rows: slice) -> Flights:
    names = [field.name for field in dataclasses.fields(flights)]
    return type(flights)(**{name: getattr(flights, name)[rows] for name in names})


LINE = CompositePath([Line(0.0, 0.0, 2000.0, 0.0)])
