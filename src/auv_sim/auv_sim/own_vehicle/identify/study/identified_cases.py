"""One simulated vehicle, identified and compared with the truth."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers, combinations_of
from auv_sim.own_vehicle.identify.hull_abilities import abilities_of, pole_of, radius_of, speed_of
from auv_sim.own_vehicle.identify.identification import Identified, identify
from auv_sim.own_vehicle.identify.innovations import Recording, channels_of
from auv_sim.own_vehicle.identify.predictions import predictions_of
from auv_sim.own_vehicle.identify.study.random_hulls import random_vehicle
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data, thrust_share
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, HALF_PLAY, LATENCY, RATE
from auv_sim.own_vehicle.identify.water_current import mean_current
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea as sea_file
from auv_sim.vehicle.sea import Sea

#: The known vehicle of every identification, and the program that is left out of it.
KNOWN, LEFT_OUT = "remus100", "two_minutes"


class Case(NamedTuple):
    """What to identify: seed of vehicle and sea, whether stable in yaw, program, sea."""

    seed: int
    stable: bool
    program: str
    sea: str


class Judged(NamedTuple):
    """Errors of one identification. Speed and what grows with it are compared as the vehicle flew.

    Attributes:
        case: what was identified.
        pole: the true one, 1/s.
        b, radius, speed: shares; of the effect of the rudder, the tightest turn, the speed ahead.
        pole_off: 1/s.
        dead_time: s.
        rate: share.
        current: larger error of both components, m/s.
        shares: claimed standard deviations of the combinations, as shares of their values.
        scores: their errors over the claimed standard deviations.
        two, ten: error of the yaw rate on left-out manoeuvres over 2 s and 10 s, shares.
        true_two, true_ten: the same with the true coefficients.
    """

    case: Case
    pole: float
    b: float
    radius: float
    speed: float
    pole_off: float
    dead_time: float
    rate: float
    current: float
    shares: tuple[float, ...]
    scores: tuple[float, ...]
    two: float
    ten: float
    true_two: float
    true_ten: float


class FlownCase(NamedTuple):
    """One flight: the part to identify, the part that is left out, and the mean true current of the first."""

    used: PlanarData
    left_out: PlanarData
    current: Numbers


def outcome_of(case: Case) -> Judged:
    """Fly, identify and compare."""
    vehicle, sea = random_vehicle(case.seed, case.stable), sea_file.load(case.sea)
    recorded = recorded_of(case, vehicle, sea)
    return _compared(case, vehicle, sea, recorded, identify([recorded.used], _known().coefficients))


def recorded_of(case: Case, vehicle: Vehicle, sea: Sea) -> FlownCase:
    """Fly the program and what is left out in one go: the errors of the instruments are those of one run."""
    program, further = program_file.load(case.program), program_file.load(LEFT_OUT)
    joined = dataclasses.replace(program, legs=(*program.legs, *further.legs))
    flown = simulate(vehicle, sea, joined, case.seed)
    own = flown.leg < len(program.legs)
    end, data = float(flown.t[own][-1]) + 1e-6, planar_data(flown)
    used, left_out = data.between(float(data.t[0]) - 1.0, end), data.between(end, math.inf)
    return FlownCase(used, left_out, flown.current[own].mean(axis=0))


def _known() -> Vehicle:
    return vehicle_file.load(KNOWN)


def _compared(case: Case, vehicle: Vehicle, sea: Sea, recorded: FlownCase, found: Identified) -> Judged:
    true = combinations_of(vehicle.coefficients)
    speed = speed_of(true, vehicle.thrust_max * thrust_share(sea, case.seed))
    radius = radius_of(true, vehicle, 1.0)
    known = dataclasses.replace(_known(), rudder=vehicle.rudder)
    named = {one.name: one.value for one in abilities_of(found.physical, found.spread, known)}
    p, sd = found.physical[:COUNT], found.spread.deviations[:COUNT]
    two, ten = left_out_errors(recorded.left_out, found, found.physical)
    true_two, true_ten = left_out_errors(recorded.left_out, found, true_unknowns(vehicle, sea))
    return Judged(
        case,
        pole_of(true, speed),
        named["effect of the rudder b"] / (abs(true.Nuud) * speed**2) - 1.0,
        named["radius, full rudder"] / radius - 1.0,
        named["speed"] / speed - 1.0,
        named["yaw pole"] - pole_of(true, speed),
        float(found.physical[DEAD_TIME]) - vehicle.rudder.dead_time - sea.rudder.dead_time,
        float(found.physical[RATE]) / vehicle.rudder.max_rate - 1.0,
        _current_off(recorded),
        tuple((sd / np.abs(p)).tolist()),
        tuple(((p - np.array(true)) / sd).tolist()),
        two,
        ten,
        true_two,
        true_ten,
    )


def true_unknowns(vehicle: Vehicle, sea: Sea) -> Numbers:
    """Return the true unknowns; biases are those of good instruments."""
    found = np.zeros(ALL)
    found[:COUNT] = combinations_of(vehicle.coefficients)
    found[RATE] = vehicle.rudder.max_rate
    found[DEAD_TIME] = vehicle.rudder.dead_time + sea.rudder.dead_time
    found[HALF_PLAY] = math.radians(0.5 * sea.rudder.backlash_deg)
    found[LATENCY] = sea.sensors.water_track.latency
    return found


def left_out_errors(left_out: Recording, found: Identified, physical: Numbers) -> tuple[float, float]:
    """Return the errors of left-out manoeuvres predicted over 2 s and 10 s, shares.

    Args:
        left_out: their recording.
        found: an identification that did not use it.
        physical: unknowns to predict with, those found or the true ones.
    """
    channels = channels_of([left_out], found.scaling.sheet, found.dead_band)
    two, ten = predictions_of(channels, physical)
    return two.error, ten.error


def _current_off(recorded: FlownCase) -> float:
    found = mean_current(recorded.used)
    if found is None:
        return math.nan
    north, east, _ = recorded.current
    return float(max(abs(found.north - north), abs(found.east - east)))
