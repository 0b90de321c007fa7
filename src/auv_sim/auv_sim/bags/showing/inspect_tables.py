"""The tables of `inspect`."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import numpy as np
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.values.errors import printable
from auv_sim.bags.content.events import Event
from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.bags.content.topic_facts import TopicFacts
from auv_sim.flight.figures.mission_summary import (
    MissionSummary,
    SpatialMissionSummary,
    SpatialSubpathSummary,
    SubpathSummary,
)
from auv_sim.flight.flown_share import percent
from auv_sim.flight.run_record import SpatialRun

#: More events than this are counted, not listed.
_EVENTS = 40
_COLOURS = {0: "", 1: "yellow", 2: "red"}


def show(flight: RecordedMission, facts: list[TopicFacts], events: list[Event], console: Console) -> None:
    """Print one recording."""
    bag = flight.bag
    first, last = bag.span_ns
    files = next(iter(bag.files)).name if len(bag.files) == 1 else f"{len(bag.files)} files"
    of = f" {bag.vehicle}" if bag.vehicle is not None else ""
    console.print(f"[bold]{escape(str(bag.path))}[/bold]{escape(of)}", soft_wrap=True)
    seconds = (last - first) * 1e-9
    console.print(
        f"{seconds:.2f} s, {bag.count} messages of {len(facts)} topics, {size(bag.size)} in {files}"
    )
    for note in bag.notes:
        console.print(f"[yellow]damaged:[/yellow] {escape(note)}", soft_wrap=True)
    console.print(_topics(facts))
    for note in flight.notes:
        console.print(f"[dim]{escape(note)}[/dim]", soft_wrap=True)
    summary = flight.summary
    if flight.parts:
        console.print(missions(flight))
    elif summary is not None and flight.mission is not None:
        console.print(mission(summary, flight.mission.name))
        if (own := flight.by_odometry) is not None:
            console.print(f"distance by odometry: rms {own.rms:.3f} m, largest {own.largest:.3f} m")
        console.print(summary.flown_line(), soft_wrap=True)
    elif flight.run is not None and flight.run.steps > 1:
        run = flight.run
        length = float(np.hypot(np.diff(run.x), np.diff(run.y)).sum())
        seconds = float(run.t[-1] - run.t[0])
        console.print(f"odometry: {seconds:.1f} s, {length:.1f} m, {length / seconds:.2f} m/s on average")
    if isinstance(flight.run, SpatialRun):
        console.print(_vertical(flight.run), soft_wrap=True)
    _events(events, first * 1e-9, console)


def _vertical(run: SpatialRun) -> str:
    """Return the ranges of depth, pitch and stern planes as text."""
    ranges = [
        ("depth", run.depth, "m"),
        ("pitch", np.degrees(run.theta), "°"),
        ("stern planes", np.degrees(run.sternplanes), "°"),
    ]
    known = [(name, values[np.isfinite(values)], unit) for name, values, unit in ranges]
    return "; ".join(
        f"{name} {values.min():.2f} to {values.max():.2f} {unit}"
        for name, values, unit in known
        if values.size
    )


def _topics(facts: list[TopicFacts]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("topic", overflow="fold")
    table.add_column("type", style="dim", overflow="fold")
    for heading in ("count", "rate Hz", "gaps", "longest s", "jitter ms", "old", "lost", "size"):
        table.add_column(heading, justify="right", no_wrap=True)
    for f in facts:
        table.add_row(
            _cell(f.name), _cell(f.type.replace("/msg/", "/")), str(f.count), _number(f.rate, 2),
            _alarm(f.gaps), _number(f.longest_gap, 3), _number(f.jitter, 2), _alarm(f.out_of_order),
            _alarm(f.lost), size(f.bytes),
        )  # fmt: skip
    return table


def mission(summary: MissionSummary, name: str) -> Table:
    """Return the mission's figures, a row for each subpath."""
    table = Table(
        title=f"{escape(name)}: {summary.outcome()}",
        title_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
    )
    table.add_column("subpath")
    headings = ["time s", "rms distance m", "largest m", "rms heading °", "rudder °", "rudder °/m"]
    if isinstance(summary, SpatialMissionSummary):
        headings += ["rms depth m", "largest depth m", "planes °/m", "pitch °"]
    for heading in headings:
        table.add_column(heading, justify="right")
    for part in summary.subpaths:
        table.add_row(f"{part.number} {part.kind}", *_figures(part))
    table.add_section()
    table.add_row("all", *_figures(summary))
    return table


