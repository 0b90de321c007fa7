"""The pages of the documentation, for the tests that hold them; as a program, copy the code that pages show.

cd test && python3 -m doc_pages
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = (
    "README.md",
    "CONTRIBUTING.md",
    "QUALITY_DECLARATION.md",
    *(f"docs/{page.name}" for page in sorted((ROOT / "docs").glob("*.md"))),
)
LAWS = ROOT / "src" / "auv_path_following" / "auv_path_following" / "guidance" / "laws"


def listings(page: str, language: str) -> list[str]:
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def copies() -> Iterator[tuple[str, str, str]]:
    """Yield page, shown text and source for each text that a page copies."""
    from test_architecture import ROOMS, ROS_ROOMS

    page = "CONTRIBUTING.md"
    order = [f"   - `{name}`: " + " <- ".join(f"`{room}`" for room in rooms) for name, rooms in ROOMS]
    for mark, lines in (("order of rooms", order), ("ros rooms", [f"   - `{room}`" for room in ROS_ROOMS])):
        text = (ROOT / page).read_text(encoding="utf-8")
        (shown,) = re.findall(rf"<!-- {mark}: begin -->\n.*?<!-- {mark}: end -->", text, re.DOTALL)
        yield page, shown, "\n".join([f"<!-- {mark}: begin -->", *lines, f"   <!-- {mark}: end -->"])
    page = "docs/your_own_law.md"
    law, line = listings(page, "python")
    yield page, law, (LAWS / "vector_field.py").read_text(encoding="utf-8")
    registered = (LAWS / "registered.py").read_text(encoding="utf-8")
    yield page, line, "".join(re.findall(r"^LAWS = .*\n", registered, re.MULTILINE))


def main() -> None:
    for page, shown, source in list(copies()):
        if shown != source:
            text = (ROOT / page).read_text(encoding="utf-8")
            (ROOT / page).write_text(text.replace(shown, source), encoding="utf-8")
            print("renewed", page)


if __name__ == "__main__":
    main()
