"""Compare several runs: a table of their differences and one picture, for tuning."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np
from rich import box
from rich.markup import escape
from rich.table import Table

from auv_msgs_py.values.errors import ConfigurationError, printable
from auv_sim.bags.content.flown_settings import differences
from auv_sim.bags.content.recorded_mission import RecordedMission, mission_in
from auv_sim.bags.content.vehicle_parts import read_vehicles
from auv_sim.bags.showing.compare_picture import draw
from auv_sim.bags.verbs.arguments import add_choice
from auv_sim.command_line import target, to_type
from auv_sim.flight.by_odometry import ByOdometry
from auv_sim.flight.figures.mission_summary import MissionSummary, SpatialMissionSummary
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, wrote

#: Field of the summary, heading, digits.
_FIGURES = (
    ("flown_share", "flown share", 4),
    ("duration", "time s", 1),
    ("rms_distance", "rms distance m", 4),
    ("largest_distance", "largest m", 3),
    ("rms_heading_error", "rms heading °", 3),
    ("rudder_travel", "rudder °", 1),
    ("rudder_travel_per_metre", "rudder °/m", 4),
    ("mean_speed", "speed m/s", 3),
)
#: The further ones where every run is in three dimensions.
_VERTICAL = (
    ("rms_depth_error", "rms depth m", 4),
    ("largest_depth_error", "largest depth m", 3),
    ("sternplane_travel", "planes °", 1),
)

#: Longer values are cut in the table, characters.
_LONG = 60


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument(
        "bag", type=Path, nargs="+", metavar="BAG", help="two or more recordings or run directories"
    )
    parser.add_argument("--mission", metavar="FILE", help="the flown mission, if it is not recorded")
    add_choice(parser)
    parser.add_argument(
        "--png",
        type=target,
        metavar="FILE",
        default=Path("compare.png"),
        help="picture to write (default: compare.png)",
    )
    parser.add_argument("--json", action="store_true", help="print JSON, for programs")


def run(arguments: argparse.Namespace) -> int:
    """Compare with the first run."""
    found = [_flights(path, arguments) for path in arguments.bag]
    flights = [flight for each in found for flight in each.values()]
    if len(flights) < 2:
        raise ConfigurationError("compare", "one recording", "two or more")
    labels = [
        f"{label} {name}".strip()
        for label, each in zip(_labels(arguments.bag), found, strict=True)
        for name in each
    ]
    summaries = [flight.summary for flight in flights if flight.summary is not None]
    opinions = [flight.by_odometry for flight in flights]
    settings = differences([flight.bag for flight in flights])  # as they were at the start
    try:
        draw(flights, labels, arguments.png)
    except OSError as error:
        raise ConfigurationError(
            str(arguments.png), f"{error.strerror}", "a picture that can be written"
        ) from None
    if arguments.json:
        print(json.dumps(_data(labels, summaries, opinions, settings), indent=2, allow_nan=False))
        return 0
    console = terminal()
    console.print(_table(labels, summaries, opinions))
    console.print(_subpaths(labels, summaries))
    if settings:
        console.print(_settings_table(labels, settings))
    else:
        console.print("[dim]the same parameters in all of them[/dim]")
    wrote(console, arguments.png, "tracks and signals laid over each other")
    go_on(console, "Look into one of them", to_type("bag.py", "report", arguments.bag[-1]))
    return 0


def _flights(path: Path, arguments: argparse.Namespace) -> dict[str, RecordedMission]:
    """Read a recording: vehicle and mission -> the mission; the only one is under an empty name.

    Raises:
        ConfigurationError: one has no mission with figures.
    """
    found = {}
    bags = read_vehicles(path, odometry=arguments.odometry, namespace=arguments.namespace)
    for name, bag in bags.items():
        flight = mission_in(bag, arguments.mission, arguments.namespace)
        judged = [part for part in flight.missions if part.summary is not None]
        if not judged:
            why = flight.notes[0] if flight.notes else "no mission"
            raise ConfigurationError(f"{path} {name}".strip(), why, "a flown mission")
        for number, part in enumerate(judged, 1):
            of = f"{number} {part.mission.name}" if flight.parts and part.mission is not None else ""
            found[f"{name} {of}".strip()] = part
    return found


def _data(
    labels: list[str],
    summaries: list[MissionSummary],
    opinions: list[ByOdometry | None],
    settings: dict[str, list[str | None]],
) -> dict[str, Any]:
    """Return the comparison as plain data."""
    return {
        "runs": {label: json.loads(s.to_json()) for label, s in zip(labels, summaries, strict=True)},
        "by_odometry": {
            label: {"rms_distance": found.rms, "largest_distance": found.largest} if found else None
            for label, found in zip(labels, opinions, strict=True)
        },
        "settings": settings,
    }


def _labels(paths: list[Path]) -> list[str]:
    """Return the shortest names that distinguish the runs."""
    resolved = [path.resolve() for path in paths]
    names = [path.parent.name if path.name == "bag" else path.stem for path in resolved]
    return names if len(set(names)) == len(names) else [str(path) for path in paths]


def _table(labels: list[str], summaries: list[MissionSummary], opinions: list[ByOdometry | None]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("run")
    dive = all(isinstance(summary, SpatialMissionSummary) for summary in summaries)
    figures = _FIGURES + (_VERTICAL if dive else ())
    for _, heading, _ in figures:
        table.add_column(heading, justify="right")
    if any(opinions):
        table.add_column("rms by odometry m", justify="right")
    first = summaries[0]
    for label, summary, opinion in zip(labels, summaries, opinions, strict=True):
        cells = []
        for name, _, digits in figures:
            value, base = getattr(summary, name), getattr(first, name)
            text = f"{value:.{digits}f}" if np.isfinite(value) else "-"
            if summary is not first and np.isfinite(value) and np.isfinite(base) and base != 0.0:
                change = 100.0 * (value - base) / abs(base)
                text += f"\n[dim]{change:+.1f} %[/dim]"
            cells.append(text)
        if any(opinions):
            cells.append(f"{opinion.rms:.4f}" if opinion else "-")
        table.add_row(escape(label), *cells)
    return table


def _subpaths(labels: list[str], summaries: list[MissionSummary]) -> Table:
    table = Table(title="rms distance m", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("subpath")
    for label in labels:
        table.add_column(escape(label), justify="right")
    most = max(summaries, key=lambda summary: len(summary.subpaths))
    for k, part in enumerate(most.subpaths):
        cells = [f"{s.subpaths[k].rms_distance:.4f}" if k < len(s.subpaths) else "-" for s in summaries]
        table.add_row(f"{part.number} {part.kind}", *cells)
    return table


def _settings_table(labels: list[str], settings: dict[str, list[str | None]]) -> Table:
    table = Table(title="parameters that differ", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("parameter")
    for label in labels:
        table.add_column(escape(label), justify="right")
    for name, values in settings.items():
        table.add_row(_cell(name), *["-" if value is None else _cell(value) for value in values])
    return table


def _cell(value: str) -> str:
    """Return a text from a recording for a table; long lists are cut."""
    value = printable(value)
    return escape(value if len(value) <= _LONG else f"{value[:_LONG]}…")
