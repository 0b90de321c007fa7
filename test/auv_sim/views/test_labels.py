"""Labels that keep out of each other's way, and an arrow that keeps out of the path's."""

from __future__ import annotations

import math

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.views.labels import Labels, arrow


def a_map() -> tuple[Figure, object]:
    figure = Figure(figsize=(8.0, 8.0), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.set_xlim(0.0, 100.0)
    axes.set_ylim(0.0, 100.0)
    return figure, axes


def test_a_text_that_would_cover_another_is_left_out() -> None:
    figure, axes = a_map()
    labels = Labels(axes)  # type: ignore[arg-type]
    written = [labels.write("12–13 G1", (50.0 + 0.3 * k, 50.0), (0.0, 0.0), 8) for k in range(10)]
    assert written == [True] + [False] * 9
    assert labels.write("far", (90.0, 90.0), (0.0, 0.0), 8)
    figure.canvas.draw()
    boxes = [text.get_window_extent() for text in axes.texts]  # type: ignore[attr-defined]
    assert len(boxes) == 2
    assert not boxes[0].overlaps(boxes[1])


def test_what_was_left_out_would_really_have_covered_the_other() -> None:
    """The boxes are estimated: at twice their width from each other two texts are both written."""
    _, axes = a_map()
    labels = Labels(axes)  # type: ignore[arg-type]
    assert labels.write("37", (50.0, 50.0), (0.0, 0.0), 12)
    assert labels.write("38", (50.0, 50.0), (20.0, 0.0), 12)


def test_the_arrow_stands_where_the_path_is_not() -> None:
    for corner, line in {
        "lower left": Line(0.0, 85.0, 100.0, 0.0), "lower right": Line(0.0, 15.0, 100.0, 0.0),
    }.items():  # fmt: skip
        _, axes = a_map()
        path = CompositePath([line, Line(100.0, line.evaluate(1.0).y, 1.0, math.pi)])
        arrow(axes, "current", 0.1, 0.2, path)  # type: ignore[arg-type]
        (words,) = axes.texts  # type: ignore[attr-defined]
        right, up = words.get_position()
        assert (right < 0.5) == (corner == "lower left"), corner
        assert words.get_text() == "current\n0.22 m/s"
        assert 0.0 < up < 1.0


def test_still_water_has_no_arrow() -> None:
    _, axes = a_map()
    arrow(axes, "current", 0.0, 0.0, CompositePath([Line(0.0, 0.0, 10.0, 0.0)]))  # type: ignore[arg-type]
    assert not axes.texts  # type: ignore[attr-defined]
