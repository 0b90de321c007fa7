"""Names that mean one thing, functions that fit on a page, files with one subject each."""

from __future__ import annotations

from pathlib import Path

from source_facts import facts
from test_architecture import MODULES, ROOT, SCRIPTS, TESTS, dotted

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
    "judge.judged": (50, "a table: one figure a line"),
    "flight_figures.figures_of": (43, "a table: one figure a line"),
    "mcap_file._end_chunk": (41, "the order of its writes is what makes a crash harmless"),
}

#: Most lines of a file, of a node (in a folder `nodes`, or ending in `_node`) and of a test.
MOST_OF_FILE, MOST_OF_NODE, MOST_OF_TEST = 250, 150, 300
_SIM, _PATH = "src/auv_sim/auv_sim/nodes", "src/auv_path_following/auv_path_following/nodes"
#: The files that may be longer: (lines, why).
LONGER_FILES = {
    "scripts/_bootstrap.py": (400, "nothing can be imported before it has run"),
    f"{_SIM}/recorder_node.py": (200, "polling, intake and flush share one clock, one writer and one end"),
    f"{_SIM}/manoeuvres/manoeuvres_node.py": (160, "the order in which it stops is read in one place"),
}


def most_lines(path: Path) -> int:
    if path in TESTS:
        return MOST_OF_TEST
    return MOST_OF_NODE if path.parent.name == "nodes" or path.stem.endswith("_node") else MOST_OF_FILE


def test_files_are_short() -> None:
    too_long = []
    for path in (*MODULES, *SCRIPTS, *TESTS):
        lines = len(path.read_text(encoding="utf-8").splitlines())
        most, _ = LONGER_FILES.get(path.relative_to(ROOT).as_posix(), (most_lines(path), ""))
        if lines > most:
            too_long.append(f"{path.relative_to(ROOT)}: {lines} lines, expected at most {most}")
    assert too_long == []


def test_a_longer_file_is_named_only_while_it_is_longer() -> None:
    """An exception that a shorter file no longer needs leaves the table."""
    for name in LONGER_FILES:
        assert len((ROOT / name).read_text(encoding="utf-8").splitlines()) > most_lines(ROOT / name), name


def test_a_name_means_one_thing() -> None:
    """Two modules, or two public classes, of one name are mistaken for each other."""
    places: dict[str, list[str]] = {}
    for path in MODULES:
        if path.name != "__init__.py":
            places.setdefault(path.stem, []).append(dotted(path))
        for name in facts(path).classes:
            places.setdefault(name, []).append(dotted(path))
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


def test_functions_are_short() -> None:
    too_long = []
    for path in (*MODULES, *SCRIPTS):
        for name, lines in facts(path).functions:
            most, _ = LONGER.get(f"{path.stem}.{name}", (MOST_LINES, ""))
            if lines > most:
                too_long.append(
                    f"{path.relative_to(ROOT)}: {name} has {lines} lines, expected at most {most}"
                )
    assert too_long == []
