"""Tables in Markdown."""

from __future__ import annotations

from auv_sim.views.doc_pages import markdown_table


def test_a_table_has_its_text_to_the_left_and_its_numbers_to_the_right() -> None:
    assert markdown_table(("gains", "rms", "travel"), [("robust", "0.1", "2")]) == (
        "| gains | rms | travel |\n| --- | ---: | ---: |\n| robust | 0.1 | 2 |"
    )
    assert markdown_table(["a", "b", "c"], [], left=2) == "| a | b | c |\n| --- | --- | ---: |"
