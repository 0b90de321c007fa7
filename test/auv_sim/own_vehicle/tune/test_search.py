"""Search and acceptance on one hull: few flights, so that this shows the machinery, not the best gains."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_path_following import config_files
from auv_sim.own_vehicle.tune import gain_verdict, sampled_loop, tuned_file
from auv_sim.own_vehicle.tune import search as searching
from auv_sim.own_vehicle.tune.gain_space import VARIABLES, GainSpace
from auv_sim.own_vehicle.tune.gain_verdict import PRESENT, RULE, Held, HeldPresent, judge
from auv_sim.own_vehicle.tune.objective import CostTerms, Ratios
from auv_sim.own_vehicle.tune.sampled_loop import Margins
from auv_sim.own_vehicle.tune.search import Budget, Found, beginning, hulls_of, search
from auv_sim.own_vehicle.tune.trial_flights import Amount, Conditions, draw_flights
from auv_sim.own_vehicle.tune.tuning_problem import Problem, margins_asked
from auv_sim.sim_parameters import SUITE
from hulls import REMUS, STABLE

BASE = params_file.load(config_files.find("params", "robust"), SUITE)
CONDITIONS = Conditions(0.05, 0.05, (0.1, 0.05), None)
SPACE = GainSpace(STABLE, BASE[topics.GUIDANCE].guidance, 0.05, 0.05)
FEW = Amount(starts=2, courses=1, legs=4, at_sea=0)
FEWEST = Amount(starts=1, courses=1, legs=3, at_sea=0)
PROBLEM = Problem(SPACE, [STABLE], CONDITIONS, 4, amount=FEWEST)
#: Gains that a search of 50 generations found on this hull, as ratios.
GOOD = (0.345, 0.351, 0.139, 0.251, 0.787, 0.87, 5.25, 0.95, 0.88)


def test_good_gains_are_accepted() -> None:
    verdict = judge(PROBLEM, Found(np.log(GOOD), ()), 1, FEW)
    assert verdict.accepted, verdict.why
    assert verdict.gains == SPACE.gains(verdict.point)
    assert verdict.mixed == ""
    assert verdict.held[0].ratios.rms < 0.8
    assert verdict.held[0].unrest < 0.3


def test_bad_gains_are_not_and_the_rule_stays() -> None:
    """A loop that is too fast for its delay, in every share of the way."""
    wild = SPACE.first.copy()
    wild[0], wild[3] = np.log(1.25) * 20.0, np.log(0.4) + 20.0
    verdict = judge(PROBLEM, Found(wild, ()), 1, FEW)
    assert verdict.source == RULE
    assert verdict.point == pytest.approx(SPACE.first)
    assert verdict.gains == SPACE.rule()
    assert any("margins" in why or "limit cycle" in why for why in verdict.why)


def test_better_present_gains_stay() -> None:
    """Against good gains the rule is no progress, nor is a third of the way to worse ones."""
    problem = PROBLEM._replace(present=SPACE.gains(np.log(GOOD)))
    slow = SPACE.first.copy()
    slow[0] += np.log(0.8)
    verdict = judge(problem, Found(slow, ()), 1, FEWEST)
    assert verdict.source == PRESENT
    assert verdict.gains == problem.present
    assert any("present gains" in why for why in verdict.why)
    held = verdict.held[0].present
    assert held is not None
    assert held.holds
    assert held.ratios.off > 1.05


def test_present_gains_with_a_limit_cycle_do_not_stay() -> None:
    """The default swings on this hull: gains of the rule's kind replace it, and the reason is given."""
    default = tuned_file.flown_of(BASE)
    problem = PROBLEM._replace(present=default)
    verdict = judge(problem, Found(np.log(GOOD), ()), 1, FEWEST)
    assert verdict.accepted
    held = verdict.held[0].present
    assert held is not None
    assert held.unrest > 0.3
    assert not held.holds


