"""The words that people read: programs report, assume and request; persons tell, believe and wish."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
#: Words that make a native reader stumble when said of programs or things. Identifiers are read too.
STUMBLING = re.compile(
    r"(?<![a-z])(told|tells?|believe[sd]?|knows|wish|wishes|wished|wanted|somebody|nobody|whoever|who"
    r"|for so long|does well|comes to|by itself|to and fro)(?![a-z])",
    re.IGNORECASE,
)
#: Where one of them is right: (file, word) -> (how often, why).
RIGHT: dict[tuple[str, str], tuple[int, str]] = {
    ("CHANGELOG.md", "believed"): (3, "the former name of an option, a key and a file"),
    ("src/auv_sim/auv_sim/bags/content/recorded_mission.py", "believed"): (1, "the former name of a file"),
    ("src/auv_sim/auv_sim/cli/mission.py", "believed"): (1, "the former name of the option"),
    ("src/auv_sim/auv_sim/studies/campaign/study_file.py", "believed"): (1, "the former name of the key"),
    ("src/auv_sim/auv_sim/own_vehicle/tune/search.py", "tell"): (1, "a method of the optimiser"),
}
MOST = 25


def pages() -> list[Path]:
    folders = ("src", "docs", "scripts", "config", ".github", "examples")
    kinds = {".py", ".md", ".yaml", ".yml", ".html", ".xml"}
    found = [path for folder in folders for path in (ROOT / folder).rglob("*") if path.suffix in kinds]
    unread = {"build", "node_modules", ".hypothesis", "api"}
    return [*ROOT.glob("*.md"), *(path for path in found if not unread & set(path.parts))]


def test_persons_tell_and_programs_report() -> None:
    found = Counter(
        (str(path.relative_to(ROOT)), match[0].lower())
        for path in pages()
        for match in STUMBLING.finditer(path.read_text(encoding="utf-8"))
    )
    unexplained = {place: count for place, count in found.items() if count > RIGHT.get(place, (0, ""))[0]}
    assert unexplained == {}
    assert {place for place in RIGHT if place not in found} == set(), "an exception that is no longer needed"
    assert sum(found.values()) < MOST


def test_the_search_finds_words_in_sentences_and_in_names() -> None:
    text = "Nobody tells it. told_once = 1; class Wanted: ...; It stops by itself. knowledge, untold, whole"
    assert [match[0] for match in STUMBLING.finditer(text)] == [
        "Nobody",
        "tells",
        "told",
        "Wanted",
        "by itself",
    ]
