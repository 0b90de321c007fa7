#!/usr/bin/env python3
"""Build the API reference from the docstrings, with pdoc. Sets itself up on first use."""

from __future__ import annotations

import argparse
import importlib
import inspect
import pkgutil
import sys
import typing
import warnings
from pathlib import Path

from _bootstrap import PACKAGES, REPOSITORY, ensure_environment


def modules(name: str) -> list[str]:
    """Import a module and those below it; return their names."""
    top = importlib.import_module(name)
    below = pkgutil.walk_packages(getattr(top, "__path__", []), f"{name}.")
    names = [name, *(found.name for found in below if not found.name.endswith("__main__"))]
    for each in names:
        for _, thing in inspect.getmembers(importlib.import_module(each), inspect.isclass):
            if thing.__module__ == each:
                resolve_annotations(thing)
    return names


def resolve_annotations(thing: typing.Any) -> None:
    """Give a constructor that a library generated annotations that pdoc can evaluate."""
    if issubclass(thing, tuple) and hasattr(thing, "_fields"):
        thing.__new__.__annotations__ = typing.get_type_hints(thing)
    elif hasattr(thing, "__pydantic_fields__"):
        thing.__init__.__annotations__ = {}


def main() -> int:
    """Return 0 if the reference was built without a warning, else 1."""
    parser = argparse.ArgumentParser(prog="api_docs.py", description=__doc__)
    parser.add_argument("module", nargs="*", default=PACKAGES, help="default: the three packages")
    parser.add_argument("--out", type=Path, default=Path(REPOSITORY, "api"), help="directory (default: api)")
    asked = parser.parse_args()
    import pdoc.render

    names = [each for name in asked.module for each in modules(name)]
    pdoc.render.configure(docformat="google", show_source=False)
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        pdoc.pdoc(*asked.module, output_directory=asked.out)
    for warning in found:
        print("warning", warning.message, file=sys.stderr)
    print(f"{len(names)} modules, {len(found)} warnings: {asked.out / 'index.html'}")
    return int(bool(found))


if __name__ == "__main__":
    ensure_environment(extra=("docs",))
    raise SystemExit(main())
