"""Lay several runs over each other: a table of their differences and one picture, for tuning."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np
from rich import box
from rich.markup import escape
from rich.table import Table

from auv_msgs_py import yaml_file
from auv_msgs_py.errors import ConfigurationError
from auv_sim.analysis.metrics import MissionSummary
from auv_sim.bags.arguments import add_choice
from auv_sim.bags.compare_picture import draw
from auv_sim.bags.flight import PARAMS, Flight, configuration, flight_of
from auv_sim.command_line import console as terminal
from auv_sim.command_line import target
from auv_sim.recording.bag import read_bag

#: Field of the summary, heading, digits.
_FIGURES = (
    ("duration", "time s", 1),
    ("rms_distance", "rms distance m", 4),
    ("largest_distance", "largest m", 3),
    ("rms_heading_error", "rms heading °", 3),
    ("rudder_travel", "rudder °", 1),
    ("rudder_travel_per_metre", "rudder °/m", 4),
    ("mean_speed", "speed m/s", 3),
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument(
        "bag", type=Path, nargs="+", metavar="BAG", help="two or more recordings or run directories"
    )
    parser.add_argument(
        "--mission", metavar="FILE", help="the mission that was flown, where a recording does not tell"
    )
    add_choice(parser)
    parser.add_argument(
        "--png", type=target, metavar="FILE", default=Path("compare.png"), help="default: compare.png"
    )
    parser.add_argument("--json", action="store_true", help="for programs")


def run(arguments: argparse.Namespace) -> int:
    """Compare with the first one."""
    if len(arguments.bag) < 2:
        raise ConfigurationError("compare", "one recording", "two or more")
    flights = []
    for path in arguments.bag:
        flight = flight_of(
            read_bag(path, odometry=arguments.odometry), arguments.mission, arguments.namespace
        )
        if flight.summary is None:
            raise ConfigurationError(
                str(path), flight.notes[0] if flight.notes else "no mission", "a flown mission"
            )
        flights.append(flight)
    labels = _labels(arguments.bag)
    summaries = [flight.summary for flight in flights if flight.summary is not None]
    settings = _settings(flights)
    try:
        draw(flights, labels, arguments.png)
    except OSError as error:
        raise ConfigurationError(
            str(arguments.png), f"{error.strerror}", "a picture that can be written"
        ) from None
    if arguments.json:
        data = {
            "runs": {label: json.loads(s.to_json()) for label, s in zip(labels, summaries, strict=True)},
            "settings": settings,
        }
        print(json.dumps(data, indent=2, allow_nan=False))
        return 0
    console = terminal()
    console.print(_table(labels, summaries))
    console.print(_subpaths(labels, summaries))
    if settings:
        console.print(_settings_table(labels, settings))
    else:
        console.print("[dim]the same parameters in all of them[/dim]")
    console.print(str(arguments.png), soft_wrap=True)
    return 0


def _labels(paths: list[Path]) -> list[str]:
    """The shortest names that tell the runs apart."""
    resolved = [path.resolve() for path in paths]
    names = [path.parent.name if path.name == "bag" else path.stem for path in resolved]
    return names if len(set(names)) == len(names) else [str(path) for path in paths]


def _table(labels: list[str], summaries: list[MissionSummary]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("run")
    for _, heading, _ in _FIGURES:
        table.add_column(heading, justify="right")
    first = summaries[0]
    for label, summary in zip(labels, summaries, strict=True):
        cells = []
        for name, _, digits in _FIGURES:
            value, base = getattr(summary, name), getattr(first, name)
            text = f"{value:.{digits}f}" if np.isfinite(value) else "-"
            if summary is not first and np.isfinite(value) and np.isfinite(base) and base != 0.0:
                change = 100.0 * (value - base) / abs(base)
                text += f"\n[dim]{change:+.1f} %[/dim]"
            cells.append(text)
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


def _settings(flights: list[Flight]) -> dict[str, list[str | None]]:
    """Parameters that are not the same in all runs: name -> value in each."""
    flat: list[dict[str, str]] = []
    for flight in flights:
        values: dict[str, str] = {}
        with configuration(flight.bag) as directory:
            if (directory / PARAMS).exists():
                for node, body in yaml_file.parse(directory / PARAMS).items():
                    for name, value in body.get("ros__parameters", {}).items():
                        values[f"{str(node).rsplit('/', 1)[-1]} {name}"] = str(value)
        flat.append(values)
    names = sorted(set().union(*flat))
    # Where files lay on the disk is no setting.
    names = [n for n in names if n.split()[-1] not in ("directory", "mission", "vehicle")]
    found = {name: [values.get(name) for values in flat] for name in names}
    return {name: values for name, values in found.items() if len(set(values)) > 1}


def _settings_table(labels: list[str], settings: dict[str, list[str | None]]) -> Table:
    table = Table(title="parameters that differ", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("parameter")
    for label in labels:
        table.add_column(escape(label), justify="right")
    for name, values in settings.items():
        table.add_row(name, *[value if value is not None else "-" for value in values])
    return table