def missions(flight: RecordedMission) -> Table:
    """Return the figures of several missions, a row for each."""
    table = Table(title="missions", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for heading in ("mission", "began at", "outcome"):
        table.add_column(heading, overflow="fold")
    headings = ["flown", "time s", "rms distance m", "largest m", "rms heading °", "rudder °", "rudder °/m"]
    if isinstance(flight.run, SpatialRun):
        headings += ["rms depth m", "largest depth m", "planes °/m", "pitch °"]
    for heading in headings:
        table.add_column(heading, justify="right")
    for number, part in enumerate(flight.parts, 1):
        summary = part.summary
        name = part.mission.name if part.mission is not None else "not recorded"
        figures = ["-"] * len(headings)
        if summary is not None:
            figures = [percent(summary.flown_share), *_figures(summary)]
            figures += ["-"] * (len(headings) - len(figures))
        table.add_row(_cell(f"{number} {name}"), _cell(part.place or "start"), _ending(part), *figures)
    return table


def _ending(part: RecordedMission) -> str:
    """Return how a mission ended: as guidance reported it, and why unless it is complete."""
    state, reason = part.ended
    return _cell(state if state == MissionState.COMPLETE or not reason else f"{state}: {reason}")


def _figures(part: MissionSummary | SubpathSummary) -> list[str]:
    vertical = []
    if isinstance(part, SpatialMissionSummary | SpatialSubpathSummary):
        vertical = [
            _number(part.rms_depth_error, 3),
            _number(part.largest_depth_error, 3),
            _number(part.sternplane_travel_per_metre, 3),
            _number(part.largest_pitch, 1),
        ]
    return [
        _number(part.duration, 1),
        _number(part.rms_distance, 3),
        _number(part.largest_distance, 3),
        _number(part.rms_heading_error, 2),
        _number(part.rudder_travel, 1),
        _number(part.rudder_travel_per_metre, 3),
        *vertical,
    ]


def _events(events: list[Event], start: float, console: Console) -> None:
    if not events:
        return
    table = Table(title="events", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("at s", justify="right", no_wrap=True)
    table.add_column("what", no_wrap=True)
    table.add_column("", overflow="fold")
    # Equal events share one line.
    repeats = Counter((event.kind, event.text) for event in events)
    last = {(event.kind, event.text): event.time for event in events}
    lines = list({(event.kind, event.text): event for event in reversed(events)}.values())[::-1]
    # Of too many, the most severe are kept.
    kept = sorted(lines, key=lambda event: -event.level)[:_EVENTS]
    for event in sorted(kept, key=lambda event: event.time):
        colour, key = _COLOURS[event.level], (event.kind, event.text)
        again = (
            f" [dim]({repeats[key]} times, last at {last[key] - start:.2f} s)[/dim]"
            if repeats[key] > 1
            else ""
        )
        kind = f"[{colour}]{event.kind}[/{colour}]" if colour else event.kind
        table.add_row(f"{event.time - start:.2f}", kind, _cell(event.text) + again)
    console.print(table)
    if len(kept) < len(lines):
        console.print(f"[dim]and {len(lines) - len(kept)} other kinds (--json lists all)[/dim]")


def show_many(rows: list[tuple[Path, RecordedMission | None, str]], console: Console) -> None:
    """Print a row for each recording."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("recording", overflow="fold")
    for heading in ("s", "messages", "size", "rms m", "largest m", "rudder °/m"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("mission")
    table.add_column("notes", style="yellow", overflow="fold")
    for path, flight, note in rows:
        if flight is None:
            table.add_row(escape(str(path)), *["-"] * 6, "[red]unreadable[/red]", escape(note))
            continue
        first, last = flight.bag.span_ns
        name = f"{path} {flight.bag.vehicle or ''}".strip()
        whole = (
            escape(name), f"{(last - first) * 1e-9:.1f}", str(flight.bag.count), size(flight.bag.size),
        )  # fmt: skip
        for number, part in enumerate(flight.missions):
            table.add_row(*(whole if not number else [""] * 4), *_judged(part), escape(note))
    console.print(table)


def _judged(flight: RecordedMission) -> list[str]:
    """Return the figures of a mission in the row of its recording, and how it went."""
    summary = flight.summary
    if summary is None:
        return ["-"] * 4
    values = (summary.rms_distance, summary.largest_distance, summary.rudder_travel_per_metre)
    state = f"{summary.outcome()}, {percent(summary.flown_share)} flown"
    return [*(_number(value, 3) for value in values), state]


def size(number: int) -> str:
    """Return a size in bytes with its unit."""
    for unit, factor in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if number >= factor:
            return f"{number / factor:.1f} {unit}"
    return f"{number} B"


def _cell(text: str) -> str:
    """Return a text from a recording, safe for a terminal and without markup."""
    return escape(printable(text))


def _number(value: float | None, digits: int) -> str:
    return "-" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"


def _alarm(number: int | None) -> str:
    if number is None:
        return "-"
    return f"[yellow]{number}[/yellow]" if number else "0"
