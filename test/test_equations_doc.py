"""docs/equations.md says where each equation is: every name on it exists and mentions its equation."""

from __future__ import annotations

import ast
import functools
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "equations.md").read_text(encoding="utf-8")
PLANAR, SPATIAL = PAGE.split("## In three dimensions")
IN_CODE, CONSEQUENCES = PLANAR.split("## Consequences")
LAST = 48

#: ``Eq. (12)`` and ``Eqs. (24), (25) and (31)``.
_MENTION = re.compile(r"Eqs?\.((?:[\s,]|and|to|\((?:3D-)?\d+\))+)")


def rows(text: str, columns: int) -> list[tuple[str, ...]]:
    cells = [
        tuple(cell.strip().strip("`") for cell in line.strip("|\n ").split("|"))
        for line in text.splitlines()
        if line.startswith("| (")
    ]
    assert all(len(row) == columns for row in cells)
    return cells


SOURCES = rows(IN_CODE, 4)
RESULTS = rows(CONSEQUENCES, 3)
IN_SPACE = rows(SPATIAL, 4)


@functools.cache
def parsed(path: Path) -> tuple[str, ast.Module]:
    assert path.is_file(), f"there is no {path.relative_to(ROOT)}"
    text = path.read_text(encoding="utf-8")
    return text, ast.parse(text)


def found(path: Path, dotted: str) -> ast.FunctionDef | ast.ClassDef:
    """The function or class of that name, methods as ``Class.method``."""
    node: ast.AST = parsed(path)[1]
    for name in dotted.split("."):
        inside = [
            child
            for child in ast.iter_child_nodes(node)
            if isinstance(child, ast.FunctionDef | ast.ClassDef) and child.name == name
        ]
        assert inside, f"{path.relative_to(ROOT)} has no {dotted}"
        node = inside[-1]
    assert isinstance(node, ast.FunctionDef | ast.ClassDef)
    return node


def mentioned(path: Path, dotted: str) -> set[str]:
    """The equations named in the function or class, comments included, and in its module's docstring."""
    text, module = parsed(path)
    own = ast.get_source_segment(text, found(path, dotted)) or ""
    spoken = own + "\n" + (ast.get_docstring(module) or "")
    return named(spoken)


def named(text: str) -> set[str]:
    """The equations that a text mentions: ``Eqs. (24), (3D-6)`` gives 24 and 3D-6; of ``to``, all between."""
    numbers: set[str] = set()
    for group in _MENTION.findall(text):
        for first, last in re.findall(r"\(((?:3D-)?\d+)\)(?:\s+to\s+\(((?:3D-)?\d+)\))?", group):
            numbers.add(first)
            if last:
                space = "3D-" if first.startswith("3D-") else ""
                begin, end = (int(each.removeprefix("3D-")) for each in (first, last))
                numbers |= {f"{space}{n}" for n in range(begin, end + 1)}
    return numbers


def number(cell: str) -> str:
    return cell.strip("()")


def test_every_equation_stands_in_one_place_of_the_page() -> None:
    derivations = re.search(r"^Steps of the derivations.*", PAGE, re.MULTILINE)
    assert derivations is not None
    alone = [int(n) for n in re.findall(r"\((\d+)\)", derivations.group()) if int(n) <= LAST]
    listed = [int(number(row[0])) for row in SOURCES + RESULTS] + alone
    assert sorted(listed) == list(range(1, LAST + 1))


@pytest.mark.parametrize("row", SOURCES + IN_SPACE, ids=lambda row: row[0])
def test_the_source_exists_and_mentions_its_equation(row: tuple[str, ...]) -> None:
    file, dotted = row[2].split("::")
    path = ROOT / "src" / file.split("/")[0] / file
    assert number(row[0]) in mentioned(path, dotted), f"{row[2]} does not say `Eq. {row[0]}`"


@pytest.mark.parametrize("row", SOURCES + RESULTS + IN_SPACE, ids=lambda row: row[0])
def test_the_test_exists(row: tuple[str, ...]) -> None:
    file, dotted = row[-1].split("::")
    assert dotted.startswith("test_")
    assert isinstance(found(ROOT / "test" / file, dotted), ast.FunctionDef)


@pytest.mark.parametrize("row", RESULTS, ids=lambda row: row[0])
def test_a_consequence_is_named_where_it_is_tested(row: tuple[str, ...]) -> None:
    file, dotted = row[-1].split("::")
    assert number(row[0]) in mentioned(ROOT / "test" / file, dotted), f"{row[-1]} does not say `Eq. {row[0]}`"


def test_no_equation_is_mentioned_in_the_code_that_the_page_does_not_know() -> None:
    known = {number(row[0]) for row in SOURCES + RESULTS + IN_SPACE}
    for path in sorted((ROOT / "src").rglob("*.py")):
        numbers = named(path.read_text(encoding="utf-8"))
        assert numbers <= known, f"{path.relative_to(ROOT)} mentions {sorted(numbers - known)}"
