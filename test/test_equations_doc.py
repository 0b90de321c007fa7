"""docs/equations.md says where each equation is: every name on it exists and mentions its equation."""

from __future__ import annotations

import ast
import functools
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "equations.md").read_text(encoding="utf-8")
IN_CODE, CONSEQUENCES = PAGE.split("## Consequences")
LAST = 48

#: ``Eq. (12)`` and ``Eqs. (24), (25) and (31)``.
_MENTION = re.compile(r"Eqs?\.((?:[\s,]|and|\(\d+\))+)")


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


def mentioned(path: Path, dotted: str) -> set[int]:
    """The equations named in the function or class, comments included, and in its module's docstring."""
    text, module = parsed(path)
    own = ast.get_source_segment(text, found(path, dotted)) or ""
    spoken = own + "\n" + (ast.get_docstring(module) or "")
    numbers = re.findall(r"\((\d+)\)", " ".join(_MENTION.findall(spoken)))
    return {int(number) for number in numbers}


def number(cell: str) -> int:
    return int(cell.strip("()"))


def test_every_equation_stands_in_one_place_of_the_page() -> None:
    derivations = re.search(r"^Steps of the derivations.*", PAGE, re.MULTILINE)
    assert derivations is not None
    alone = [int(n) for n in re.findall(r"\((\d+)\)", derivations.group()) if int(n) <= LAST]
    listed = [number(row[0]) for row in SOURCES + RESULTS] + alone
    assert sorted(listed) == list(range(1, LAST + 1))


@pytest.mark.parametrize("row", SOURCES, ids=lambda row: row[0])
def test_the_source_exists_and_mentions_its_equation(row: tuple[str, ...]) -> None:
    file, dotted = row[2].split("::")
    path = ROOT / "src" / file.split("/")[0] / file
    assert number(row[0]) in mentioned(path, dotted), f"{row[2]} does not say `Eq. {row[0]}`"


@pytest.mark.parametrize("row", SOURCES + RESULTS, ids=lambda row: row[0])
def test_the_test_exists(row: tuple[str, ...]) -> None:
    file, dotted = row[-1].split("::")
    assert dotted.startswith("test_")
    assert isinstance(found(ROOT / "test" / file, dotted), ast.FunctionDef)


@pytest.mark.parametrize("row", RESULTS, ids=lambda row: row[0])
def test_a_consequence_is_named_where_it_is_tested(row: tuple[str, ...]) -> None:
    file, dotted = row[-1].split("::")
    assert number(row[0]) in mentioned(ROOT / "test" / file, dotted), f"{row[-1]} does not say `Eq. {row[0]}`"


def test_no_equation_is_mentioned_in_the_code_that_the_page_does_not_know() -> None:
    known = {number(row[0]) for row in SOURCES + RESULTS}
    for path in sorted((ROOT / "src").rglob("*.py")):
        groups = _MENTION.findall(path.read_text(encoding="utf-8"))
        numbers = {int(n) for n in re.findall(r"\((\d+)\)", " ".join(groups))}
        assert numbers <= known, f"{path.relative_to(ROOT)} mentions {sorted(numbers - known)}"
