"""Drawn courses and hulls: within what they promise, the same for the same seed."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.curves.kinds.arc import Arc
from auv_sim.own_vehicle.tune.drawn_courses import drawn_course
from auv_sim.own_vehicle.tune.ensemble import (
    UNCERTAIN,
    check_simulated,
    drawn_hulls,
    ensemble,
    factors_of,
    planar,
)
from auv_sim.own_vehicle.tune.trial_flights import Amount, Conditions, draw_flights, draw_sea_flights
from hulls import DIVER, REMUS


@settings(max_examples=20)
@given(st.integers(0, 10**6), st.floats(2.0, 40.0), st.sampled_from(["sharp", "rounded", "survey", "gentle"]))
def test_a_course_can_be_flown(seed: int, radius: float, kind) -> None:
    path, again = (drawn_course(kind, radius, 5, np.random.default_rng(seed)) for _ in range(2))
    assert path.length == again.length
    corners = [joint for joint in path.joints if joint.geometric == "G0"]
    assert len(corners) == (4 if kind == "sharp" else 0)
    assert path.length > 240.0


def _radii(flights) -> list[float]:
    return [segment.radius for flight in flights for segment in flight.scenario.path.segments
            if isinstance(segment, Arc)]  # fmt: skip


def test_turns_are_those_of_missions_where_the_hull_turns_tighter() -> None:
    """The printed hull turns in 1.3 m: gains for arcs of 1.5 to 4.5 m alone flew wider ones worse."""
    conditions, random = Conditions(0.05, 0.05, (0.1,), None), np.random.default_rng(2)
    tight = vehicle.load("remus100_table2")
    flights = draw_flights(tight, conditions, Amount(1, 4, 5, 0), random)
    gentle = _radii(flight for flight in flights if "gentle" in flight.kind)
    assert 3.5 * 2.3 * 1.6 <= min(gentle) < max(gentle) < 0.45 * 80.0 * 3.0**0.5
    radii = _radii(flight for flight in flights if "gentle" not in flight.kind)
    assert 1.15 * 2.3 * 1.6 <= min(radii) < max(radii) <= 3.5 * 2.3 * 1.6
    assert max(radii) > 9.0
    proven = _radii(draw_sea_flights([tight] * 9, conditions, random))
    assert 2.5 * 1.28 <= min(proven) < max(proven) < 3.5 * 1.29


def test_members_stay_within_the_spread() -> None:
    hulls = ensemble(REMUS, 5, 0.1, np.random.default_rng(3))
    assert hulls[0] is REMUS
    assert len(hulls) == 5
    for drawn in hulls[1:]:
        shares = [getattr(drawn.coefficients, name) / getattr(REMUS.coefficients, name) for name in UNCERTAIN]
        assert 0.9 - 1e-9 <= min(shares) < max(shares) <= 1.1 + 1e-9
        assert drawn.coefficients.m == REMUS.coefficients.m


def test_a_coefficient_may_have_its_own_spread() -> None:
    hulls = ensemble(REMUS, 4, 0.0, np.random.default_rng(3), {"Nuud": factors_of(0.2)})
    shares = [hull.coefficients.Nuud / REMUS.coefficients.Nuud for hull in hulls[1:]]
    assert max(abs(share - 1.0) for share in shares) > 0.02
    assert all(hull.coefficients.Yuv == REMUS.coefficients.Yuv for hull in hulls)


def test_the_rudder_may_have_its_own_spread() -> None:
    own = {"max_rate_deg_s": (0.5, 0.6), "dead_time": (2.0, 3.0)}
    late = dataclasses.replace(REMUS, rudder=dataclasses.replace(REMUS.rudder, dead_time=0.1))
    (drawn,) = drawn_hulls(late, 1, 0.0, np.random.default_rng(3), own)
    assert 0.5 <= drawn.rudder.max_rate_deg_s / REMUS.rudder.max_rate_deg_s <= 0.6
    assert 0.2 <= drawn.rudder.dead_time <= 0.3
    assert drawn.hull == REMUS.hull


def test_a_hull_without_coefficients_has_no_spread() -> None:
    peer = vehicle.load("mss_remus100")
    assert ensemble(peer, 1, 0.0, np.random.default_rng(0)) == [peer]
    with pytest.raises(ConfigurationError, match="--spread"):
        ensemble(peer, 3, 0.1, np.random.default_rng(0))


def test_a_vehicle_that_cannot_be_simulated_is_refused() -> None:
    measured = dataclasses.replace(vehicle.load("mss_remus100"), simulated_as=None)
    with pytest.raises(ConfigurationError, match="coefficients"):
        check_simulated(measured)


def test_the_planar_part_of_a_diver_has_its_coefficients() -> None:
    flat = planar(DIVER)
    assert not flat.dives
    assert flat.coefficients.Nuud == DIVER.coefficients.Nuud
    assert planar(REMUS) is REMUS
