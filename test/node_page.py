"""Evaluates code with the modules of the console's page under node."""

from __future__ import annotations

import json
import shutil
import subprocess
from importlib import resources
from typing import Any

import pytest

PAGE = resources.files("auv_sim.views.console").joinpath("page")
NODE = shutil.which("node")
_END = "console.log(JSON.stringify(out)); process.exit(0)"
needs_node = pytest.mark.skipif(NODE is None, reason="not run: no node")


def evaluate(code: str) -> Any:
    """Return what `out` is after some code that may import modules of the page."""
    assert NODE is not None
    for name in ("geodesy", "rows", "drawing", "link", "map_drawing", "flights", "typed"):
        code = code.replace(f"'{name}'", f"'file://{PAGE.joinpath(f'{name}.js')}'")
    done = subprocess.run(
        [NODE, "--input-type=module", "-e", f"let out;\n{code}\n{_END}"],
        capture_output=True, text=True, check=False, timeout=180,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
