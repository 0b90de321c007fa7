"""What `tune` takes from the vehicle, writes about its gains, and does not overwrite."""

from __future__ import annotations

import argparse
import dataclasses
import re
from pathlib import Path

import pytest

from auv_msgs_py.settings import params_file
from auv_path_following import config_files, vehicle
from auv_path_following.abilities import Turning
from auv_path_following.control.pitch_plane import pitch_gains
from auv_path_following.control.rule.gain_rule import gains_for
from auv_sim.cli.vehicles.vehicle_command import main, parser
from auv_sim.own_vehicle.tune import tuned_file
from auv_sim.own_vehicle.tune.gain_verdict import FOUND, PRESENT, RULE, GainVerdict, Held
from auv_sim.own_vehicle.tune.objective import CostTerms, Ratios
from auv_sim.own_vehicle.tune.outcome.verdict_words import comments_of
from auv_sim.own_vehicle.tune.sampled_loop import Margins
from auv_sim.own_vehicle.tune.tune_session import MEMBERS, conditions_again, present_of, problem_of, settled
from auv_sim.sim_parameters import SUITE
from hulls import DIVER, REMUS

BASE = params_file.load(config_files.find("params", "robust"), SUITE)


def options_of(*words: str) -> argparse.Namespace:
    return settled(parser(["tune"]).parse_args(["tune", *words]))


def test_planes_of_a_diver_get_the_gains_of_the_rule(tmp_path: Path) -> None:
    """The search flies the planar part, the file is for the whole vehicle."""
    ruled = gains_for(DIVER, 0.05, 0.05).pitch
    assert ruled is not None
    space = problem_of(options_of("remus100_6dof", "--delay", "0.05"), DIVER, BASE).space
    assert not space.vehicle.dives
    for k, gains in enumerate((space.rule(), space.gains(space.first))):
        written = tuned_file.write(tmp_path / f"{k}.yaml", gains, BASE, [])
        assert written.pitch.nism.k5 == pytest.approx(ruled.autopilot.nism.k5, rel=1e-4)
        assert written.pitch.nism.k5 != pytest.approx(pitch_gains().nism.k5, rel=1e-2)
        assert written.pitch.reference.bandwidth == pytest.approx(
            ruled.autopilot.reference.bandwidth, rel=1e-4
        )
        assert written.guidance.vertical.lookahead == pytest.approx(ruled.lookahead, rel=1e-4)


@pytest.mark.parametrize("source", [FOUND, RULE, PRESENT])
def test_flights_of_rejected_gains_are_not_in_the_file_of_others(source: str) -> None:
    options = options_of("remus100")
    problem = problem_of(options, REMUS, BASE)
    margins = Margins(2.0, 2.0, 0.1, True)
    held = Held(CostTerms(0.2, 0.0, 0.0, 0.0, 0.0, 0.0), Ratios(1.2, 1.3, 0.9), 0.01, 0.01, 67, 0)
    accepted = source == FOUND
    why = () if accepted else ("no less distance than with the rule",)
    rule = problem.space.rule()
    verdict = GainVerdict(source, rule, "", problem.space.first, why, (held,), margins)
    text = "\n".join(comments_of(options, REMUS, problem, verdict, "robust"))
    assert ("Held out" in text) is accepted
    assert ("Not accepted: no less distance" in text) is not accepted
    assert ("those of robust" in text) is (source == PRESENT)
    assert ("Ratios" in text) is (source != PRESENT)


def test_an_uncertainty_that_the_file_states_is_tuned_for(tmp_path: Path) -> None:
    text = config_files.find("vehicles", "remus100").read_text(encoding="utf-8")
    stated = tmp_path / "stated.yaml"
    stated.write_text(re.sub(r"(  Nuud: \S+).*", r"\1  # assumed (x1.8)", text), encoding="utf-8")
    assert "x1.8" in stated.read_text(encoding="utf-8")
    plain, own = options_of("remus100"), options_of(str(stated))
    assert (plain.spread, plain.members) == (0.0, 1)
    assert (own.spread, own.members) == ("file", MEMBERS)
    assert own.generations < plain.generations
    effects = {hull.coefficients.Nuud for hull in problem_of(own, vehicle.load(str(stated)), BASE).hulls}
    assert len(effects) == MEMBERS
    assert options_of(str(stated), "--spread", "5").spread == 5.0
    assert options_of(str(stated), "--spread", "0").members == 1


def test_present_gains_are_those_that_the_vehicle_names() -> None:
    name, settings = present_of(dataclasses.replace(REMUS, params="rough"))
    assert name == "rough"
    assert settings == params_file.load(config_files.find("params", "rough"), SUITE)
    assert present_of(dataclasses.replace(REMUS, params=None)) == ("robust", BASE)
    unknown = dataclasses.replace(vehicle.load("mss_remus100"), turning=Turning(radius=10.0))
    assert present_of(unknown) == ("robust", None)


@pytest.mark.parametrize(
    ("out", "others", "error"),
    [
        ("own.yaml", ["--overwrite"], "own.yaml, which is read, expected another file"),
        ("./own.yaml", [], "own.yaml, which is read, expected another file"),
        ("gains.png", [], "gains.png, expected a parameter file"),
        ("there.yaml", [], "there.yaml, which exists, expected a new file, or --overwrite"),
        ("drawn.yaml", [], "drawn.png, which exists, expected a new file, or --overwrite"),
    ],
)
def test_a_file_is_not_overwritten_unasked(
    tmp_path: Path, monkeypatch, capsys, out: str, others: list[str], error: str
) -> None:
    monkeypatch.chdir(tmp_path)
    own = config_files.find("vehicles", "remus100").read_text(encoding="utf-8")
    Path("own.yaml").write_text(own, encoding="utf-8")
    Path("there.yaml").write_text("mine", encoding="utf-8")
    Path("drawn.png").write_text("mine", encoding="utf-8")
    assert main(["tune", "own.yaml", "--out", out, "--generations", "1", *others]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert error in line
    assert Path("own.yaml").read_text(encoding="utf-8") == own
    assert Path("there.yaml").read_text(encoding="utf-8") == Path("drawn.png").read_text() == "mine"
    assert vehicle.load("own.yaml").name == vehicle.load("remus100").name


def test_a_file_that_is_no_text_is_refused(tmp_path: Path, capsys) -> None:
    """Its comments are read after it was checked."""
    file = tmp_path / "latin.yaml"
    file.write_bytes(b"name: \xe9\n")
    assert main(["tune", str(file), "--out", str(tmp_path / "tuned.yaml")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "latin.yaml" in line


def test_the_next_command_has_the_same_conditions() -> None:
    """Gains for 50 odometries a second are not proven at 20."""
    assert conditions_again(options_of("remus100")) == []
    words = ["--delay", "0.0512345678", "--rate", "50.0", "--slowest", "20.0", "--spread", "10.0"]
    assert conditions_again(options_of("remus100", *words)) == words
