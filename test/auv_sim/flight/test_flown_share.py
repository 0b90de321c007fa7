"""The flown share on tracks whose share is known."""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight.flown_share import Stretch, flown_share, listed, percent
from auv_sim.flight.path_cells import SPACING, cells_of
from auv_sim.flight.run_record import Run

NORTH, EAST, SOUTH = 0.0, math.pi / 2.0, math.pi
#: What a cell at the edge of a stretch can add or take, as a share of 100 m.
CELL = SPACING / 100.0


def legs(*points: tuple[float, float]) -> CompositePath:
    """Straight lines from point to point."""
    pairs = itertools.pairwise(points)
    return CompositePath(
        [
            Line(x0, y0, math.hypot(x1 - x0, y1 - y0), math.atan2(y1 - y0, x1 - x0))
            for (x0, y0), (x1, y1) in pairs
        ]
    )


def run_of(x, y, s) -> Run:
    t = 0.05 * np.arange(len(x))
    return Run.from_columns({"t": t, "x": x, "y": y, "psi": 0.0 * t, "s": s})


def along(path: CompositePath, first: float, last: float, offset: float = 0.0, step: float = 0.1) -> Run:
    """From s = first to s = last along the path, `offset` metres to starboard of it."""
    s = np.linspace(first, last, 2 + int(path.length / step))
    points = [path.evaluate(min(int(v), path.n - 1), v - min(int(v), path.n - 1)) for v in s]
    x = np.array([p.x - offset * math.sin(p.chi) for p in points])
    y = np.array([p.y + offset * math.cos(p.chi) for p in points])
    return run_of(x, y, s)


def joined(*runs: Run) -> Run:
    """One after the other."""
    names = [field.name for field in dataclasses.fields(Run)]
    return Run(**{name: np.concatenate([getattr(run, name) for run in runs]) for name in names})


@pytest.mark.parametrize(("offset", "share"), [(0.9, 1.0), (1.1, 0.3), (2.9, 0.3), (3.1, 0.0), (-1.1, 0.3)])
def test_a_track_beside_the_path(offset: float, share: float) -> None:
    """200 m that bend by 0.1 degrees in the middle: a G0 joint, with 30 m of corner on either side."""
    bend = legs((0.0, 0.0), (100.0, 0.0), (200.0, 0.2))
    assert bend.joints[0].geometric == "G0"
    assert flown_share(along(bend, 0.0, 2.0, offset), bend).share == pytest.approx(share, abs=CELL)


def test_without_a_corner_the_reach_is_one_metre_throughout() -> None:
    straight = legs((0.0, 0.0), (100.0, 0.0), (200.0, 0.0))
    assert straight.joints[0].geometric == "G2"
    assert flown_share(along(straight, 0.0, 2.0, 1.1), straight).share == 0.0


def test_a_skipped_leg_is_missed() -> None:
    path = legs((0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0))
    across = run_of(np.full(500, 100.0), np.linspace(0.0, 100.0, 500), np.full(500, 2.0))
    across = dataclasses.replace(across, x=across.x - 50.0 * np.sin(np.linspace(0.0, math.pi, 500)))
    flown = flown_share(joined(along(path, 0.0, 0.999), across, along(path, 2.0, 3.0)), path)
    (missed,) = flown.missed
    # Within 3 m of the corners the neighbouring legs are flown with the skipped one's ends.
    assert (missed.begin, missed.end) == pytest.approx((103.0, 197.0), abs=3.0)
    assert flown.share == pytest.approx(1.0 - (missed.end - missed.begin) / 300.0)


def lawnmower() -> CompositePath:
    """Three legs of 100 m, 20 m apart."""
    return legs((0.0, 0.0), (100.0, 0.0), (100.0, 20.0), (0.0, 20.0), (0.0, 40.0), (100.0, 40.0))


def test_a_lawnmower_that_skips_its_first_leg() -> None:
    path = lawnmower()
    flown = flown_share(joined(run_of([100.0], [0.0], [0.0]), along(path, 1.0, 5.0)), path)
    (missed,) = flown.missed
    assert missed.begin == 0.0
    assert missed.end == pytest.approx(100.0)
    assert flown.share == pytest.approx(1.0 - missed.end / path.length)


