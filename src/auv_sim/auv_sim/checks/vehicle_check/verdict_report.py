"""The verdicts as a table for people and as JSON for programs."""

from __future__ import annotations

from typing import Any

from rich.table import Table

from auv_sim.checks.vehicle_check.items.all_items import mistakes
from auv_sim.checks.vehicle_check.samples import Recording
from auv_sim.checks.vehicle_check.verdict import Level, Verdict

_STYLE = {Level.PASS: "green", Level.WARN: "yellow", Level.FAIL: "bold red", Level.UNKNOWN: "dim"}


def table(verdicts: list[Verdict], title: str) -> Table:
    """Return a table with a row for each item."""
    made = Table(title=title, title_justify="left")
    for heading in ("item", "verdict", "measured", "expected"):
        made.add_column(heading, overflow="fold")
    for v in verdicts:
        style = _STYLE[v.level]
        measured = f"{v.measured}\n[bold]{v.mistake.value}[/bold]" if v.mistake is not None else v.measured
        made.add_row(v.item, f"[{style}]{v.level.value}[/{style}]", measured, v.expected)
    return made


def as_dict(verdicts: list[Verdict], recording: Recording) -> dict[str, Any]:
    """Return the verdicts for programs; the names of mistakes do not change."""
    items = [
        {
            "item": v.item,
            "verdict": v.level.value,
            "measured": v.measured,
            "expected": v.expected,
            "mistake": v.mistake.name if v.mistake is not None else None,
        }
        for v in verdicts
    ]
    return {
        "passed": not mistakes(verdicts),
        "listened_in": recording.listened_in,
        "listened_s": round(recording.duration, 3),
        "clock": "/clock" if recording.sim_time else "system",
        "items": items,
    }


def conclusion(verdicts: list[Verdict]) -> str:
    """Return one line: the counts, and what to do next."""
    count = {level: sum(v.level is level for v in verdicts) for level in Level}
    text = f"{count[Level.PASS]} passed, {count[Level.WARN]} warnings, {count[Level.FAIL]} failed"
    if count[Level.UNKNOWN]:
        text += f", {count[Level.UNKNOWN]} not judged"
    if count[Level.FAIL]:
        return f"{text}: not fit for a mission"
    if mistakes(verdicts):
        return f"{text}: not fit for a mission until all of it is judged"
    if any(v.level is Level.UNKNOWN and "--wiggle" in v.expected for v in verdicts):
        return f"{text}: let it move, with --wiggle for instance"
    return f"{text}: fit for a mission"
