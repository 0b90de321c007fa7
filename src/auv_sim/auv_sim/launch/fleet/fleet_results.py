"""The results of a fleet: those of each vehicle, the distances between them, a picture and a table."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_sim.bags.reading.load import load
from auv_sim.command_line import to_type
from auv_sim.flight.figures.mission_summary import MissionSummary
from auv_sim.flight.run_record import Run
from auv_sim.flight.separation import Separation, separations
from auv_sim.launch import mission_results
from auv_sim.launch.fleet.fleet_plan import FleetPlan
from auv_sim.launch.outcome import Outcome
from auv_sim.terminal import go_on, number_cell, wrote
from auv_sim.views import fleet_picture

#: Heading, field of the summary, digits.
_COLUMNS = (
    ("time (s)", "duration", 1),
    ("rms distance (m)", "rms_distance", 3),
    ("largest (m)", "largest_distance", 3),
    ("rms depth (m)", "rms_depth_error", 3),
)
_FILES = (
    ("fleet.png", "all tracks, and the distances between the vehicles over time"),
    ("summary.json", "the figures of all, for programs"),
)


@dataclass(frozen=True)
class FleetResults:
    """What a fleet's flight has shown.

    Attributes:
        outcomes: vehicle -> how its mission ended.
        summaries: vehicle -> its figures; without a readable recording it is left out.
        pairs: the distance of each pair of vehicles.
    """

    outcomes: dict[str, Outcome]
    summaries: dict[str, MissionSummary]
    pairs: list[Separation]


def conclude(plan: FleetPlan, outcomes: dict[str, Outcome]) -> FleetResults:
    """Judge each mission and write its results, then those of the fleet.

    Args:
        plan: of the fleet.
        outcomes: how each mission ended on the graph.
    """
    judged, summaries, runs = {}, {}, {}
    for label, member in plan.members.items():
        folder, bag = plan.directory / label, plan.one_bag
        judged[label], summary = mission_results.conclude(member, folder, outcomes[label])
        if summary is not None:
            summaries[label] = summary
            runs[label] = load(bag or folder / "bag", member.options.namespace)
    results = FleetResults(judged, summaries, separations(runs))
    _write_summary(plan, results)
    _draw(plan, runs, results)
    return results


def _draw(plan: FleetPlan, runs: dict[str, Run], results: FleetResults) -> None:
    paths = {label: member.mission.path for label, member in plan.members.items()}
    fleet_picture.draw(runs, paths, results.pairs, plan.directory / "fleet.png", plan.fleet.name)


def _write_summary(plan: FleetPlan, results: FleetResults) -> None:
    wall = max(outcome.wall_time for outcome in results.outcomes.values())
    vehicles = {
        member.options.namespace: json.loads((plan.directory / label / "summary.json").read_text())
        for label, member in plan.members.items()
        if label in results.summaries
    }
    record: dict[str, Any] = {
        "fleet": plan.fleet.name,
        "timing": "lockstep" if plan.lockstep else "free running",
        "wall_time_s": round(wall, 3),
        "outcomes": {label: outcome.state for label, outcome in results.outcomes.items()},
        "closest": [_closest(pair) for pair in results.pairs],
        "vehicles": vehicles,
    }  # fmt: skip
    write_text(plan.directory / "summary.json", json.dumps(record, indent=2) + "\n")


def _closest(pair: Separation) -> dict[str, Any]:
    distance, at = pair.closest
    return {"vehicles": list(pair.vehicles), "distance_m": _plain(distance), "at_s": _plain(at)}


def _plain(value: float) -> float | None:
    return None if math.isnan(value) else round(value, 4)


def show(plan: FleetPlan, results: FleetResults, console: Console) -> None:
    """Print the table, the closest distances, the files and the next command."""
    table = Table(title=escape(plan.fleet.name), title_justify="left")
    for heading in ("vehicle", "mission", "hull", "outcome"):
        table.add_column(heading)
    for heading, _, _ in _COLUMNS:
        table.add_column(heading, justify="right")
    for label, member in plan.members.items():
        summary = results.summaries.get(label)
        cells = (number_cell(getattr(summary, name, math.nan), digits) for _, name, digits in _COLUMNS)
        words = (
            label,
            escape(member.mission.name),
            escape(member.vehicle.name),
            results.outcomes[label].state,
        )
        table.add_row(*words, *cells)
    console.print(table)
    for pair in results.pairs:
        distance, at = pair.closest
        if not math.isnan(distance):
            console.print(f"{' and '.join(pair.vehicles)}: closest {distance:.2f} m, at {at:.1f} s")
    console.print()
    for name, what in _FILES:
        if (plan.directory / name).exists():
            wrote(console, plan.directory / name, what)
    for label in plan.members:
        wrote(console, plan.directory / label, f"the run directory of {label}")
    go_on(console, "Look further", to_type("bag.py", "report", plan.directory))
