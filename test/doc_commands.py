"""The commands that the pages of the documentation print, with something in place of their placeholders."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from typing import NamedTuple

from auv_path_following import config_files
from doc_pages import PAGES, ROOT

#: Options that name a file, and the folder of config/ that ships such files.
FILES: dict[str, config_files.Kind] = {
    "mission": "missions",
    "vehicle": "vehicles",
    "params": "params",
    "sea": "seas",
}


class Line(NamedTuple):
    """A command as a page prints it, without its comment."""

    page: str
    text: str

    def __str__(self) -> str:
        return f"{self.page}: {self.text}"


def lines() -> Iterator[Line]:
    """Indented lines that begin as a command does; test_tutorial.py runs those of the tutorial."""
    for page in PAGES:
        if page == "docs/tutorial.md":
            continue
        for text in (ROOT / page).read_text(encoding="utf-8").splitlines():
            found = re.match(r"    ((?:python3|ros2|pip|cd|mkdir|source|rosdep|sudo)\b.*)", text)
            if found:
                yield Line(
                    page, shlex.join(shlex.split(found[1], comments=True)) if "#" in found[1] else found[1]
                )


LINES = sorted(set(lines()))


def words_of(line: Line, run: object = "runs/example") -> list[str]:
    """The arguments of a script, with something in place of MISSION, RUN and the like."""
    stands_for = {
        "MISSION": "survey_wgs84", "RUN": str(run), "runs/...": str(run), "NEW.yaml": "rough",
        "signed.yaml": "robust", "my_law.yaml": "robust", "rule": "robust", "path.kml": "/dev/null",
        "mine.yaml": "remus100",
        "tuned.yaml": "robust", "selkie.yaml": "remus100", "selkie_identified.yaml": "remus100",
        "selkie_survey.yaml": "survey_wgs84", "my_study": "currents", "...": str(run),
    }  # fmt: skip
    return [stands_for.get(word, word) for word in shlex.split(line.text)[2:]]


def script_of(line: Line) -> str:
    found = re.match(r"python3 scripts/(\w+)\.py", line.text)
    return found[1] if found else ""


def chosen(script: str) -> list[Line]:
    return [line for line in LINES if script_of(line) == script]
