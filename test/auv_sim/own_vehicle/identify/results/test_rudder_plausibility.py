"""A rudder in shares, in degrees, or with the other sign: what shows it, and the option that says so."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_sim.own_vehicle.identify.combinations import combinations_of
from auv_sim.own_vehicle.identify.results.known_vehicle import known_hull
from auv_sim.own_vehicle.identify.results.rudder_plausibility import (
    check_rudder,
    check_rudder_sign,
    share_doubts,
)
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import ALL, RATE
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import Manoeuvred, simulate
from auv_sim.own_vehicle.verbs.reading.fin_units import units_of
from auv_sim.own_vehicle.verbs.reading.recordings_read import read
from auv_sim.vehicle import sea
from manoeuvre_bag import write_manoeuvres

REMUS = vehicle.load("remus100")
LARGEST = REMUS.rudder.max_angle


@pytest.fixture(scope="module")
def flown() -> Manoeuvred:
    return simulate(REMUS, sea.load("rough"), program_file.load("two_minutes"), 1)


def _read(bag: Path, *units: str) -> PlanarData:
    options = argparse.Namespace(topic=[], frame=[], unit=list(units), bag=[bag], namespace=None)
    (recorded,) = read(options, REMUS, known_hull(REMUS))
    return recorded.plane


@pytest.mark.parametrize(
    ("unit", "factor"),
    [("share", 1.0 / LARGEST), ("-percent", -100.0 / LARGEST), ("deg", 180.0 / math.pi), ("-rad", -1.0)],
)
def test_a_rudder_is_read_in_the_unit_that_is_given(
    flown: Manoeuvred, tmp_path: Path, unit: str, factor: float
) -> None:
    bag = write_manoeuvres(tmp_path / "bag", flown._replace(rudder=factor * flown.rudder))
    with pytest.raises(ConfigurationError, match=r"--unit rudder_cmd="):
        check_rudder_sign([_read(bag)], "bag")
    found = _read(bag, f"rudder_cmd={unit}")
    assert found.rudder == pytest.approx(flown.rudder, abs=1e-9)
    check_rudder_sign([found], "bag")


@pytest.mark.parametrize(
    ("given", "found"),
    [
        (["rudder_cmd=turns"], "--unit: found rudder_cmd=turns"),
        (["thrust_cmd=percent"], "--unit: found thrust_cmd=percent"),
        (["rudder_cmd=deg", "rudder_cmd=rad"], "--unit rudder_cmd: found deg and rad"),
    ],
)
def test_a_wrong_unit_costs_one_line(given: list[str], found: str) -> None:
    with pytest.raises(ConfigurationError, match=found):
        units_of(given)


def test_commands_that_the_unit_cannot_have_are_refused(flown: Manoeuvred, tmp_path: Path) -> None:
    bag = write_manoeuvres(tmp_path / "bag", flown._replace(rudder=np.degrees(flown.rudder)))
    with pytest.raises(
        ConfigurationError, match=r"rudder_cmd: found commands up to 35, .*at most 1.05 for --unit share"
    ):
        _read(bag, "rudder_cmd=share")


def test_angles_that_end_at_one_are_radians_only_if_stated() -> None:
    angles = np.array([0.1, 0.2, 0.3, 0.4, 1.0])
    with pytest.raises(ConfigurationError, match="goes to 1 and no farther"):
        check_rudder(angles, REMUS, "bag", False)
    check_rudder(angles, REMUS, "bag", True)
    check_rudder(0.5 * angles, REMUS, "bag", False)


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("name", ["remus100", "remus100_table2", "remus100_mismatch"])
def test_the_sign_of_a_rudder_shows_on_any_hull(name: str, seed: int) -> None:
    data = planar_data(
        simulate(vehicle.load(name), sea.load("rough"), program_file.load("two_minutes"), seed)
    )
    check_rudder_sign([data], "bag")
    with pytest.raises(ConfigurationError, match=r"turns to starboard, expected .*--unit rudder_cmd=-rad"):
        check_rudder_sign([data._replace(rudder=-data.rudder)], "bag")


@pytest.mark.parametrize(
    ("effect", "rate", "doubted"),
    [
        (LARGEST, 1.0 / LARGEST, True),
        (1.0, 1.0, False),
        (0.8, 1.1, False),
        (0.5, 0.9, False),
        (0.6, 1.1, True),
        (1.4, 2.0, False),
    ],
)
def test_shares_taken_for_radians_are_doubted(effect: float, rate: float, doubted: bool) -> None:
    known = combinations_of(known_hull(REMUS))
    physical = np.zeros(ALL)
    physical[: len(known)] = known._replace(Nuud=effect * known.Nuud)
    physical[RATE] = 0.26 * rate
    scaling = SimpleNamespace(sheet=SimpleNamespace(rate=0.26))
    found: Any = SimpleNamespace(physical=physical, scaling=scaling)
    assert bool(share_doubts(found, known, REMUS.rudder)) == doubted
