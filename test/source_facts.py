"""Facts about source files that the rules of CONTRIBUTING.md are tested by; each file is parsed once."""

from __future__ import annotations

import ast
import functools
from pathlib import Path
from typing import NamedTuple


class Facts(NamedTuple):
    """Facts about one source file.

    Attributes:
        imports: every module named by an import, wherever it stands; `from a import b` gives ``a.b``.
        defined: every name that is assigned or defined as a function.
        attributes: names of all attributes, and those that begin with an underscore as they are written.
        random: what is used of `numpy.random`.
        functions: (name, lines) of each function.
        classes: public ones at the top.
        has_annotations: whether anything in it may be annotated.
    """

    imports: tuple[str, ...]
    defined: frozenset[str]
    attributes: frozenset[str]
    random: frozenset[str]
    functions: tuple[tuple[str, int], ...]
    classes: tuple[str, ...]
    has_annotations: bool


@functools.cache
def facts(path: Path) -> Facts:
    """Return the facts about a file, cached: parsing a thousand files takes seconds."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    imported: list[str] = []
    names, attributes, random = set[str](), set[str](), set[str]()
    functions: list[tuple[str, int]] = []
    annotated = False
    for node in ast.walk(tree):
        match node:
            case ast.Import():
                imported += (alias.name for alias in node.names)
            case ast.ImportFrom():
                assert node.level == 0, f"{path}: a relative import hides where it points"
                imported += (f"{node.module}.{alias.name}" for alias in node.names)
            case ast.Name(id=name, ctx=ast.Store()):
                names.add(name)
            case ast.AnnAssign():
                annotated = True
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                names.add(node.name)
                functions.append((node.name, (node.end_lineno or node.lineno) - node.lineno + 1))
            case ast.Attribute(attr=name):
                attributes |= {name, ast.unparse(node)} if name.startswith("_") else {name}
                if isinstance(node.ctx, ast.Store):
                    names.add(name)
                if isinstance(node.value, ast.Attribute) and node.value.attr == "random":
                    random |= {name} if ast.unparse(node.value) in ("np.random", "numpy.random") else set()
    classes = (node.name for node in tree.body if isinstance(node, ast.ClassDef))
    return Facts(
        tuple(imported), frozenset(names), frozenset(attributes), frozenset(random), tuple(functions),
        tuple(name for name in classes if not name.startswith("_")), annotated or bool(functions),
    )  # fmt: skip
