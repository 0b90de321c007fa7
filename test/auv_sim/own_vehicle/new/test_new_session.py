"""`vehicle.py new`: files that fly, marked assumptions, and facts that contradict each other."""

from __future__ import annotations

import dataclasses
import io
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.control.hull_model import HullModel, tightest_turn
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.missions import mission_file
from auv_path_following.vehicle import Vehicle
from auv_sim.cli.vehicles import vehicle_command
from auv_sim.flight import closed_loop
from auv_sim.flight.metrics import under_way
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.new import trial_flight
from auv_sim.own_vehicle.new.assumed_hull import assumed_hull, divergence_of, effect_of
from auv_sim.own_vehicle.new.new_session import new_vehicle
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts, check_facts
from auv_sim.own_vehicle.new.trial_flight import TrialFlight, trial_text
from auv_sim.own_vehicle.tune.ensemble import spread_of_file
from auv_sim.vehicle import sea
from hulls import STABLE, drawn

FACTS = OwnerFacts("own", 2.4, "rpm", 1200.0, ((600.0, 1.0), (1100.0, 1.9)), ((25.0, 11.0),), 25.0, mass=55.0)
DIVER = FACTS._replace(planes_deg=20.0, dive_rate=0.7, diameter=0.23, mass=None)


def console() -> Console:
    return Console(file=io.StringIO(), width=200)


def printed(made: Console) -> str:
    assert isinstance(made.file, io.StringIO)
    return made.file.getvalue()


def test_a_vehicle_flies_and_its_assumptions_are_marked(tmp_path: Path) -> None:
    out = console()
    own = new_vehicle(FACTS, tmp_path / "own.yaml", False, out)
    assert own == vehicle.load(str(tmp_path / "own.yaml"))
    assert own.assumed_within == 2.0
    assert own.speed_at(1100.0) == pytest.approx(1.9)
    assert own.speed_at(600.0) == pytest.approx(1.0)
    assert -own.coefficients.Xuu * 1.9**2 == pytest.approx(own.newtons(1100.0), rel=1e-3)
    assert own.coefficients.m == 55.0
    assert HullModel(own).steady_turn(8.0).radius == pytest.approx(11.0, rel=0.01)
    text = (tmp_path / "own.yaml").read_text()
    assert text.count("assumed") > 15
    assert spread_of_file(tmp_path / "own.yaml")["Nur"] == (0.5, 2.0)
    assert "m: 55  # kg, given" in text and "max_rate_deg_s: 15  # assumed (x2)" in text
    said = printed(out)
    assert said.index("the rudder's effect b") < said.index("the delay of the commands")
    assert "vehicle.py manoeuvres" in said
    with pytest.raises(ConfigurationError, match=r"--out: found .*own\.yaml, which exists"):
        new_vehicle(FACTS, tmp_path / "own.yaml", False, console())


def test_a_diver_dives_as_it_was_measured(tmp_path: Path) -> None:
    own = new_vehicle(DIVER, tmp_path / "diver.yaml", False, console())
    vertical, planes = own.coefficients.vertical, own.sternplanes
    assert vertical is not None and planes is not None
    # The steady dive: the moment of the planes is that of the weight.
    sine = -vertical.Muud * 1.9**2 * planes.max_angle / (vertical.zg * vertical.W)
    assert 1.9 * sine == pytest.approx(0.7, rel=0.01)
    assert mission_file.load(str(tmp_path / "diver_survey.yaml"), own).spatial is not None


def test_given_effect_and_divergence_become_the_hulls() -> None:
    facts = FACTS._replace(effect=1.2, divergence=0.3)
    hull = assumed_hull(facts).hull
    assert effect_of(hull, facts) == pytest.approx(1.2)
    assert divergence_of(hull, facts) == pytest.approx(0.3, abs=0.01)


def test_what_is_assumed_can_be_steered_with_the_given_delay() -> None:
    facts = FACTS._replace(delay=0.4)
    assert divergence_of(assumed_hull(facts).hull, facts) == pytest.approx(0.5, rel=0.1)
    given = facts._replace(divergence=1.3)
    assert divergence_of(assumed_hull(given).hull, given) == pytest.approx(1.3, rel=0.1)


def test_a_hull_that_turns_wide_has_a_weak_rudder() -> None:
    wide, tight, tightest = (FACTS._replace(radii=((25.0, radius),)) for radius in (22.0, 9.0, 2.0))
    assert 0.6 <= effect_share(wide) < 0.8 * effect_share(tight)
    assert effect_share(tightest) == pytest.approx(2.0)
    weaker_turn = FACTS._replace(radii=((12.5, 9.0),))  # the same turn with half the rudder
    assert effect_share(weaker_turn) > 1.3 * effect_share(tight)


