"""Pages of docs/: the part between two marks is renewed, the rest stays."""

from __future__ import annotations

from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.views import doc_pages


def test_a_page_is_renewed_between_its_marks(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    begin, end = doc_pages.marks("table")
    page.write_text(f"before\n{begin}\nold\n{end}\nbehind\n", encoding="utf-8")
    doc_pages.renew(page, "table", "new")
    assert page.read_text(encoding="utf-8") == f"before\n{begin}\nnew\n{end}\nbehind\n"
    with pytest.raises(
        ConfigurationError, match=r"--page: found .*, expected a page with <!-- figures: begin"
    ):
        doc_pages.check(page, "figures")
    with pytest.raises(ConfigurationError, match="--page: found "):
        doc_pages.check(tmp_path / "none.md", "table")


def test_a_table_has_its_text_to_the_left_and_its_numbers_to_the_right() -> None:
    assert doc_pages.markdown_table(("gains", "rms", "travel"), [("robust", "0.1", "2")]) == (
        "| gains | rms | travel |\n| --- | ---: | ---: |\n| robust | 0.1 | 2 |"
    )
    assert doc_pages.markdown_table(["a", "b", "c"], [], left=2) == "| a | b | c |\n| --- | --- | ---: |"
