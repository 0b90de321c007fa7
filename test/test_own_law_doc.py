"""The parameter file of docs/your_own_law.md chooses the law; test_habits.py compares the listings."""

from __future__ import annotations

from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_sim.sim_parameters import SUITE
from doc_pages import listings


def test_the_parameter_file_chooses_the_law(tmp_path: Path) -> None:
    (text,) = listings("docs/your_own_law.md", "yaml")
    (tmp_path / "my_law.yaml").write_text(text, encoding="utf-8")
    guidance = params_file.load(tmp_path / "my_law.yaml", SUITE)[topics.GUIDANCE].guidance
    assert guidance.law == "vector_field" and guidance.vector_field.gain == 0.2
