"""A path as rows of numbers is the same path: points and derivatives against the segments themselves."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import config_files
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.outline import last_stretch
from auv_path_following.curves.rows import (
    AFTER,
    CHI_IN,
    CHI_OUT,
    COLUMNS,
    CORNER,
    END,
    FITTED,
    JOINT,
    JOINT_X,
    JOINT_Y,
    KIND,
    LENGTH,
    SMOOTH,
    STRETCH,
    WIDEST,
    A,
    B,
    evaluate,
)
from auv_path_following.curves.segment import PathPoint
from auv_path_following.curves.spatial.part import Part
from auv_path_following.missions import mission_file
from one_of_each import IDS, POINTS, SEGMENTS

PATHS = [CompositePath([segment]) for segment in SEGMENTS]


def assert_same_point(path: CompositePath, i: int, t: float) -> None:
    """Equal to the bit where there is a formula, to 1e-11 m in parts and fits; derivatives by their size."""
    row = path.rows.subpath[i]
    found, expected = PathPoint(*evaluate(path.rows, row, t)), path.segments[i].evaluate(t)
    if abs(row[KIND]) != FITTED and not isinstance(path.segments[i], Part):
        assert found == expected
        return
    for k, size in zip((0, 2, 4), (1.0, expected.speed, expected.speed**2), strict=True):
        assert math.dist(found[k : k + 2], expected[k : k + 2]) <= 1e-11 * max(size, 1.0)


@pytest.mark.parametrize("number", range(len(SEGMENTS)), ids=IDS)
@settings(max_examples=60)
@given(t=st.floats(0.0, 1.0))
def test_points_and_derivatives(number: int, t: float) -> None:
    assert_same_point(PATHS[number], 0, t)


@pytest.mark.parametrize("name", config_files.shipped("missions"))
def test_every_shipped_mission(name: str) -> None:
    path = mission_file.load(name).path
    for i in range(path.n):
        for t in (0.0, 0.1, 0.5, 0.999, 1.0):
            assert_same_point(path, i, t)


def test_knots_belong_to_the_piece_that_begins_there() -> None:
    spline = Spline(POINTS)
    for path in (CompositePath([spline]), CompositePath([Reversed(spline)])):
        for knot in spline.inner_knots:
            for t in (math.nextafter(knot, 0.0), knot, math.nextafter(knot, 1.0)):
                assert_same_point(path, 0, t)
                assert_same_point(path, 0, 1.0 - t)


def test_a_row_has_what_switching_needs() -> None:
    arc = SEGMENTS[IDS.index("3-arc")]
    start = arc.evaluate(0.0)
    path = CompositePath([Line(start.x, start.y - 20.0, 20.0, math.pi / 2), arc, arc])
    line, first, last = (path.rows.subpath[i] for i in range(3))
    assert {len(row) for row in (line, first, last)} == {COLUMNS}
    assert [row[JOINT] for row in (line, first, last)] == [CORNER, SMOOTH, END]
    assert (line[LENGTH], line[AFTER]) == (20.0, pytest.approx(2.0 * arc.length))
    assert (last[LENGTH], last[AFTER]) == (arc.length, 0.0)
    assert (line[JOINT_X], line[JOINT_Y]) == (start.x, start.y)
    assert (line[CHI_IN], line[CHI_OUT]) == (pytest.approx(math.pi / 2), start.chi)
    assert (line[WIDEST], line[STRETCH]) == (10.0, 0.0)
    assert first[STRETCH] == last_stretch(arc) > 0.4


def test_a_path_that_repeats_itself_keeps_its_pieces_once() -> None:
    lap = Spline([*POINTS, POINTS[0]])
    once, thrice = CompositePath([lap]).rows, CompositePath([lap] * 3).rows
    shapes = {tuple(thrice.subpath[i][A : B + 1]) for i in range(3)}
    assert shapes == {tuple(once.subpath[0][A : B + 1])}
    assert len(thrice.piece) == len(once.piece)
    assert evaluate(thrice, thrice.subpath[2], 0.3) == evaluate(once, once.subpath[0], 0.3)


def test_rows_are_made_when_they_are_asked_for() -> None:
    path = CompositePath([Line(10.0 * k, 0.0, 10.0, 0.0) for k in range(1000)])
    assert path.rows.subpath[500][LENGTH] == 10.0
    assert list(path.rows.subpath) == [500]
