"""Heave, roll and pitch act on surge, sway and yaw: given to the filter in the plane, moved by the data."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import Hull
from auv_sim.own_vehicle.identify import identification
from auv_sim.own_vehicle.identify.combinations import combinations_of, prior_of
from auv_sim.own_vehicle.identify.dive.vertical_motion import VerticalMotion, vertical_loads_of
from auv_sim.own_vehicle.identify.innovations import Channels, channels_of, innovations
from auv_sim.own_vehicle.identify.minimise import minimise
from auv_sim.own_vehicle.identify.refine import vertical_loads as refine_loads
from auv_sim.own_vehicle.identify.refine.own_trims import shifts_of
from auv_sim.own_vehicle.identify.refine.vertical_loads import load_columns
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.time_grid import PlanarData, passage_of
from auv_sim.own_vehicle.identify.unknowns import ALL, COUNT, RATE, DataSheet, Scaling
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import Manoeuvred, simulate

REMUS = vehicle_file.load("remus100_6dof")
HULL = REMUS.coefficients
assert HULL.vertical is not None
VERTICAL = HULL.vertical
TRIMMED = dataclasses.replace(HULL, vertical=dataclasses.replace(VERTICAL, B=VERTICAL.W))
BUOYANT = (VERTICAL.B - VERTICAL.W) / (HULL.m - HULL.Xud)
SHEET = DataSheet(latency=0.0, dead_time=0.0, half_play=0.0)


@pytest.fixture(scope="module")
def flown() -> Manoeuvred:
    """Two minutes of dives with ideal instruments."""
    return simulate(REMUS, None, program_file.load("two_minutes_dive"))


def recorded(flown: Manoeuvred, known: Hull | None, seconds: float = 1e9) -> PlanarData:
    begin = float(flown.t[flown.leg > 0][0])
    return planar_data(flown, diving=known).between(begin, begin + seconds)


def channels_with(flown: Manoeuvred, is_known: bool) -> Channels:
    return channels_of([recorded(flown, HULL if is_known else None)], SHEET, 0.0)


def surge_by_pitch(channels: Channels) -> float:
    """Surge acceleration by the sine of the pitch, m/s^2: that of the buoyancy."""
    loads = channels.passages[0].loads
    assert loads is not None
    return float(loads.assumed.mean[0, 6] + channels.loads_off @ loads.assumed.deviations[:, 0, 6])


def still(done: int, total: int, what: str) -> None:
    """Report no progress."""


def truth() -> np.ndarray:  # type: ignore[type-arg]
    physical = np.zeros(ALL)
    physical[:COUNT], physical[RATE] = combinations_of(HULL), REMUS.rudder.max_rate
    return physical


def test_the_planar_motion_of_a_dive_is_predicted_with_the_motion_in_the_vertical(flown: Manoeuvred) -> None:
    errors = {}
    for is_known in (False, True):
        channels = channels_with(flown, is_known)
        off = innovations(channels, truth())
        errors[is_known] = [float(np.std(off[channels.rows == row])) for row in range(3)]
    yaw_rate, surge, sway = (with_it / without for without, with_it in zip(*errors.values(), strict=True))
    assert yaw_rate < 0.18 and surge < 0.07 and sway < 0.1


def test_what_is_given_for_a_step_is_the_motion_in_its_middle() -> None:
    t = np.arange(0.0, 20.0, 0.05)
    nose_down, turn, log = -0.02 * t, np.full(t.size, 0.1), t[::4]
    motion = VerticalMotion(
        t, 0.3 + 0.0 * t, nose_down, 0.05 + 0.0 * t, log, 0.0 * log, vertical_loads_of(HULL, VERTICAL)
    )
    still = 0.0 * t
    data = PlanarData(
        "turn", t, turn, log, 1.5 + 0.0 * log, 0.0 * log, t, still, t, still, still, still, still, still,
        motion,
    )  # fmt: skip
    passage = passage_of(data, 0.0)
    assert passage.loads is not None
    theta = -0.02 * 0.5 * (passage.times[:-1] + passage.times[1:])
    p = -(0.1 * math.cos(0.3) + 0.05 * math.sin(0.3)) * np.tan(theta)  # of a roll that stays
    inside = slice(10, -10)
    assert passage.loads.products[inside, 6] == pytest.approx(np.sin(theta)[inside], rel=1e-9)
    assert passage.loads.products[inside, 2] == pytest.approx(0.1 * p[inside], rel=1e-6)


def test_the_data_correct_a_load_that_is_assumed_wrongly(flown: Manoeuvred) -> None:
    channels = channels_with(flown, True)
    wrong = channels.loads_off.copy()
    wrong[0] = -0.8  # Xwq: heave times pitch rate, on surge
    channels, scaling = channels.with_loads_off(wrong), Scaling(prior_of(HULL), SHEET)
    estimate = minimise(channels, scaling, scaling.scaled(truth()), rounds=1, steps=1)
    shifts = shifts_of(channels, scaling, estimate, load_columns(channels, scaling, estimate), wrong)
    assert shifts.values[0] == pytest.approx(0.8, abs=0.15)


def test_the_data_show_a_buoyancy_that_the_file_does_not_have(flown: Manoeuvred) -> None:
    channels, scaling = channels_of([recorded(flown, TRIMMED)], SHEET, 0.0), Scaling(prior_of(HULL), SHEET)
    assert surge_by_pitch(channels) == 0.0
    estimate = minimise(channels, scaling, scaling.scaled(truth()), rounds=1, steps=1)
    columns = load_columns(channels, scaling, estimate)
    shifts = shifts_of(channels, scaling, estimate, columns, channels.loads_off)
    assert surge_by_pitch(channels.with_loads_off(shifts.values)) == pytest.approx(BUOYANT, rel=0.15)


def test_starts_are_minimised_and_compared_with_the_buoyancy_that_fits(
    flown: Manoeuvred, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Buoyancy that is left out makes second minima, and noise that no later step takes back."""
    monkeypatch.setattr(refine_loads, "_STEPS", 2)
    data, prior = recorded(flown, TRIMMED, 15.0), prior_of(HULL)
    ((channels, scaling, estimate),) = identification._from_starts(
        [data], [(prior, 0.0)], SHEET, 0.0, still, 1
    )
    assert surge_by_pitch(channels) == pytest.approx(BUOYANT, rel=0.3)
    unknown = channels.with_loads_off(0.0 * channels.loads_off)
    channels, _, _ = identification._anew(unknown, scaling, estimate, [])
    assert surge_by_pitch(channels) == pytest.approx(BUOYANT, rel=0.3)


def test_without_motion_in_the_vertical_nothing_is_given(flown: Manoeuvred) -> None:
    channels = channels_with(flown, False)
    assert not channels.passages[0].grid.given.any()
    assert channels.with_loads_off(np.zeros(0)).loads_off.size == 0
    known = channels_with(flown, True)
    assert (known.with_loads_off(np.zeros(0)).loads_off == known.loads_off).all()
