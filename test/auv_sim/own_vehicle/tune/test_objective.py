"""The objective: more distance, rudder, unrest or lost flights never make it smaller."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.own_vehicle.tune.objective import (
    LIMIT_CYCLE,
    cycling,
    distance_cost,
    off_by_kind,
    ratios_of,
    reference_of,
    terms_of,
    worst,
)

#: Two flights on lines, three along courses.
IS_LINE = np.array([True, True, False, False, False])


def flights(**columns) -> Flights:
    """Return five flights, alike but for some columns."""
    values = {field.name: np.full(5, 0.1) for field in dataclasses.fields(Flights)}
    values |= {"completed": np.array([False, False, True, True, True])}
    return Flights(**values | columns)  # type: ignore[arg-type]


def total(flown: Flights) -> float:
    return terms_of(flown, flights(), IS_LINE).total


def test_the_rule_has_zero() -> None:
    assert total(flights()) == pytest.approx(0.0)


@given(
    st.sampled_from(
        ["rms_distance", "off_corners_rms_distance", "rudder_travel_per_metre", "late_rms_yaw_rate"]
    ),
    st.lists(st.floats(0.0, 5.0), min_size=5, max_size=5),
    st.integers(0, 4),
    st.floats(0.0, 5.0),
)
def test_it_is_monotone(name: str, values, flight: int, more: float) -> None:
    before = np.array(values)
    after = before.copy()
    after[flight] += more
    assert total(flights(**{name: after})) >= total(flights(**{name: before})) - 1e-12


def test_a_lost_flight_costs_more_than_any_distance_gains() -> None:
    lost = flights(
        completed=np.array([False, False, True, True, False]), rms_distance=np.full(5, 1e-3),
        off_corners_rms_distance=np.full(5, 1e-3),
    )  # fmt: skip
    assert total(lost) > 2.0


def test_a_limit_cycle_costs_more_the_larger_it_is() -> None:
    calm, edge, wild = (cycling(np.array([0.05, rate])) for rate in (0.05, LIMIT_CYCLE, 10.0))
    assert calm == 0.0
    assert edge == pytest.approx(1.0)
    assert wild > 3.0
    assert cycling(np.array([math.nan])) >= wild


def test_a_course_that_becomes_worse_counts_twice() -> None:
    ruled = np.array([1.0, 1.0])
    better, worse = distance_cost(np.array([0.5, 1.0]), ruled), distance_cost(np.array([2.0, 1.0]), ruled)
    assert worse == pytest.approx(-2.0 * better, rel=0.03)


def test_the_worst_hull_counts() -> None:
    assert worst([-0.5, 0.2, -0.1]) == 0.2


def test_a_course_behind_the_present_gains_costs_more_than_the_others_gain() -> None:
    """Two of three courses are flown at three quarters of the distance, the third at 1.1 times."""
    off = np.array([0.1, 0.1, 0.075, 0.075, 0.11])
    mixed = flights(rms_distance=off, off_corners_rms_distance=off)
    assert terms_of(mixed, flights(), IS_LINE).total < 0.0
    held = terms_of(mixed, flights(), IS_LINE, present=flights())
    assert held.behind == pytest.approx(4.0 * math.log(0.12 / 0.11))
    better = flights(rms_distance=off, off_corners_rms_distance=np.minimum(off, 0.1))
    assert terms_of(better, flights(), IS_LINE, present=flights()).behind == 0.0
    assert terms_of(better, flights(), IS_LINE, present=flights()).total < held.total - 0.1


def test_ratios_by_kind_are_those_of_completed_courses() -> None:
    off = np.array([9.0, 9.0, 0.21, 0.1, 0.1])
    kinds = ("", "", "survey", "sharp", "sharp")
    found = off_by_kind(flights(off_corners_rms_distance=off), flights(), kinds)
    assert found == {"survey": pytest.approx(2.0), "sharp": pytest.approx(1.0)}
    lost = flights(off_corners_rms_distance=off, completed=np.array([True, True, False, True, True]))
    assert off_by_kind(lost, flights(), kinds)["survey"] == 1.0


def test_margins_that_are_missing_cost() -> None:
    assert terms_of(flights(), flights(), IS_LINE, 2 / 3).total > 1.0


@given(
    st.lists(st.floats(0.01, 5.0), min_size=5, max_size=5), st.lists(st.booleans(), min_size=5, max_size=5)
)
def test_the_reference_is_never_worse_than_either(values, completed) -> None:
    ruled, both = flights(), np.array(completed)
    present = flights(rms_distance=np.array(values), completed=both, rudder_travel_per_metre=np.array(values))
    reference = reference_of(ruled, present)
    assert reference_of(ruled, None) is ruled
    assert (reference.rms_distance <= np.where(ruled.completed, ruled.rms_distance, np.inf)).all()
    assert (reference.rms_distance[both] <= present.rms_distance[both]).all()
    assert (reference.completed == (ruled.completed | both)).all()
    known = ruled.completed
    ratio = (reference.rudder_travel_per_metre / ruled.rudder_travel_per_metre)[known]
    assert ((ratio >= 0.5) & (ratio <= 2.0)).all()


def test_a_flight_without_the_present_gains_counts_with_the_rule() -> None:
    ruled = flights()
    present = flights(rms_distance=np.full(5, 0.01), completed=np.zeros(5, bool))
    assert (reference_of(ruled, present).rms_distance[2:] == 0.1).all()


def test_ratios_are_plain_means() -> None:
    found = ratios_of(flights(rms_distance=np.array([9.0, 9.0, 0.22, 0.1, 0.1])), flights(), IS_LINE)
    assert found.rms == pytest.approx((0.23 / 0.11) ** (1 / 3))
    assert found.travel == pytest.approx(1.0)