def effect_share(facts: OwnerFacts) -> float:
    """b L^2/u^2 that is assumed."""
    return effect_of(assumed_hull(facts).hull, facts) * (facts.length / facts.speed) ** 2


def test_radii_at_several_angles_give_the_divergence() -> None:
    """From the turns of a hull with the assumed effect comes its own divergence."""
    truth = assumed_hull(FACTS._replace(divergence=0.2)).hull
    own = Vehicle(
        name="own", length=2.4, thrust_max=9.0, hull=truth,
        rudder=vehicle.Rudder(max_angle_deg=25.0, max_rate_deg_s=15.0),
    )  # fmt: skip
    radii = []
    for angle in (10.0, 17.0, 25.0):
        ur, vr, r = HullModel(own).steady_motion(7.0, np.radians(angle))
        radii.append((angle, float(np.hypot(ur, vr) / r)))
    facts = FACTS._replace(radii=tuple(radii))
    assert divergence_of(assumed_hull(facts).hull, facts) == pytest.approx(0.2, abs=0.05)


@pytest.mark.parametrize(
    ("changes", "where", "found"),
    [
        ({"length": 1e300}, "--length", "1e+300 m"),
        ({"max_angle_deg": 95.0}, "--rudder", "95 deg"),
        ({"planes_deg": 90.0}, "--planes", "90 deg"),
        ({"delay": 5.0}, "--delay", "5 s"),
        ({"rate_deg_s": 1e-9}, "--rudder-rate", "1e-09 deg/s"),
        ({"effect": 1e300}, "--effect", "1e+300 1/s^2"),
        ({"mass": 3.0}, "--mass", "3 kg"),
        ({"mass": 90.0, "diameter": 0.15}, "--mass", "90 kg"),
        ({"diameter": 1.5}, "--diameter", "1.6 diameters"),
        ({"speeds": ((600.0, 1.9), (1100.0, 1.0))}, "--speed", "then 1 at 1100"),
        ({"speeds": ((1300.0, 1.9),)}, "--speed", "1300 rpm"),
        ({"speeds": ((1100.0, 19.0),)}, "--speed", "7.92 lengths a second"),
        ({"radii": ((10.0, 8.0), (25.0, 11.0))}, "--radius", "then 11 at 25"),
        ({"radii": ((30.0, 8.0),)}, "--radius", "30 deg"),
        ({"radii": ((25.0, 0.5),)}, "--radius", "0.208 lengths"),
        ({"dive_rate": 0.5}, "--dive-rate", "without --planes"),
        ({"dive_rate": 1.85, "planes_deg": 20.0}, "--dive-rate", "1.85 m/s down"),
        ({"thrust_unit": "percent"}, "--thrust-max", "1200 with per cent"),
        ({"thrust_table": ((600.0, 3.0), (1100.0, 9.0))}, "--thrust-table", "a last row at 1100"),
    ],
)
def test_facts_that_contradict_each_other_cost_one_line(
    changes: dict[str, object], where: str, found: str
) -> None:
    with pytest.raises(ConfigurationError) as error:
        check_facts(FACTS._replace(**changes))  # type: ignore[arg-type]
    assert error.value.where == where
    assert found in error.value.found


def test_a_thrust_that_no_hull_of_this_size_needs_is_refused() -> None:
    with pytest.raises(ConfigurationError, match=r"--speed: found 4000 N at 1\.9 m/s"):
        assumed_hull(FACTS._replace(thrust_unit="N", thrust_max=4000.0, speeds=((4000.0, 1.9),)))


def test_a_mass_that_does_not_fit_the_thrust_is_named() -> None:
    light = FACTS._replace(length=2.6, thrust_unit="N", thrust_max=20.0, speeds=((20.0, 1.8),), mass=9.0)
    with pytest.raises(
        ConfigurationError, match=r"--mass: found 9 kg with 20 N at 1\.8 m/s, .* such as 130 kg"
    ):
        assumed_hull(light)
    assumed_hull(light._replace(mass=130.0))


def test_the_command_line_writes_the_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["new", "--length", "1.6", "--thrust-unit", "percent", "--speed", "1.5@60", "--rudder", "25"]
    file = str(tmp_path / "p.yaml")
    assert vehicle_command.main([*words, "--out", file]) == 2
    assert "--radius: found nothing" in capsys.readouterr().err
    in_newtons = ["new", "--length", "2.1", "--speed", "1.5", "--radius", "8", "--rudder", "25"]
    assert vehicle_command.main([*in_newtons, "--out", file]) == 2
    assert "the largest thrust, N, or --thrust-unit percent" in capsys.readouterr().err
    words += ["--name", "two\nlines"]
    assert vehicle_command.main([*words, "--radius", "6", "--quiet", "--out", file]) == 0
    assert capsys.readouterr().out == ""
    assert vehicle.load(file).name == "two lines"
    assert vehicle.load(file).thrust_table[-1][0] == 100.0


