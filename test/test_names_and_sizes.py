"""Names that mean one thing, and functions that fit on a page."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from test_architecture import MODULES, ROOT, SCRIPTS, dotted

#: Most lines of a function, and the functions that may be longer: module.name -> (lines, why).
MOST_LINES = 40
_STEP = "a compiled step: its parts have no names of their own and share all of its values"
LONGER = {
    "compiled_flight.fly_one": (63, _STEP),
    "spatial_follow.follow_spatial": (60, _STEP),
    "follow.follow": (56, _STEP),
    "guide.guide": (54, _STEP),
    "navigator._carry_on": (50, _STEP),
    "current_observer.observe": (49, _STEP),
    "autopilot.steer": (44, _STEP),
    "progress.move": (42, _STEP),
    "exact_servo.fin_angles": (48, _STEP),
    "planar_filter.planar_innovations": (45, _STEP),
    "dive_filter.dive_innovations": (45, _STEP),
    "run_columns.assemble": (61, "one column after the other; a third is its docstring"),
    "judge.judged": (51, "a table: one figure a line"),
    "flight_figures.figures_of": (43, "a table: one figure a line"),
    "mcap_file._end_chunk": (41, "the order of its writes is what makes a crash harmless"),
}


def test_a_name_means_one_thing() -> None:
    """Two modules, or two public classes, of one name are mistaken for each other."""
    places: dict[str, list[str]] = {}
    for path in MODULES:
        if path.name != "__init__.py":
            places.setdefault(path.stem, []).append(dotted(path))
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places.setdefault(node.name, []).append(dotted(path))
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


@pytest.mark.parametrize("path", [*MODULES, *SCRIPTS], ids=lambda path: str(path.relative_to(ROOT)))
def test_functions_are_short(path: Path) -> None:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            lines = (node.end_lineno or node.lineno) - node.lineno + 1
            most, _ = LONGER.get(f"{path.stem}.{node.name}", (MOST_LINES, ""))
            assert lines <= most, f"{node.name} has {lines} lines, expected at most {most}"
