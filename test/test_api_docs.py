"""The API reference is built from the docstrings, without a warning."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from doc_pages import ROOT


def test_the_guidance_laws_are_documented(tmp_path: Path) -> None:
    """One sub-package stands for all: scripts/api_docs.py itself fails on any warning."""
    script = [sys.executable, str(ROOT / "scripts" / "api_docs.py"), "auv_path_following.guidance.laws"]
    done = subprocess.run([*script, "--out", str(tmp_path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "auv_path_following" / "guidance" / "laws" / "ailos.html").read_text(encoding="utf-8")
    assert "Eqs. (24), (25), (30), (31)" in page
