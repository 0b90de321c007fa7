"""docs/your_own_law.md shows the law, the list and a parameter file as they are."""

from __future__ import annotations

from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_sim.sim_parameters import SUITE
from doc_pages import ROOT, listings

PAGE = "docs/your_own_law.md"
LAWS = ROOT / "src" / "auv_path_following" / "auv_path_following" / "guidance" / "laws"


def test_the_listing_is_the_law() -> None:
    law, _ = listings(PAGE, "python")
    source = (LAWS / "vector_field.py").read_text(encoding="utf-8")
    assert law == source, f"copy vector_field.py into {PAGE}"


def test_the_line_is_that_of_the_list() -> None:
    _, line = listings(PAGE, "python")
    assert line in (LAWS / "registered.py").read_text(encoding="utf-8")


def test_the_parameter_file_chooses_the_law(tmp_path: Path) -> None:
    (text,) = listings(PAGE, "yaml")
    (tmp_path / "my_law.yaml").write_text(text, encoding="utf-8")
    guidance = params_file.load(tmp_path / "my_law.yaml", SUITE)[topics.GUIDANCE].guidance
    assert guidance.law == "vector_field" and guidance.vector_field.gain == 0.2
