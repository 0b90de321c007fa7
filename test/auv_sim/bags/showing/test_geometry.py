"""The geometry of the page's view in three dimensions: which way north, east and down are."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from importlib import resources

import pytest

SOURCE = resources.files("auv_sim.bags.showing").joinpath("page", "geometry.js").read_text(encoding="utf-8")
NODE = shutil.which("node")
pytestmark = pytest.mark.skipif(NODE is None, reason="not run: no node")

#: Direction of sight, and what a metre north, east and down is: to the right, up, away.
VIEWS = {
    "a map": ((0.0, 90.0, 5.0), ((0, 1, 0), (1, 0, 0), (0, 0, 5))),
    "from the south": ((0.0, 0.0, 1.0), ((0, 0, 1), (1, 0, 0), (0, -1, 0))),
    "from the west, depths doubled": ((90.0, 0.0, 2.0), ((-1, 0, 0), (0, 0, 1), (0, -2, 0))),
}


def evaluate(expression: str) -> object:
    """Return what an expression is worth in the page."""
    code = f"{SOURCE}\nconsole.log(JSON.stringify({expression}))"
    assert NODE is not None
    done = subprocess.run([NODE, "-e", code], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def test_the_axes_are_seen_from_the_side_that_the_view_says() -> None:
    units = "[[1,0,0],[0,1,0],[0,0,1]]"
    calls = [
        f"{units}.map(p => project({{heading:{math.radians(h)},tilt:{math.radians(t)},stretch:{k}}}, ...p))"
        for (h, t, k), _ in VIEWS.values()
    ]
    found = evaluate(f"[{','.join(calls)}]")
    assert isinstance(found, list)
    for (name, (_, wanted)), seen in zip(VIEWS.items(), found, strict=True):
        for axis, place in zip(wanted, seen, strict=True):
            assert place == pytest.approx(axis, abs=1e-12), name


def test_depths_are_stretched_to_a_third_of_the_extent_at_most() -> None:
    assert evaluate("[[600, 30], [600, 3], [40, 12], [90, 12], [600, 0]].map(p => stretchFor(...p))") == [
        5, 20, 1, 2, 20,
    ]  # fmt: skip


def test_colours_span_what_nearly_all_values_are_within() -> None:
    values = "[...Array.from({length: 99}, (_, k) => 0.01 * k), NaN, -50]"
    plain, signed, none = (
        evaluate(f"colourRange({given}, {is_signed})")
        for given, is_signed in ((values, "false"), (values, "true"), ("[NaN]", "true"))
    )
    assert plain == {"low": 0, "high": pytest.approx(0.97, abs=0.011), "largest": 50}
    assert isinstance(signed, dict)
    assert signed["low"] == -signed["high"]
    assert none is None
    numbers = "[-9, -1, 0, 0.99, 1, 7, NaN].map(v => colourOf(v, {low: -1, high: 1}, 4))"
    assert evaluate(numbers) == [0, 0, 2, 3, 3, 3, -1]
