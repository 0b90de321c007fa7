"""The commands of docs/tutorial.md work in their order, and print what the page quotes."""

from __future__ import annotations

from pathlib import Path

import pytest

import tutorial


@pytest.mark.usefixtures("domain")
def test_the_tutorial_runs_and_prints_what_it_quotes(tmp_path: Path) -> None:
    """In one process, which is faster and in lockstep the same to the last bit."""
    tutorial.prepare(tmp_path)
    for step in tutorial.steps():
        if "sea_trials" in step.command:
            tutorial.run(f"{step.command} --help", tmp_path)  # parsed; the fifty days take too long here
        else:
            faster = step.command.replace("mission.py", "mission.py --composed")
            tutorial.check(step, tutorial.run(faster, tmp_path))
    for made in tutorial.PICTURES:
        assert (tmp_path / made).is_file()


def test_the_page_shows_every_picture() -> None:
    for picture in tutorial.PICTURES.values():
        assert f"(images/{picture})" in tutorial.text()