def test_gains_behind_on_one_kind_of_course_are_not_taken(monkeypatch) -> None:
    """Better on the whole, and still behind on surveys: the more careful mixture is taken."""
    present = SPACE.gains(np.log(GOOD))
    attempts = []

    def held_out(problem, gains, stream, threads, amount):
        attempts.append(gains)
        surveys = 1.06 if len(attempts) == 1 else 1.04
        calm = CostTerms(-0.2, -0.2, 0.0, 0.0, 0.0, 0.0)
        has = HeldPresent(calm, Ratios(0.8, 0.8, 0.9), 0.0, {"sharp corners": 0.7, "surveys": surveys})
        return [Held(calm, Ratios(0.8, 0.8, 0.9), 0.0, 0.0, 67, 0, has)]

    monkeypatch.setattr(gain_verdict, "hold_out", held_out)
    monkeypatch.setattr(gain_verdict, "margins_of", lambda *_: Margins(2.0, 2.0, 0.1, True))
    found = np.log(GOOD) + 0.2
    verdict = judge(PROBLEM._replace(present=present), Found(found, ()), 1, FEWEST)
    assert verdict.accepted
    assert verdict.point == pytest.approx(0.5 * (found + SPACE.point_of(present)))
    assert verdict.mixed == "50 % of the way back to the present gains"
    assert verdict.why == ("as found: 1.06 times the distance off corners of the present gains on surveys",)
    assert len(attempts) == 2


def test_the_search_begins_at_present_gains_that_are_better() -> None:
    good = SPACE.gains(np.log(GOOD))
    assert beginning(PROBLEM._replace(present=good), 1) == pytest.approx(SPACE.point_of(good))
    wild = SPACE.gains(SPACE.first + np.array([9.0, 0, 0, 9.0, 0, 0, 0, 0, 0]))
    assert beginning(PROBLEM._replace(present=wild), 1) == pytest.approx(SPACE.first)


def test_a_short_search_improves_or_the_rule_stays() -> None:
    found = search(PROBLEM, Budget(generations=2, population=4, threads=1))
    again = search(PROBLEM, Budget(generations=2, population=4, threads=1))
    assert found == Found(pytest.approx(again.point), again.history)
    verdict = judge(PROBLEM, found, 1, FEW)
    if verdict.accepted:
        assert verdict.held[0].terms.distance < 0.0
    else:
        assert verdict.point == pytest.approx(SPACE.first)
        assert verdict.why


def test_generations_fly_other_starts_and_courses() -> None:
    first, other = (
        draw_flights(REMUS, CONDITIONS, FEW, np.random.default_rng([0, 0, generation, 0]))
        for generation in (1, 2)
    )
    assert [flight.is_line for flight in first] == [True] * 4 + [False] * 6
    assert [flight.kind for flight in first[3:5]] == ["", "sharp corners in still water"]
    assert first[0].scenario.initial != other[0].scenario.initial
    assert first[4].scenario.path.length != other[4].scenario.path.length
    assert all(flight.scenario.command_delay >= 0.05 for flight in first)


def test_margins_of_the_rule_are_found_once_for_all_generations(monkeypatch) -> None:
    found, margins = [], sampled_loop.margins
    monkeypatch.setattr(sampled_loop, "margins", lambda *given: found.append(given) or margins(*given))
    space = GainSpace(STABLE, BASE[topics.GUIDANCE].guidance, 0.05, 0.05)
    problem = PROBLEM._replace(space=space)
    first = margins_asked(problem, STABLE)[3:]  # up, down, later
    assert margins_asked(problem._replace(seed=5), STABLE)[3:] == first
    assert len(found) == 1
    later = problem._replace(conditions=CONDITIONS._replace(delay=0.3))
    assert margins_asked(later, STABLE)[3:] != first
    assert margins_asked(problem, REMUS)[3:] != first
    assert len(found) == 3


def test_all_hulls_of_an_ensemble_have_their_turn(monkeypatch) -> None:
    hulls = [dataclasses.replace(REMUS, name=str(k)) for k in range(5)]
    problem = Problem(SPACE, hulls, CONDITIONS, 0)
    flown = [[hull.name for hull in hulls_of(problem, generation)] for generation in range(2)]
    assert flown == [["0", "1", "2"], ["0", "3", "4"]]
    assert searching.DRAWN_HULLS == 2


def test_the_file_is_what_was_found(tmp_path) -> None:
    target = tmp_path / "tuned.yaml"
    gains = SPACE.gains(np.log(GOOD))
    written = tuned_file.write(target, gains, BASE, ["Made by a test.", " " + "word " * 40])
    assert tuned_file.read(target) == written
    assert written.autopilot.nism.k5 == pytest.approx(gains.autopilot.nism.k5, rel=1e-4)
    assert written.guidance.switching.lead == pytest.approx(gains.guidance.switching.lead, rel=1e-4)
    loaded = params_file.load(target, SUITE)
    assert loaded[topics.OBSERVER] == BASE[topics.OBSERVER]
    assert target.read_text().startswith("# Made by a test.\n")
    assert len(VARIABLES) == len(GOOD)
