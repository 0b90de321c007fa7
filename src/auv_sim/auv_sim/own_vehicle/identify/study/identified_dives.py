"""One simulated diver, identified in the vertical and in the plane, and compared with the truth."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from auv_path_following.vehicle import Hull, Vehicle
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers, combinations_of
from auv_sim.own_vehicle.identify.dive.dive_combinations import (
    DiveCombinations,
    dive_combinations_of,
    vertical_with,
)
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData, coupling_of
from auv_sim.own_vehicle.identify.identification import Identified, identify, identify_dive
from auv_sim.own_vehicle.identify.study.identified_cases import left_out_errors
from auv_sim.own_vehicle.identify.study.random_divers import known_diver, random_diver
from auv_sim.own_vehicle.identify.study.simulated_data import dive_data, planar_data
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, HALF_PLAY, LATENCY, RATE
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea as sea_file
from auv_sim.vehicle.sea import Sea

#: The program that is left out of every identification, and the pitch rate of the judged damping, rad/s.
LEFT_OUT, PITCHING = "two_minutes_dive", math.radians(10.0)


class DiveCase(NamedTuple):
    """What to identify: seed of vehicle and sea, program, sea."""

    seed: int
    program: str
    sea: str


class JudgedDive(NamedTuple):
    """Errors of one identification.

    Attributes:
        case: what was identified.
        length: of the hull, m.
        planes, righting, damping: shares; of the planes' pitch acceleration, the squared pitch frequency
            at rest, and the damping of pitch at full thrust and `PITCHING`.
        buoyancy: of weight less buoyancy with the masses as assumed, N.
        dead_time: s.
        shares: claimed standard deviations of the combinations, as shares of their values.
        scores: their errors over the claimed standard deviations.
        two, ten: error of the pitch rate on left-out manoeuvres over 2 s and 10 s, shares.
        true_two, true_ten: the same with the true coefficients.
        plane_shares, plane_scores: as `shares` and `scores`, of the combinations in the plane.
    """

    case: DiveCase
    length: float
    planes: float
    righting: float
    damping: float
    buoyancy: float
    dead_time: float
    shares: tuple[float, ...]
    scores: tuple[float, ...]
    two: float
    ten: float
    true_two: float
    true_ten: float
    plane_shares: tuple[float, ...]
    plane_scores: tuple[float, ...]


class Claims(NamedTuple):
    """Claimed standard deviations of combinations as shares of their values, and errors over them."""

    shares: tuple[float, ...]
    scores: tuple[float, ...]


def dive_outcome_of(case: DiveCase) -> JudgedDive:
    """Fly a program and what is left out in one go, identify and compare."""
    vehicle, sea = random_diver(case.seed), sea_file.load(case.sea)
    known = known_diver(vehicle.length)
    program, further = program_file.load(case.program), program_file.load(LEFT_OUT)
    flown = simulate(
        vehicle, sea, dataclasses.replace(program, legs=(*program.legs, *further.legs)), case.seed
    )
    data = dive_data(flown, coupling_of(known, _vertical(known)))
    begin = float(data.t[0]) - 1.0
    end = float(flown.t[flown.leg <= len(program.legs)][-1]) + 1e-6  # leg 0 is the way to the depth
    found = identify_dive([data.between(begin, end)], known, _vertical(known))
    plane = identify([planar_data(flown, diving=known).between(begin, end)], known)
    in_plane = _claims(plane, np.array(combinations_of(vehicle.coefficients)))
    return _compared(case, vehicle, sea, data.between(end, math.inf), found, in_plane)


def _claims(found: Identified, true: Numbers) -> Claims:
    p, sd = found.physical[:COUNT], found.spread.deviations[:COUNT]
    return Claims(tuple((sd / np.abs(p)).tolist()), tuple(((p - true) / sd).tolist()))


def _vertical(hull: Hull) -> VerticalHull:
    assert hull.vertical is not None
    return hull.vertical


def _compared(
    case: DiveCase, vehicle: Vehicle, sea: Sea, left_out: DiveData, found: Identified, in_plane: Claims
) -> JudgedDive:
    truth, known = true_dive_unknowns(vehicle, sea), known_diver(vehicle.length)
    true, vertical = truth[:COUNT], _vertical(vehicle.coefficients)
    c, t = DiveCombinations(*map(float, found.physical[:COUNT])), DiveCombinations(*map(float, true))
    written = vertical_with(c, known.m, _vertical(known))
    two, ten = left_out_errors(left_out, found, found.physical)
    true_two, true_ten = left_out_errors(left_out, found, truth)
    return JudgedDive(
        case,
        vehicle.length,
        c.Muud / t.Muud - 1.0,
        c.Msin / t.Msin - 1.0,
        damping_of(c, vehicle.top_speed) / damping_of(t, vehicle.top_speed) - 1.0,
        written.W - written.B - (vertical.W - vertical.B),
        float(found.physical[DEAD_TIME] - truth[DEAD_TIME]),
        *_claims(found, true),
        two,
        ten,
        true_two,
        true_ten,
        *in_plane,
    )


def damping_of(c: DiveCombinations, speed: float) -> float:
    """Return the pitch acceleration by `PITCHING` over that rate, 1/s."""
    return float(-(c.Muq * speed + c.Mqq * PITCHING))


def true_dive_unknowns(vehicle: Vehicle, sea: Sea) -> Numbers:
    """Return the true unknowns; biases are those of good instruments."""
    hull, planes = vehicle.coefficients, vehicle.sternplanes
    assert planes is not None
    found = np.zeros(ALL)
    found[:COUNT] = dive_combinations_of(hull.m, _vertical(hull))
    found[RATE] = planes.max_rate
    found[DEAD_TIME] = planes.dead_time + sea.sternplanes.dead_time
    found[HALF_PLAY] = math.radians(0.5 * sea.sternplanes.backlash_deg)
    found[LATENCY] = sea.sensors.water_track.latency
    return found
