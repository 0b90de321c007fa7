"""Recordings in other units or with other signs are refused by name, before or after the estimate."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_sim.own_vehicle.identify.combinations import prior_of
from auv_sim.own_vehicle.identify.innovations import channels_of
from auv_sim.own_vehicle.identify.minimise import minimise
from auv_sim.own_vehicle.identify.results import plausibility
from auv_sim.own_vehicle.identify.results.excitation import check_excitation
from auv_sim.own_vehicle.identify.results.plausibility import (
    check_commands,
    check_fit,
    check_speed,
    check_sway,
    check_yaw_rate,
    doubts,
    latency_doubts,
    thrust_doubts,
)
from auv_sim.own_vehicle.identify.study.identified_cases import true_unknowns
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, DataSheet, Scaling
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea

REMUS = vehicle.load("remus100")


@pytest.fixture(scope="module")
def data() -> PlanarData:
    return planar_data(simulate(REMUS, sea.load("rough"), program_file.load("two_minutes"), 1))


@pytest.fixture(scope="module")
def slow_log() -> PlanarData:
    """Return a flight with a good log whose samples are 0.1 s old."""
    flown = simulate(REMUS, sea.load("moderate"), program_file.load("two_minutes"), 1)
    return planar_data(flown)


def test_the_contracts_units_pass(data: PlanarData) -> None:
    check_commands(data.rudder, data.thrust, REMUS, "bag")
    check_yaw_rate([data, data], "bag")
    check_speed([data], REMUS, 1.62, "bag")
    check_sway([data], "bag")
    assert doubts(_found(0.0), [data], REMUS, 1.62) == []
    spikes = data.rudder.copy()
    spikes[:5] = 20.0
    spikes[5 : spikes.size // 5] = 0.8  # a controller that asks for more than there is
    check_commands(spikes, 1.05 * data.thrust, REMUS, "bag")


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (lambda rudder, thrust: (np.degrees(rudder), thrust), r"rudder_cmd: found angles up to 35, .*rad"),
        (
            lambda rudder, thrust: (2.5 * rudder, thrust),
            r"rudder_cmd: found angles up to 1\.53, 35% of them beyond .*share",
        ),
        (lambda rudder, thrust: (rudder, 15.0 * thrust), r"thrust_cmd: found up to 97\.2, .*6\.48 N"),
    ],
)
def test_commands_in_other_units_are_refused(
    data: PlanarData, change: Callable[..., tuple[Any, Any]], found: str
) -> None:
    with pytest.raises(ConfigurationError, match=found):
        check_commands(*change(data.rudder, data.thrust), REMUS, "bag")


@pytest.mark.parametrize("factor", [0.0, 0.01, 100.0])
def test_a_thrust_that_is_far_from_the_speed_is_refused(data: PlanarData, factor: float) -> None:
    """Shares instead of per cent are a hundredth; so small a thrust leaves nothing of the drag."""
    with pytest.raises(ConfigurationError, match=r"thrust_cmd: .*1\.\d+ m/s measured, expected thrust in N"):
        check_speed([data._replace(thrust=factor * data.thrust)], REMUS, 1.62, "bag")


def test_the_speed_is_that_of_the_thrust_in_force(data: PlanarData) -> None:
    """A thrust that is sent only when it changes has few values, and a vehicle at rest says nothing of it."""
    thrust = float(np.median(data.thrust))
    rare = data._replace(thrust_t=data.t[[0, 20, -1]], thrust=np.array([0.0, thrust, 0.0]))
    check_speed([rare], REMUS, 1.62, "bag")
    later = data.water_t > np.quantile(data.water_t, 0.7)
    resting = rare._replace(thrust_t=data.t[[0, int(0.7 * data.t.size)]], thrust=np.array([0.0, thrust]))
    check_speed([resting._replace(u=np.where(later, data.u, 0.01))], REMUS, 1.62, "bag")
    with pytest.raises(ConfigurationError, match=r"makes 0\.00 m/s"):
        check_speed([rare._replace(thrust=np.zeros(3))], REMUS, 1.62, "bag")


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (lambda d: d._replace(r=np.degrees(d.r)), r"yaw rate of 57\.\d times"),
        (lambda d: d._replace(r=-d.r), r"yaw rate of -1 times|yaw rate of -0\.99"),
        (lambda d: d._replace(t=np.linspace(d.t[0], d.t[0] + 60.0, d.t.size)), r"yaw rate of 0\.\d+ times"),
    ],
    ids=["deg/s", "sign", "stamps"],
)
def test_a_yaw_rate_that_is_not_the_headings_is_refused(
    data: PlanarData, change: Callable[[PlanarData], PlanarData], found: str
) -> None:
    with pytest.raises(ConfigurationError, match=found):
        check_yaw_rate([change(data)], "bag")


def test_a_velocity_with_other_axes_is_refused(data: PlanarData) -> None:
    with pytest.raises(ConfigurationError, match=r"bag: velocity_through_water: found sway to the inside"):
        check_sway([data._replace(v=-data.v)], "bag")
    with pytest.raises(ConfigurationError, match=r"bag: velocity_through_water: .* ahead of -1\.\d+ m/s"):
        check_excitation([data._replace(u=-data.u)], "bag")


def test_a_recording_without_a_yaw_rate_is_refused_by_its_name(data: PlanarData) -> None:
    none = data._replace(name="second", t=data.t[:0], r=data.r[:0], psi=data.psi[:0])
    with pytest.raises(
        ConfigurationError, match=r"^second: odom: found no finite yaw rate while there are commands"
    ):
        check_excitation([data, none], "first, second")
    with pytest.raises(ConfigurationError, match=r"^second: found 0 s with odometry, commands and"):
        check_excitation([data, data._replace(name="second", water_t=data.water_t + 1e6)], "first, second")


@pytest.mark.parametrize("error", [0.36, 1e200, math.nan])
def test_a_hull_that_explains_nothing_is_refused(monkeypatch: pytest.MonkeyPatch, error: float) -> None:
    prediction = SimpleNamespace(starts=40, error=error)
    monkeypatch.setattr(plausibility, "predictions_of", lambda *_: [prediction])
    with pytest.raises(ConfigurationError, match=r"bag: .*predicts the yaw rate over 2 s .* rudder_cmd"):
        check_fit(_found(0.0), "bag")
    prediction.error = 0.05
    check_fit(_found(0.0), "bag")


def test_late_commands_and_a_thrust_of_another_unit_raise_doubts(data: PlanarData) -> None:
    late, slow = doubts(_found(-0.07), [data._replace(thrust=data.thrust / 20.0)], REMUS, 1.62)
    assert "-0.070 s" in late and "thrust_cmd" in slow
    percent = dataclasses.replace(REMUS, name="strong")
    (fast,) = doubts(_found(0.1), [data._replace(thrust=20.0 * data.thrust)], percent, 1.62)
    assert fast.startswith("1.") and "strong makes" in fast


@pytest.mark.parametrize(("latency", "side"), [(0.1, None), (1.5, "less"), (0.0, "more")])
def test_a_given_latency_that_the_data_contradict_raises_a_doubt(
    slow_log: PlanarData, latency: float, side: str | None
) -> None:
    sheet = DataSheet(latency=latency)
    scaling, channels = Scaling(prior_of(REMUS.coefficients), sheet), channels_of([slow_log], sheet, 0.0)
    estimate = minimise(channels, scaling, np.zeros(ALL), rounds=3)
    found: Any = SimpleNamespace(channels=channels, scaling=scaling, estimate=estimate)
    lines = latency_doubts(found)
    assert len(lines) == (side is not None)
    if side is not None:
        assert lines[0].startswith(f"--log-latency {latency:g}: the data show {side}")
    free = found.scaling._replace(sheet=sheet._replace(latency_deviation=0.08))
    assert latency_doubts(SimpleNamespace(channels=channels, scaling=free, estimate=estimate)) == []  # type: ignore[arg-type]


def _found(dead_time: float) -> Any:
    physical = np.zeros(ALL)
    physical[DEAD_TIME] = dead_time
    return SimpleNamespace(channels=None, physical=physical)


@pytest.mark.parametrize(("low", "sign"), [(1.0, None), (1.1, "+"), (0.9, "-")])
def test_a_thrust_of_another_shape_than_the_files_raises_a_doubt(
    slow_log: PlanarData, low: float, sign: str | None
) -> None:
    """Where low > 1, low thrust pushes less than its numbers say, so that high thrust seems to push more."""
    thrust = np.where(slow_log.thrust < 0.7 * REMUS.thrust_max, low * slow_log.thrust, slow_log.thrust)
    channels = channels_of([slow_log._replace(thrust=thrust)], DataSheet(), math.radians(0.2))
    found: Any = SimpleNamespace(channels=channels, physical=true_unknowns(REMUS, sea.load("moderate")))
    lines = thrust_doubts(found)
    assert len(lines) == (sign is not None)
    if sign is not None:
        assert re.match(rf"the thrust's error at high thrust .* low thrust is \{sign}\d+ %: ", lines[0])
