"""A proof of few flights: what it counts, its sentence, its page and its exit code."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli.vehicles.vehicle_command import main, parser
from auv_sim.own_vehicle.new.assumed_hull import assumed_hull
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts
from auv_sim.own_vehicle.new.vehicle_text import text_of
from auv_sim.own_vehicle.prove import proof_page, prove_session
from auv_sim.own_vehicle.prove.proof import Proof, Proposition, draw_claim
from auv_sim.own_vehicle.tune import tune_session
from auv_sim.own_vehicle.tune.ensemble import spread_of_file
from auv_sim.own_vehicle.tune.trial_flights import Conditions
from hulls import REMUS

CLAIM = Proposition(REMUS, Conditions(0.05, 0.05, (0.1, 0.05), None), 0.1, {}, 60, 2.0, 3)


def proof(off: float = 1.0, cycles: int = 0, lost: int = 0, n: int = 500) -> Proof:
    away = np.full(n, off)
    away[:lost] = math.inf
    unrest = np.full(n, 0.01)
    unrest[:cycles] = 2.0
    return Proof(away, away + 1.0, away / 3.0, unrest, 0.5, lost)


@pytest.mark.parametrize(
    ("flown", "holds"),
    [
        (proof(), True),
        (proof(off=2.5), False),
        (proof(cycles=1), True),
        (proof(cycles=6), False),
        (proof(lost=9), False),
        (proof(n=298), False),
    ],
)
def test_it_holds_where_distance_and_limit_cycles_are_bounded(flown: Proof, holds: bool) -> None:
    assert flown.holds(2.0) is holds


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


def test_the_sentence_has_the_bounds_and_the_conditions(tmp_path) -> None:
    flown = proof(off=1.23)
    text = prove_session.sentence_of(CLAIM, "tuned", flown)
    assert "99 % of the flights keep within 1.23 m of the path away from corners, and within 2.23 m" in text
    assert "on a hull drawn for each flight" in text and "off by up to 10 %" in text
    stated = CLAIM._replace(spread=0.0, own={"Yuv": (0.5, 2.0)})
    assert "those without one as in the file" in prove_session.sentence_of(stated, "tuned", flown)
    assert "50 ms of delay" in text
    page = tmp_path / "proof.png"
    proof_page.draw(page, text, "Proven", 2.0, {"tuned": flown, "other": proof(lost=30, cycles=20)})
    assert page.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("flown", "verdict"),
    [
        (
            proof(cycles=4, n=1000),
            "Proven: 99 % within 2 m, limit cycles from at most 1 % of the starts (bounds: 1.00 m, 0.91 %)",
        ),
        (
            proof(cycles=1, lost=9),
            "Not proven: 99 % within 2 m, limit cycles from at most 1 % of the starts "
            "(bounds: no distance, 0.95 %)",
        ),
    ],
)
def test_the_verdict_states_what_was_asked_for_and_the_bounds(flown: Proof, verdict: str) -> None:
    assert prove_session.verdict_of(2.0, flown) == verdict


def test_without_numba_it_says_how_to_install(monkeypatch) -> None:
    monkeypatch.setattr(tune_session, "COMPILED", False)
    with pytest.raises(ConfigurationError, match=r"pip install -r requirements/vehicle\.txt"):
        tune_session.check_compiled("prove")


def test_the_command_flies_and_concludes(tmp_path, capsys) -> None:
    """Few flights bound nothing, so the verdict is no, and the exit code 1."""
    out = tmp_path / "proof"
    code = main(
        [
            "prove",
            "remus100",
            "--flights",
            "2",
            "--delay",
            "0.05",
            "--sea",
            "calm",
            "--out",
            str(out),
            "--threads",
            "1",
        ]
    )
    assert code == 1
    printed = capsys.readouterr().out
    assert "2 flights bound nothing" in printed
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert summary["proven"] is False
    assert summary["gains"]["robust"]["flights"] == 2
    assert main(["prove", "remus100", "--flights", "2", "--out", str(out)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "proof.png, which exists, expected a new file, or --overwrite" in line


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
        ("sternplanes:\n  max_rate_deg_s: 15  # assumed (x2)", {}),
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
    assert found["max_rate_deg_s"] == found["Nur"] == found["Yuv"] == (0.5, 2.0)
    assert found["dead_time"] == pytest.approx((0.4, 6.0))


def test_a_file_without_a_stated_uncertainty_is_refused(capsys) -> None:
    assert main(["tune", "remus100", "--spread", "file", "--out", "nowhere.yaml"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "--spread file: found no number with its uncertainty" in line


def test_both_verbs_have_the_same_conditions() -> None:
    tuned, proven = (parser([verb]).parse_args([verb, "remus100"]) for verb in ("tune", "prove"))
    for name in ("delay", "rate", "slowest", "sea", "spread", "seed"):
        assert getattr(tuned, name) == getattr(proven, name)