def known_by_three_numbers(hull: Vehicle) -> OwnerFacts:
    turn = tightest_turn(hull).radius
    return OwnerFacts(
        "own", hull.length, "N", hull.thrust_max, ((hull.thrust_max, hull.top_speed),),
        ((hull.rudder.max_angle_deg, round(turn, 2)),), hull.rudder.max_angle_deg,
        rate_deg_s=hull.rudder.max_rate_deg_s, delay=0.05,
    )  # fmt: skip


@pytest.mark.parametrize(
    "hull", [vehicle.load("remus100_mismatch"), STABLE, drawn(3)], ids=["weak", "stable", "drawn"]
)
def test_length_speed_and_radius_are_enough_for_a_survey(hull: Vehicle) -> None:
    """In the moderate sea, in turns of 2.5 radii, true distances: within 1 m for 95 % of the way."""
    facts = known_by_three_numbers(hull)
    assumed = assumed_hull(facts).hull
    own = dataclasses.replace(
        hull, hull=assumed, turning=vehicle.Turning(radius=facts.radii[0][1]),
        rudder=dataclasses.replace(hull.rudder, dead_time=0.05), params=None,
        assumed_within=2.0,
    )  # fmt: skip
    assert response_of(own).effect != pytest.approx(response_of(hull).effect, rel=0.05)
    mission, gains = mission_file.read_text(trial_text(own), own), gains_for(own)
    scenario = Scenario(
        path=mission.path, vehicle=hull, thrust=mission.thrust, sea=sea.load("moderate"), seed=1,
        guidance=with_gains(Scenario.__dataclass_fields__["guidance"].default_factory(), gains),  # type: ignore[misc]
        autopilot=gains.heading.autopilot, controller_vehicle=own,
    )  # fmt: skip
    flown = under_way(closed_loop.fly(scenario), mission.path.n)
    index = flown.subpath(mission.path.n)
    distance = np.abs(mission.path.distance(flown.x_true, flown.y_true, index))
    assert np.mean(distance < 1.0) >= 0.95
    assert np.sqrt(np.mean(distance**2)) <= 0.45


def test_a_survey_gets_wider_turns_where_the_vehicle_needs_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A slow servo on a large slow hull; turns of 2.5 radii would have 23 m."""
    facts = OwnerFacts(
        "slow", 3.0, "N", 9.0, ((9.0, 1.0),), ((15.0, 9.0),), 15.0, rate_deg_s=2.5, divergence=0.3
    )
    own = new_vehicle(facts, tmp_path / "slow.yaml", False, console())
    assert "turns of 51 m" in (tmp_path / "slow_survey.yaml").read_text()
    monkeypatch.setattr(trial_flight, "fly_trials", lambda *_: ([TrialFlight(0.0, 0.9, 0.4, 1.7)], False))
    missed = trial_flight.trial_survey(own, "survey.yaml")
    assert not missed.is_flown and "turns of 51 m" in missed.text
    new_vehicle(facts, tmp_path / "slow.yaml", True, console())
    assert "notice the survey is not flown within 1 m everywhere" in capsys.readouterr().err


def test_a_hull_for_which_the_rule_does_not_hold_may_fly_manoeuvres(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A large hull with a slow rudder, whose survey is flown in part: its file is what manoeuvres need."""
    facts = OwnerFacts("slow", 5.2, "rpm", 200.0, ((200.0, 2.0),), ((20.0, 28.0),), 20.0, rate_deg_s=4.0)
    monkeypatch.setattr(trial_flight, "fly_trials", lambda *_: ([TrialFlight(0.3, 0.93, 0.4, 1.7)], False))
    own = new_vehicle(facts, tmp_path / "slow.yaml", False, console())
    assert own == vehicle.load(str(tmp_path / "slow.yaml"))
    noticed = capsys.readouterr().err
    assert "too slow a fin for this hull" in noticed
    assert "notice the survey is not flown within 1 m everywhere" in noticed


def test_a_vehicle_that_cannot_fly_leaves_no_file_and_says_why(tmp_path: Path) -> None:
    late = FACTS._replace(delay=1.0, radii=((25.0, 8.0),), divergence=1.3)
    with pytest.raises(ConfigurationError, match=r"flown to \d+ ?%.*too much delay for this hull"):
        new_vehicle(late, tmp_path / "late.yaml", False, console())
    assert list(tmp_path.iterdir()) == []
    earlier = [tmp_path / "late.yaml", tmp_path / "late_survey.yaml"]
    for file in earlier:
        file.write_text("mine")
    with pytest.raises(ConfigurationError, match="flown to"):
        new_vehicle(late, tmp_path / "late.yaml", True, console())
    assert [file.read_text() for file in earlier] == ["mine", "mine"]
    assert sorted(tmp_path.iterdir()) == earlier
