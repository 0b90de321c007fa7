"""The identified vehicle and its file: what is written loads, and is the same vehicle."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle as vehicle_file
from auv_path_following.abilities import Cruise, Pitching, Turning
from auv_path_following.vehicle import Rudder, Vehicle
from auv_sim.own_vehicle.identify.combinations import Combinations, combinations_of
from auv_sim.own_vehicle.identify.dive.dive_combinations import DiveCombinations, dive_combinations_of
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.intervals import Covariances
from auv_sim.own_vehicle.identify.results.identified_file import identified_text
from auv_sim.own_vehicle.identify.results.known_vehicle import identified_vehicle, known_hull
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, HALF_PLAY, LATENCY, RATE
from auv_sim.own_vehicle.tune.ensemble import UNCERTAIN_DIVING, Factors, drawn_hulls, spread_of_file

REMUS = vehicle_file.load("remus100")
DIVER = vehicle_file.load("remus100_6dof")
C = combinations_of(REMUS.coefficients)
assert DIVER.hull is not None and DIVER.hull.vertical is not None
VERTICAL = DIVER.hull.vertical
DIVE = dive_combinations_of(DIVER.hull.m, VERTICAL)
MEASURED = Vehicle(
    name="O'Neill: \"two\"", length=2.1, thrust_max=1234.56, thrust_unit="rpm",
    rudder=Rudder(max_angle_deg=25.123456, max_rate_deg_s=15.0),
    cruise=Cruise(thrust=1000.0, speed=1.71, speeds=((500.25, 0.8123456), (1000.0, 1.71))),
    turning=Turning(radius=9.0),
)  # fmt: skip
PITCHING = dataclasses.replace(
    MEASURED, sternplanes=Rudder(max_angle_deg=20.0, max_rate_deg_s=12.3456789),
    depth=dataclasses.replace(DIVER.depth, max=123.456789, minimum_speed=1.05),
    pitching=Pitching(rate_deg_s=5.0, climb_deg=21.0),
)  # fmt: skip


def found_with(c: Combinations | DiveCombinations, share: float) -> Identified:
    """An identification of these combinations, each with this relative standard deviation."""
    physical = np.zeros(ALL)
    physical[: len(c)] = c
    physical[[RATE, DEAD_TIME, HALF_PLAY, LATENCY]] = 0.3, 0.1234, 0.001, 0.1
    spread = Covariances(np.diag((share * physical) ** 2), np.zeros((ALL, ALL)), np.zeros((2, ALL)))
    rest: Any = None
    return Identified(physical, spread, 0.0, rest, rest, rest, ())


@given(
    known=st.sampled_from([REMUS, DIVER, MEASURED, PITCHING, dataclasses.replace(REMUS, assumed_within=2.0)]),
    factors=st.lists(st.floats(0.9, 1.1), min_size=len(C), max_size=len(C)),
    share=st.sampled_from([0.05, 3.0]),
)
@settings(max_examples=25)
def test_what_is_written_loads_and_is_the_same_vehicle(
    known: Vehicle, factors: list[float], share: float
) -> None:
    hull = known_hull(known)
    c = Combinations(*(float(a * b) for a, b in zip(combinations_of(hull), factors, strict=True)))
    dive = None if hull.vertical is None else DIVE._replace(Muud=factors[0] * DIVE.Muud)
    new = identified_vehicle(known, hull, c, 17.18873, 0.1234567, dive)
    of_dive = None if dive is None else found_with(dive, share)
    text = identified_text(new, hull, found_with(c, share), "a bag", of_dive)
    assert yaml_file.checked(yaml_file.parse_text(text, "x"), Path("x"), Vehicle) == new
    assert new.assumed_within == 1.0
    assert new.sternplanes == known.sternplanes and new.pitching == known.pitching
    assert new.hull is not None and new.hull.Nuud == pytest.approx(factors[-1] * hull.Nuud, rel=0.3)


def test_rate_and_dead_time_of_the_planes_stand_in_the_file() -> None:
    c = combinations_of(DIVER.coefficients)
    new = identified_vehicle(DIVER, DIVER.coefficients, c, 15.0, 0.1, DIVE, (17.18873, 0.0987654))
    read = yaml_file.checked(
        yaml_file.parse_text(identified_text(new, DIVER.coefficients, found_with(c, 0.1), "a bag"), "x"),
        Path("x"), Vehicle,
    )  # fmt: skip
    assert read.sternplanes is not None and DIVER.sternplanes is not None
    assert (read.sternplanes.max_rate_deg_s, read.sternplanes.dead_time) == (17.19, 0.099)
    assert read.sternplanes.max_angle_deg == DIVER.sternplanes.max_angle_deg
    assert (read.rudder.max_rate_deg_s, read.rudder.dead_time) == (15.0, 0.1)


def spread_in_file(place: Path, share: float) -> dict[str, Factors]:
    """What the file of a diver states, of whose combinations each has this relative standard deviation."""
    in_plane, dive = found_with(combinations_of(DIVER.coefficients), share), found_with(DIVE, share)
    file = place / "diver.yaml"
    file.write_text(identified_text(DIVER, DIVER.coefficients, in_plane, "a bag", dive), encoding="utf-8")
    return spread_of_file(file)


def test_heave_pitch_and_planes_have_the_intervals_from_which_tune_and_prove_draw(tmp_path: Path) -> None:
    stated, wide = spread_in_file(tmp_path, 0.02), spread_in_file(tmp_path, 3.0)
    assert {name for name in UNCERTAIN_DIVING if name not in stated} == {"Zwd", "Zqd", "Mwd", "Mqd"}
    assert stated["Muud"][1] == pytest.approx(1.0 + 1.96 * 0.02, abs=2e-3)
    assert stated["sternplanes.max_rate_deg_s"][1] == pytest.approx(
        1.0 + 1.96 * 0.02 * 17.19 / 15.0, abs=2e-3
    )
    assert "sternplanes.dead_time" not in stated  # DIVER has none: a share of 0 is no range
    assert wide["Muud"] == (0.5, 2.0)
    drawn = drawn_hulls(DIVER, 20, 0.0, np.random.default_rng(0), stated)
    shares = [hull.coefficients.vertical.Muud / VERTICAL.Muud for hull in drawn if hull.coefficients.vertical]
    assert 1.0 / 1.04 < min(shares) < 0.985 < 1.015 < max(shares) < 1.04


def test_buoyancy_and_righting_moment_have_intervals_and_masses_are_assumed() -> None:
    in_plane, dive = found_with(combinations_of(DIVER.coefficients), 0.02), found_with(DIVE, 0.02)
    text = identified_text(DIVER, DIVER.coefficients, in_plane, "a bag", dive)
    notes = dict(re.findall(r"^    (\w+): \S+  # (.*)$", text, re.MULTILINE))
    assert notes["Zwd"] == notes["W"] == notes["Ywp"] == "assumed"
    assert re.fullmatch(r"\+- 0\.0007\d \(4 %\)", notes["zg"])
    # 3.34 N, of which the added mass in heave is assumed within 40 %: 0.4 * 35.5 kg / 66 kg * 3.34 N * 1.96
    assert float(notes["B"].removeprefix("+- ")) == pytest.approx(1.41, abs=0.1)


def test_a_width_that_the_data_do_not_show_is_a_factor_of_two() -> None:
    text = identified_text(REMUS, REMUS.coefficients, found_with(C, 3.0), "a bag")
    (line,) = (line for line in text.splitlines() if line.startswith("  Nuud:"))
    assert line.endswith("(x2): not known from these data")


def test_measured_pitching_stays_with_the_speed_at_which_it_was_measured() -> None:
    new = identified_vehicle(PITCHING, known_hull(PITCHING), C, 15.0, 0.1)
    assert (new.pitching, new.cruise, new.depth) == (PITCHING.pitching, PITCHING.cruise, PITCHING.depth)
    assert identified_vehicle(MEASURED, known_hull(MEASURED), C, 15.0, 0.1).cruise is None


def identified_dive(**changes: float) -> Vehicle:
    dive: DiveCombinations = DIVE._replace(**changes)
    return identified_vehicle(DIVER, DIVER.coefficients, combinations_of(DIVER.coefficients), 15.0, 0.1, dive)


def test_weaker_planes_raise_the_lowest_speed() -> None:
    weak = identified_dive(Muud=0.3 * DIVE.Muud, Zuud=0.3 * DIVE.Zuud)
    assert DIVER.depth.minimum_speed < weak.depth.minimum_speed < DIVER.top_speed
    assert identified_dive().depth == DIVER.depth


@pytest.mark.parametrize(
    ("changes", "found"),
    [
        ({"Zcos": -2.0 * DIVE.Zcos}, "below W"),
        ({"Zcos": 60.0 * DIVE.Zcos, "Muud": 0.1 * DIVE.Muud}, "stern planes at depth.minimum_speed"),
    ],
)
def test_a_hull_that_no_file_can_hold_costs_one_line(changes: dict[str, float], found: str) -> None:
    with pytest.raises(ConfigurationError, match=found) as error:
        identified_dive(**changes)
    assert "as identified" in error.value.where
