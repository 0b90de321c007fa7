"""The page of a proof: verdict, sentence, tables, pictures, and what was flown, in one file to print."""

from __future__ import annotations

import base64
import html
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import NamedTuple

from auv_msgs_py.settings.result_files import write_text

_PAGE = "proof_page.html"


class PageTable(NamedTuple):
    """A table: title, headings, rows, and a line below it (may be empty)."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    hint: str


class Page(NamedTuple):
    """The content of the page.

    Attributes:
        title: above all.
        is_proven: the verdict's colour.
        verdict, sentence: in words.
        notice: against the verdict's worth; empty for none.
        tables: in their order.
        picture, flight: PNG files of the distributions and of the worst flight.
        worst: about that flight.
        refly: command that repeats it.
        facts: what was flown, by name.
    """

    title: str
    is_proven: bool
    verdict: str
    sentence: str
    notice: str
    tables: Sequence[PageTable]
    picture: Path
    flight: Path
    worst: str
    refly: str
    facts: Mapping[str, str]


def write(target: Path, page: Page) -> None:
    """Write the page; pictures and colours are in it.

    Raises:
        NotWritten: it cannot be written.
    """
    sheet = resources.files("auv_sim.views.console").joinpath("page", "colours.css")
    text = resources.files("auv_sim.own_vehicle.prove").joinpath(_PAGE).read_text(encoding="utf-8")
    notice = f'<p class="verdict no">{html.escape(page.notice)}</p>\n' if page.notice else ""
    fields = {
        "COLOURS": sheet.read_text(encoding="utf-8"),
        "TITLE": html.escape(page.title),
        "CLASS": "yes" if page.is_proven else "no",
        "VERDICT": html.escape(page.verdict),
        "SENTENCE": html.escape(page.sentence),
        "NOTICE": notice,
        "TABLES": "".join(map(_table, page.tables)),
        "PICTURE": _embedded(page.picture),
        "WORST": html.escape(page.worst),
        "FLIGHT": _embedded(page.flight),
        "REFLY": html.escape(page.refly),
        "FACTS": "".join(
            f"<tr><td>{html.escape(name)}</td><td>{html.escape(value)}</td></tr>\n"
            for name, value in page.facts.items()
        ),
    }
    # Split once: a value that contains a placeholder stays as it is.
    first, *rest = text.split("{{")
    parts = (part.partition("}}") for part in rest)
    write_text(target, first + "".join(fields[name] + after for name, _, after in parts))


def _table(table: PageTable) -> str:
    head = "".join(f"<th>{html.escape(text)}</th>" for text in table.head)
    rows = "".join(
        f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>\n" for row in table.rows
    )
    hint = f'<p class="hint">{html.escape(table.hint)}</p>' if table.hint else ""
    title = html.escape(table.title)
    return f"<section><h2>{title}</h2><table><tr>{head}</tr>\n{rows}</table>{hint}</section>\n"


def _embedded(picture: Path) -> str:
    return f"data:image/png;base64,{base64.b64encode(picture.read_bytes()).decode('ascii')}"
