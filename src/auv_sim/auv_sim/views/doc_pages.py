"""Pages of docs/ with a part that a command renews: it stands between two marks. Tables in Markdown."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError


def markdown_table(heads: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1) -> str:
    """Return a table whose columns are aligned to the right, but for the first `left` ones."""
    lines = [heads, ["---"] * left + ["---:"] * (len(heads) - left), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def marks(name: str) -> tuple[str, str]:
    """Return the lines before and after the part of this name."""
    return f"<!-- {name}: begin -->", f"<!-- {name}: end -->"


def check(page: Path, name: str) -> None:
    """Check before the work that its result can be written.

    Raises:
        ConfigurationError: no such page, or it has no such part, or it is not to be written.
    """
    _around(page, name)


def renew(page: Path, name: str, text: str) -> None:
    """Replace the text between the marks.

    Raises:
        ConfigurationError: as `check`.
    """
    before, behind = _around(page, name)
    begin, end = marks(name)
    write_text(page, f"{before}{begin}\n{text}\n{end}{behind}")


def _around(page: Path, name: str) -> tuple[str, str]:
    begin, end = marks(name)
    text = page.read_text(encoding="utf-8") if page.is_file() and os.access(page, os.W_OK) else ""
    before, _, rest = text.partition(begin)
    _, found, behind = rest.partition(end)
    if not found:
        raise ConfigurationError(
            "--page", f"{page} without a part to renew", f"a page with {begin} and {end}"
        )
    return before, behind
