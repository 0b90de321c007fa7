"""Writes one self-contained HTML page: claims, numbers, verdicts, figures."""

from __future__ import annotations

import base64
import html
from collections.abc import Mapping, Sequence
from pathlib import Path

from auv_msgs_py.settings.result_files import write_text
from auv_sim.studies.paper.claims.paper_claim import FAILS, HOLDS, PaperClaim
from auv_sim.studies.paper.closest_corner import Bound
from auv_sim.studies.paper.figures import FIGURES

_STYLE = """
:root { color-scheme: light; --ink: #1b2733; --muted: #5f6b77; --line: #dde3e8; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); max-width: 72rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem } h2 { font-size: 1.2rem; margin: 2.5rem 0 .4rem }
p.lead, figcaption, .rule, .remark { color: var(--muted) }
.rule, .remark, figcaption { font-size: .9rem }
table { border-collapse: collapse; margin: .6rem 0; font-size: .9rem }
td, th { padding: .2rem .8rem .2rem 0; text-align: left; vertical-align: top }
tr { border-bottom: 1px solid var(--line) }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap }
.verdict { display: inline-block; padding: .1rem .6rem; border-radius: 1rem; font-size: .9rem;
  font-weight: 600 }
.holds { background: #d9f2e5; color: #12613f } .partly { background: #fdeccd; color: #7a4b00 }
.fails { background: #fbdadf; color: #8c1226 }
img { width: 100%; height: auto; border: 1px solid var(--line) }
figure { margin: 1rem 0 } a { color: #0b5fa5 }
""".strip()


def write(
    file: Path,
    claims: Sequence[PaperClaim],
    stems: Mapping[int, Path],
    corner: Mapping[str, Bound],
    facts: str,
) -> None:
    """Write the page.

    Args:
        file: the page.
        claims: in the order in which they are shown.
        stems: figure number -> its files without suffix.
        corner: smallest deviation found at the corner, by kind of search.
        facts: one line on the flights.
    """
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width, initial-scale=1'>",
        f"<title>The paper, claim by claim</title><style>{_STYLE}</style>",
        "<h1>The paper, claim by claim</h1>",
        f"<p class='lead'>{html.escape(facts)} Every verdict is computed from the flights by the rule "
        "beside it.</p>",
        _overview(claims),
    ]
    shown: set[int] = set()
    for claim in claims:
        parts.append(_claim(claim))
        if claim.figure and claim.figure not in shown:
            shown.add(claim.figure)
            parts.append(_figure(claim.figure, stems[claim.figure]))
        if claim.key == "early_switching":
            parts.append(_corner(corner))
    rest = [number for number in stems if number not in shown]
    if rest:
        parts.append("<h2>Further figures</h2>")
        parts += [_figure(number, stems[number]) for number in rest]
    parts.append("</html>\n")
    write_text(file, "\n".join(parts))


def _badge(verdict: str) -> str:
    kind = "holds" if verdict == HOLDS else "fails" if verdict == FAILS else "partly"
    return f"<span class='verdict {kind}'>{html.escape(verdict)}</span>"


def _overview(claims: Sequence[PaperClaim]) -> str:
    rows = "".join(
        f"<tr><td><a "
        f"href='#{c.key}'>{html.escape(c.claim)}</a></td><td>{html.escape(c.place)}</td><td>{_badge(c.verdict)}</td></tr>"
        for c in claims
    )
    return f"<table><tr><th>claim</th><th>where</th><th>verdict</th></tr>{rows}</table>"


def _claim(claim: PaperClaim) -> str:
    rows = "".join(
        f"<tr><td>{html.escape(n.what)}</td><td class='number'>{html.escape(n.text)}</td></tr>"
        for n in claim.numbers
    )
    remark = f"<p class='remark'>{html.escape(claim.remark)}</p>" if claim.remark else ""
    return (
        f"<section id='{claim.key}'><h2>{html.escape(claim.claim)}</h2>"
        f"<p>{_badge(claim.verdict)} <span class='rule'>{html.escape(claim.place)}</span></p>"
        f"<p class='rule'>Rule: {html.escape(claim.rule)}</p><table>{rows}</table>{remark}</section>"
    )


def _figure(number: int, stem: Path) -> str:
    data = base64.b64encode(stem.with_suffix(".png").read_bytes()).decode("ascii")
    title = FIGURES[number][0]
    return (
        f"<figure><img alt='Figure {number}: {html.escape(title)}' src='data:image/png;base64,{data}'>"
        f"<figcaption>Figure {number}. {html.escape(title)}. Data: {stem.name}.csv, vector: "
        f"{stem.name}.svg</figcaption></figure>"
    )


def _corner(corner: Mapping[str, Bound]) -> str:
    rows = "".join(
        f"<tr><td>{html.escape(kind)}</td><td class='number'>{bound.deviation:.2f} m</td></tr>"
        for kind, bound in corner.items()
    )
    return (
        "<p>The smallest deviation at this corner that a search over rudder programmes found, for "
        "this hull and "
        f"a rudder of 35° and 15°/s, with the corner given beforehand:</p><table>{rows}</table>"
    )