def test_the_virtual_point_at_the_end_does_not_make_the_path_flown() -> None:
    """It runs away while the vehicle flies eight metres of the first leg."""
    path = lawnmower()
    run = along(path, 0.0, 0.08)
    away = dataclasses.replace(run, s=np.linspace(0.0, path.n, run.steps))
    assert flown_share(away, path).share <= 8.0 / path.length + CELL


@pytest.mark.parametrize("forwards", [True, False])
def test_a_path_flown_backwards_is_not_flown(forwards: bool) -> None:
    """Whether the virtual point moves with the vehicle or goes its own way."""
    path = lawnmower()
    back = along(path, 5.0, 0.0)
    assert flown_share(dataclasses.replace(back, s=back.s[::-1]) if forwards else back, path).share == 0.0


def test_a_leg_that_crosses_is_not_flown_with_the_other() -> None:
    path = legs((0.0, 0.0), (200.0, 0.0), (100.0, 100.0), (100.0, -100.0))
    flown = flown_share(along(path, 0.0, 1.0), path)
    (missed,) = flown.missed
    assert missed.begin == pytest.approx(200.0, abs=3.0 + SPACING)
    assert missed.end == pytest.approx(path.length)


def test_a_leg_that_lies_beside_is_not_flown_with_the_other() -> None:
    """Half a metre apart and in the same direction, with a way back in between."""
    path = legs((0.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0), (0.0, 0.5), (100.0, 0.5))
    flown = flown_share(along(path, 0.0, 1.0), path)
    assert [round(stretch.end) for stretch in flown.missed] == [round(path.length)]
    assert flown.share == pytest.approx(100.0 / path.length, abs=4.0 * CELL)


def eights(times: int) -> CompositePath:
    """Two circles of 30 m that touch, as an eight, `times` times."""
    to_port = Arc(0.0, -30.0, 30.0, EAST, EAST - 2.0 * math.pi)
    to_starboard = Arc(0.0, 30.0, 30.0, -EAST, -EAST + 2.0 * math.pi)
    return CompositePath([to_port, to_starboard] * times)


@pytest.mark.parametrize("laps", [1, 2])
def test_an_eight_flown_once_of_twice_is_half_flown(laps: int) -> None:
    path = eights(2)
    flown = flown_share(along(path, 0.0, 2.0 * laps), path)
    assert flown.share == pytest.approx(laps / 2.0, abs=2.0 / path.length)


def test_a_gap_in_the_odometry_is_not_filled_in() -> None:
    """After 75 s without odometry, 150 m farther on along the same line: what lies between is not known."""
    path = legs((0.0, 0.0), (400.0, 0.0))
    gap = joined(along(path, 0.0, 0.25), along(path, 0.625, 1.0))
    (missed,) = flown_share(gap, path).missed
    assert (missed.begin, missed.end) == pytest.approx((110.0, 249.0), abs=SPACING)


def held_run(path: CompositePath) -> Run:
    """The mission holds at 100 m of 400 m and rejoins 50 m farther on."""
    before, after = along(path, 0.0, 0.25), along(path, 0.375, 1.0)
    held = np.r_[np.zeros(before.steps), 1.0, np.zeros(after.steps - 1)]
    aside = dataclasses.replace(after, y=np.where(np.arange(after.steps) == 0, 20.0, after.y))
    return dataclasses.replace(joined(before, aside), held=held)


def test_what_a_rejoin_after_a_hold_skips_is_listed_apart() -> None:
    path = legs((0.0, 0.0), (400.0, 0.0))
    run = held_run(path)
    flown = flown_share(run, path)
    assert flown.share == 1.0 and flown.missed == ()
    (skipped,) = flown.skipped
    assert (skipped.begin, skipped.end) == pytest.approx((100.0, 150.0), abs=3.0)
    no_hold = flown_share(dataclasses.replace(run, held=0.0 * run.held), path)
    assert no_hold.skipped == () and no_hold.missed == (skipped,)
    assert no_hold.share == pytest.approx(1.0 - (skipped.end - skipped.begin) / 400.0)


def test_a_hold_excuses_nothing_else() -> None:
    path = legs((0.0, 0.0), (400.0, 0.0))
    run = held_run(path).select(slice(0, -400))
    flown = flown_share(run, path)
    assert [round(stretch.end) for stretch in flown.skipped] == [149]
    assert [stretch.end for stretch in flown.missed] == [400.0]


