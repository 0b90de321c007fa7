"""Fits, verdicts and theorem checks: right on signals whose answer is known."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following import vehicle
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.navigation.current_observer import CurrentObserverConfig
from auv_sim.studies.paper.claims import measures, theorems
from auv_sim.studies.paper.claims.paper_claim import FAILS, HOLDS, Number, PaperClaim, verdict
from auv_sim.studies.paper.heading_loop import linear_hull, phase_lag

T = np.arange(0.0, 30.0, 0.05)


@pytest.mark.parametrize("rate", [0.1, 0.5, 2.0])
def test_the_rate_of_an_exponential_is_found(rate):
    found = measures.decay(T, 3.0 * np.exp(-rate * T), 2.0, 1e-3)
    assert found.rate == pytest.approx(rate)
    assert found.fit == pytest.approx(1.0)


def test_an_oscillation_is_judged_by_its_envelope():
    size = np.abs(np.exp(-0.3 * T) * np.cos(2.0 * T))
    found = measures.decay(T, measures.envelope(size), 0.9, 1e-3)
    assert found.rate == pytest.approx(0.3, rel=0.1)
    assert (np.diff(measures.envelope(size)) <= 0.0).all()


def test_what_does_not_decay_has_no_rate():
    found = measures.decay(T, np.full_like(T, 1.0), 2.0, 1e-3)
    assert not found.fit > 0.5


def test_verdicts():
    assert verdict({"a": True, "b": True}) == HOLDS
    assert verdict({"a": False, "b": False}) == FAILS
    assert verdict({"a": True, "b": False}, "for") == "holds only for a"


def test_a_number_that_is_never_reached_is_null_for_programs():
    claim = PaperClaim("k", "p", "c", "r", (Number("time", math.inf, "s"), Number("x", 1.0, "m", 1)), HOLDS)
    record = json.loads(json.dumps(claim.as_json(), allow_nan=False))
    assert [n["value"] for n in record["numbers"]] == [None, 1.0]
    assert [n.text for n in claim.numbers] == ["never", "1.0 m"]


def test_theorem_1_and_2_have_the_rates_of_theory():
    for current in (NO_CURRENT, Current(0.1, 0.2)):
        for measured, theory in theorems.theorem_1(PathFollowerConfig(), current).values():
            assert measured.rate == pytest.approx(theory, rel=0.03)
    for gains in ((1.0, 1.0), (0.2, 1.2)):
        config = CurrentObserverConfig(k_ob1=gains[0], k_ob2=gains[1])
        measured, theory = theorems.theorem_2(config, Current(0.1, 0.2))
        assert measured.rate == pytest.approx(theory, rel=0.02)


def test_theorem_3_decays_but_not_at_the_rate_of_the_surfaces():
    measured, theory = theorems.theorem_3(AutopilotConfig(), vehicle.load("remus100"), 6.48)
    assert measured.fit > 0.98
    assert 0.5 * theory < measured.rate < theory


def test_both_hulls_are_unstable_and_the_printed_one_more():
    printed, prestero = (
        np.linalg.eigvals(linear_hull(vehicle.load(name))[0]).real.max()
        for name in ("remus100_table2", "remus100")
    )
    assert printed > 1.5 * prestero > 0.0


def test_a_limited_rate_lags_more_the_faster_and_the_wider_the_rudder_swings():
    w = np.linspace(0.05, 5.0, 50)
    small, large = phase_lag(w, 0.1, 0.1745), phase_lag(w, 0.6, 0.1745)
    assert small[0] == 0.0
    assert (np.diff(large) >= 0.0).all()
    assert (large >= small).all()
    assert large.max() < math.pi / 2
