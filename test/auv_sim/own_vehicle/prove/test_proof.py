"""A proof of few flights: what it counts, its sentence, its page and its exit code."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli.vehicles.vehicle_command import main, parser
from auv_sim.own_vehicle.new.assumed_hull import assumed_hull
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts
from auv_sim.own_vehicle.new.vehicle_text import text_of
from auv_sim.own_vehicle.prove import proof_picture, proof_words
from auv_sim.own_vehicle.prove.one_flight import worst_of
from auv_sim.own_vehicle.prove.proof import Proof, Proposition, SeaProof, draw_claim
from auv_sim.own_vehicle.prove.proof_report import missions_for
from auv_sim.own_vehicle.tune import tune_session
from auv_sim.own_vehicle.tune.ensemble import UNCERTAIN_DIVING, spread_of_file
from auv_sim.own_vehicle.tune.trial_flights import STRAIGHT, Conditions
from auv_sim.vehicle import sea
from hulls import DIVER, REMUS

CALM, ROUGH = sea.load("calm"), sea.load("rough")
CLAIM = Proposition(REMUS, Conditions(0.05, 0.05, (0.1, 0.05), CALM), (CALM,), 0.1, {}, 60, 2.0, math.inf, 3)


def in_sea(off: float = 1.0, lost: int = 0, n: int = 500, deep: float = 0.0) -> SeaProof:
    away = np.full(n, off)
    away[:lost] = math.inf
    return SeaProof(away, away + 1.0, away / 3.0, np.full(n, deep), 0.5, lost)


def proof(cycles: int = 0, n: int = 500, **changes: float) -> Proof:
    unrest = np.full(n, 0.01)
    unrest[:cycles] = 2.0
    return Proof({"calm": in_sea(n=n, **changes)}, unrest)


@pytest.mark.parametrize(
    ("flown", "holds"),
    [
        (proof(), True),
        (proof(off=2.5), False),
        (proof(cycles=1), True),
        (proof(cycles=6), False),
        (proof(lost=9), False),
        (proof(n=298), False),
        (proof(deep=0.4), True),
        (proof(deep=0.6), False),
        (Proof({"calm": in_sea(), "rough": in_sea(2.5)}, np.zeros(500)), False),
        (Proof({"calm": in_sea(), "rough": in_sea()}, np.full(500, math.nan)), False),
    ],
)
def test_it_holds_where_distances_and_limit_cycles_are_bounded(flown: Proof, holds: bool) -> None:
    assert flown.holds(2.0, 0.5) is holds


def test_the_flights_are_drawn_on_many_hulls() -> None:
    flights = draw_claim(CLAIM)
    assert [flight.is_line for flight in flights] == [False] * 60 + [True] * 60
    # Each bound needs flights on independent hulls, none of them the vehicle of the file.
    hulls = [flight.scenario.vehicle.coefficients.Nuud for flight in flights]
    assert len(set(hulls[:60])) == len(set(hulls[60:])) == 60
    assert REMUS.coefficients.Nuud not in hulls
    assert [flight.scenario.step for flight in flights[60:]] == [0.1] * 30 + [0.05] * 30
    again = draw_claim(CLAIM)
    assert [f.scenario.path.length for f in flights] == [f.scenario.path.length for f in again]


def test_every_sea_has_the_same_courses_hulls_and_currents() -> None:
    """The draws do not depend on how many seas there are, so a flight keeps its number."""
    both = draw_claim(CLAIM._replace(seas=(CALM, ROUGH)))
    one = draw_claim(CLAIM)
    assert [f.scenario.sea and f.scenario.sea.name for f in both] == (
        ["calm"] * 60 + ["rough"] * 60 + [None] * 60
    )
    for k in range(60):
        first, second, alone = both[k].scenario, both[60 + k].scenario, one[k].scenario
        assert first.path is second.path and first.seed == second.seed == alone.seed
        assert first.current == second.current == alone.current
    worst = Proof({"calm": in_sea(3.0), "rough": in_sea(lost=8)}, np.zeros(60))
    assert worst.worst_sea == "rough"
    assert worst_of(CLAIM._replace(seas=(CALM, ROUGH)), worst) == 60


def test_courses_of_straight_legs_have_no_others() -> None:
    claim = CLAIM._replace(conditions=CLAIM.conditions._replace(kinds=STRAIGHT))
    kinds = {
        type(segment).__name__ for flight in draw_claim(claim) for segment in flight.scenario.path.segments
    }
    assert kinds == {"Line"}
    assert len({type(s).__name__ for f in draw_claim(CLAIM) for s in f.scenario.path.segments}) > 1


def test_a_vehicle_with_planes_dives_on_hulls_that_differ_in_pitch() -> None:
    claim = CLAIM._replace(vehicle=DIVER, flights=12)
    flights = [flight for flight in draw_claim(claim) if not flight.is_line]
    limits = DIVER.depth
    slope = math.tan(limits.max_pitch)
    for flight in flights:
        c = flight.scenario
        depths = [depth for _, depth in c.spatial.knots]
        assert len(set(depths)) > 1 and limits.surface <= min(depths) and max(depths) <= limits.max
        ways = np.array([way for way, _ in c.spatial.knots])
        assert np.all(np.abs(np.diff(depths)) <= 0.36 * slope * np.diff(ways))
        assert c.initial.z == pytest.approx(depths[0])
    for name in ("Muud", "Zuw"):
        drawn = {getattr(flight.scenario.vehicle.hull.vertical, name) for flight in flights}
        assert len(drawn) == 12
        assert all(1 / 1.1 <= value / getattr(DIVER.hull.vertical, name) <= 1.1 for value in drawn)
    assert len({flight.scenario.vehicle.sternplanes.max_rate_deg_s for flight in flights}) == 12
    assert {flight.scenario.vehicle.hull.vertical.W for flight in flights} == {DIVER.hull.vertical.W}


def test_the_sentence_has_the_bounds_and_the_conditions(tmp_path) -> None:
    flown = proof(off=1.23)
    text = proof_words.sentence_of(CLAIM, "tuned", flown)
    assert "99 % of the flights keep within 1.23 m of the path away from corners, and within 2.23 m" in text
    assert "on a hull drawn for each flight" in text and "off by up to 10 %" in text
    assert "in the sea calm" in text and "depth" not in text
    stated = CLAIM._replace(spread=0.0, own={"Yuv": (0.5, 2.0)})
    assert "those without one as in the file" in proof_words.sentence_of(stated, "tuned", flown)
    assert "50 ms of delay" in text
    both = Proof({"calm": in_sea(1.0, deep=0.2), "rough": in_sea(1.5, 2, 1000, 0.3)}, flown.unrest)
    text = proof_words.sentence_of(CLAIM._replace(vehicle=DIVER), "tuned", both)
    assert "keep within 1.50 m of the path" in text and "within 2.50 m anywhere, and within 0.30 m of" in text
    assert "in each of the seas calm and rough" in text and "2 of 1500 did not complete" in text
    assert "fin rates" in text and "plane" not in text
    part = CLAIM._replace(is_part=True)
    assert f"on {REMUS.name} in its horizontal plane alone," in proof_words.sentence_of(part, "tuned", flown)
    assert proof_words.verdict_of(part, flown).startswith("Proven in its horizontal plane alone: 99 % within")
    _, (calm, rough) = proof_words.rows_of({"tuned": both}, dives=True)
    assert calm[:5] == ["tuned", "calm", "1.00", "2.00", "0.20"] and calm[-3:-1] == ["0 of 500", "0.6"]
    assert rough[1:3] == ["rough", "1.50"] and rough[-4:-1] == ["2 of 1000", "", ""]
    assert proof_words.rows_of({"tuned": proof(lost=30)})[1][0][1:3] == ["none", "none"]
    page = tmp_path / "proof.png"
    laws = {f"law {k}": proof(lost=30, cycles=20) for k in range(7)}
    proof_picture.draw(page, "Proven", True, 2.0, {"tuned": both, **laws}, 0.5)
    assert page.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("claim", "flown", "verdict"),
    [
        (
            CLAIM,
            proof(cycles=4, n=1000),
            "Proven: 99 % within 2 m, limit cycles from at most 1 % of the starts (bounds: 1.00 m, 0.91 %)",
        ),
        (
            CLAIM,
            proof(cycles=1, lost=9),
            "Not proven: 99 % within 2 m, limit cycles from at most 1 % of the starts "
            "(bounds: no distance, 0.95 %)",
        ),
        (
            CLAIM._replace(vehicle=DIVER, within_depth=0.5),
            Proof({"calm": in_sea(), "rough": in_sea(1.5, deep=0.6)}, np.zeros(500)),
            "Not proven: 99 % within 2 m and 0.5 m of depth, limit cycles from at most 1 % of the starts "
            "(bounds: 1.50 m in rough, 0.60 m of depth, 0.60 %)",
        ),
    ],
)
def test_the_verdict_states_what_was_asked_for_and_the_bounds(claim, flown: Proof, verdict: str) -> None:
    assert proof_words.verdict_of(claim, flown) == verdict


def test_without_numba_it_says_how_to_install(monkeypatch) -> None:
    monkeypatch.setattr(tune_session, "COMPILED", False)
    with pytest.raises(ConfigurationError, match=r"pip install -r requirements/vehicle\.txt"):
        tune_session.check_compiled("prove")


def test_the_command_flies_and_concludes(tmp_path, capsys) -> None:
    """Few flights bound nothing, so the verdict is no, and the exit code 1; its worst flight flies again."""
    out = tmp_path / "proof"
    few = ["prove", "remus100", "--flights", "2", "--delay", "0.05", "--workers", "1", "--out", str(out)]
    seas = ["--sea", "calm", "--sea", "rough"]
    assert main([*few, *seas]) == 1
    assert "2 flights bound nothing" in capsys.readouterr().err  # a notice, which --quiet leaves
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert summary["proven"] is False
    assert not {"run", "usual"} & summary["options"].keys()  # they are functions
    figures = summary["gains"]["robust"]
    assert figures["flights"] == 4 and figures["seas"]["calm"]["flights"] == 2
    page = (out / "proof.html").read_text(encoding="utf-8")
    assert "{{" not in page and "2 flights bound nothing" in page and "SHA-256 begins with" in page
    assert not re.search(r"(src|href)=.http", page)  # it is read without a network
    worst = re.search(r"prove remus100 .*--refly (\d+)", page)
    assert worst and worst[1] == str(summary["worst_flight"])
    assert main([*few, *seas, "--refly", worst[1]]) == 0
    assert (out / f"flight_{worst[1]}.png").read_bytes() == (out / "worst_flight.png").read_bytes()
    capsys.readouterr()
    assert main([*few, *seas]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "proof.html, which exists, expected a new file, or --overwrite" in line
    for wrong, text in (
        (["--refly", "6"], "--refly: found 6, expected a flight from 0 to 5"),
        (["--sea", "calm"], "--sea: found calm twice"),
    ):
        assert main([*few, *seas, *wrong]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert text in line


def test_the_next_command_flies_the_survey_of_the_vehicle(tmp_path) -> None:
    """The default mission has newtons: of a vehicle in rpm it makes 0.06 m/s."""
    table = {"thrust_max": 1500.0, "thrust_unit": "rpm", "thrust_table": ((1500.0, 6.48),)}
    file, rpm = str(tmp_path / "found.yaml"), dataclasses.replace(REMUS, name="My AUV", **table)
    assert missions_for(REMUS, file) == []
    assert missions_for(rpm, file) == [Path("MISSION.yaml")]
    survey = tmp_path / "my_auv_survey.yaml"
    survey.touch()
    assert missions_for(rpm, file) == [survey]


def test_a_file_states_the_uncertainty_of_its_coefficients(tmp_path) -> None:
    file = tmp_path / "own.yaml"
    file.write_text(
        "hull:\n  Yuv: -28.6  # assumed (x2)\n  Nuud: -6  # +- 0.3 (5 %)\n  m: 30  # kg, assumed (x1.3)\n"
        "  Nur: -2  # not known\n", encoding="utf-8",
    )  # fmt: skip
    assert spread_of_file(file) == {"Yuv": (0.5, 2.0), "Nuud": pytest.approx((1.0 / 1.05, 1.05))}


@pytest.mark.parametrize(
    ("line", "factors"),
    [
        ("hull:\n  Nur: -2  # assumed: stable and unstable hulls exist", {"Nur": (0.5, 2.0)}),
        ("hull:\n  Nuv: -2  # +- 3: not known from these data", {"Nuv": (0.5, 2.0)}),
        ("hull:\n  Nuv: -2  # +- 3: not known from these data (x2)", {"Nuv": (0.5, 2.0)}),
        ("hull:\n  Nuv: -2  # assumed", {}),
        ("rudder:\n  max_rate_deg_s: 15  # assumed (x2)", {"max_rate_deg_s": (0.5, 2.0)}),
        ("rudder:\n  max_rate_deg_s: 20  # +- 2", {"max_rate_deg_s": pytest.approx((1 / 1.1, 1.1))}),
        ("rudder:\n  dead_time: 0.168  # s, +- 0.0042", {"dead_time": pytest.approx((1 / 1.025, 1.025))}),
        ("rudder:\n  dead_time: 0.2  # s, +- 2e-02", {"dead_time": pytest.approx((1 / 1.1, 1.1))}),
        ("rudder:\n  dead_time: 0.05  # s; assumed: 0.02 to 0.3 s", {"dead_time": pytest.approx((0.4, 6.0))}),
        ("rudder:\n  dead_time: 0  # s, +- 0.003", {}),
        ("hull:\n  Nuud: -6  # assumed: -12 to -3", {"Nuud": (0.5, 2.0)}),
        ("depth:\n  max_rate_deg_s: 15  # assumed (x2)", {}),
        ("sternplanes:\n  max_rate_deg_s: 15  # (x2)", {"sternplanes.max_rate_deg_s": (0.5, 2.0)}),
        (
            "hull:\n  vertical:  # all assumed (x2) unless marked otherwise\n    Muud: -2  # (x3)",
            dict.fromkeys(UNCERTAIN_DIVING, (0.5, 2.0)) | {"Muud": (1.0 / 3.0, 3.0)},
        ),
    ],
)
def test_unknown_numbers_and_the_rudder_are_uncertain_too(tmp_path, line: str, factors) -> None:
    file = tmp_path / "own.yaml"
    file.write_text(f"name: own\n{line}\n", encoding="utf-8")
    assert spread_of_file(file) == factors


def test_a_new_vehicle_states_what_is_uncertain(tmp_path) -> None:
    """Read what `vehicle.py new` writes."""
    facts = OwnerFacts("Own", 2.0, "N", 30.0, ((30.0, 2.0),), ((20.0, 9.0),), 20.0)
    assumed = assumed_hull(facts)
    file = tmp_path / "own.yaml"
    file.write_text(text_of(facts, assumed, assumed.hull, None, ""), encoding="utf-8")
    found = spread_of_file(file)
    assert found["max_rate_deg_s"] == found["Nur"] == found["Xvr"] == (0.5, 2.0)
    assert found["Yuv"] == pytest.approx((1.0 / 3.0, 3.0))
    assert found["dead_time"] == pytest.approx((0.4, 6.0))


def test_a_file_without_a_stated_uncertainty_is_refused(capsys) -> None:
    assert main(["tune", "remus100", "--spread", "file", "--out", "nowhere.yaml"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "--spread file: found no number with its uncertainty" in line


def test_both_verbs_have_the_same_conditions() -> None:
    tuned, proven = (
        parser([verb]).parse_args([verb, "remus100", "--spread", "file"]) for verb in ("tune", "prove")
    )
    for name in ("delay", "rate", "slowest", "spread", "seed"):
        assert getattr(tuned, name) == getattr(proven, name)
    assert tuned.sea == "moderate" and proven.sea is None