def test_a_mission_that_began_in_the_middle_is_judged_from_there() -> None:
    path = lawnmower()
    run = along(path, 2.0, 5.0)
    assert flown_share(run, path, begin=2.0).share == 1.0
    assert flown_share(run, path).missed[0].begin == 0.0


def test_the_true_track_counts() -> None:
    path = legs((0.0, 0.0), (100.0, 0.0))
    run = along(path, 0.0, 1.0)
    off = dataclasses.replace(run, x_true=run.x, y_true=run.y + 1.5)
    assert flown_share(run, path).share == 1.0
    assert flown_share(off, path).share == 0.0


def test_no_rows_fly_nothing() -> None:
    path = lawnmower()
    nothing = along(path, 0.0, 1.0).select(slice(0, 0))
    assert flown_share(nothing, path).share == 0.0
    assert flown_share(nothing, path).missed == (Stretch(0.0, pytest.approx(path.length)),)


def test_dense_subpaths_are_judged_as_the_line_that_they_are() -> None:
    fine = CompositePath([Line(0.05 * k, 0.0, 0.05, NORTH) for k in range(2000)])
    whole = legs((0.0, 0.0), (100.0, 0.0))
    assert len(cells_of(fine).cells) == len(cells_of(whole).cells) == 200
    run = along(fine, 0.0, 1200.0)
    assert flown_share(run, fine) == flown_share(dataclasses.replace(run, s=run.s / 2000.0), whole)


def test_words_for_people() -> None:
    assert listed(()) == "nothing"
    assert listed((Stretch(0.0, 17.5),)) == "0.0 to 17.5 m"
    assert listed((Stretch(0.0, 1.0), Stretch(2.0, 3.0))) == "0.0 to 1.0 m and 2.0 to 3.0 m"
    assert listed(tuple(Stretch(k, k + 0.5) for k in range(20))).endswith("5.0 to 5.5 m and 14 more")
    assert (percent(1.0), percent(0.98999), percent(math.nan)) == ("100.00 %", "98.99 %", "-")


@st.composite
def wandering(draw: st.DrawFn) -> tuple[CompositePath, Run]:
    """A random polyline, and a track that leaves it by a sine of a random size."""
    turns = draw(st.lists(st.floats(-1.5, 1.5), min_size=1, max_size=5))
    length = draw(st.floats(20.0, 80.0))
    points, course = [(0.0, 0.0)], 0.0
    for turn in turns:
        x, y = points[-1]
        points.append((x + length * math.cos(course), y + length * math.sin(course)))
        course += turn
    path = legs(*points)
    run = along(path, 0.0, draw(st.floats(0.2, 1.0)) * path.n)
    size, period = draw(st.floats(0.0, 6.0)), draw(st.floats(20.0, 100.0))
    sine = size * np.sin(2.0 * math.pi * 0.1 * np.arange(run.steps) / period)
    return path, dataclasses.replace(run, x=run.x + sine, y=run.y - sine)


@settings(max_examples=40)
@given(wandering(), st.floats(-math.pi, math.pi), st.floats(-1e3, 1e3), st.floats(-1e3, 1e3))
def test_the_share_does_not_depend_on_where_the_path_lies(
    given_, turn: float, north: float, east: float
) -> None:
    path, run = given_
    cos, sin = math.cos(turn), math.sin(turn)
    moved = CompositePath(
        [
            Line(north + cos * p.x - sin * p.y, east + sin * p.x + cos * p.y, segment.length, p.chi + turn)
            for segment in path.segments
            for p in [segment.evaluate(0.0)]
        ]
    )
    there = dataclasses.replace(run, x=north + cos * run.x - sin * run.y, y=east + sin * run.x + cos * run.y)
    one, other = flown_share(run, path), flown_share(there, moved)
    assert one.share == pytest.approx(
        other.share, abs=2.0 * SPACING / path.length
    )  # rounding may flip an edge


@settings(max_examples=40)
@given(wandering(), st.integers(2, 5))
def test_more_rows_take_nothing_away_and_parts_make_the_whole(given_, every: int) -> None:
    path, run = given_
    flown = flown_share(run, path)
    missed = sum(stretch.end - stretch.begin for stretch in flown.missed)
    assert 0.0 <= flown.share <= 1.0
    assert flown.share * path.length + missed == pytest.approx(path.length)
    shorter = flown_share(run.select(slice(0, run.steps // every)), path)
    assert shorter.share <= flown.share
