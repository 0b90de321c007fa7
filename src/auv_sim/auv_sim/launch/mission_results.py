"""The results of a mission: figures, a picture, a table, and the next command."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from auv_msgs_py.contract import topics
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.bags.content.recorded_mission import SAME_STAMP
from auv_sim.bags.reading.load import load
from auv_sim.command_line import to_type
from auv_sim.flight.figures.mission_summary import (
    MissionSummary,
    SpatialMissionSummary,
    SubpathSummary,
    farthest,
)
from auv_sim.flight.metrics import summarise
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.outcome import Outcome
from auv_sim.terminal import go_on, number_cell, wrote
from auv_sim.views import dive_picture
from auv_sim.views.overview import draw
from auv_sim.views.signal_rows import limits_of

#: The outcome is judged by the recording, not by `mission_state`.
_UNFINISHED = "found a recording without the path's end, expected it where mission_state is complete"

#: At most this many subpaths and corners are printed, those farthest off the path; summary.json has all.
_MOST_ROWS, _MOST_CORNERS = 40, 10

#: Heading, field of the summary, digits.
_COLUMNS = (
    ("time (s)", "duration", 1),
    ("rms distance (m)", "rms_distance", 3),
    ("largest (m)", "largest_distance", 3),
    ("rms heading error (°)", "rms_heading_error", 2),
    ("rudder (°/m)", "rudder_travel_per_metre", 2),
)
#: The further ones of a mission in three dimensions.
_VERTICAL = (
    ("rms depth (m)", "rms_depth_error", 3),
    ("planes (°/m)", "sternplane_travel_per_metre", 2),
)

#: Files of a run directory -> what each is for.
_FILES = (
    ("overview.png", "the mission in one picture"),
    ("dive.png", "the dive in three dimensions, and its depth"),
    ("summary.json", "the figures above, for programs"),
    ("bag", "every topic, rosbag2 (MCAP): ros2 bag play, Foxglove, rosbags"),
    ("config", "mission, vehicle and parameters as flown"),
    ("log", "the log of each node"),
)


def conclude(plan: Plan, directory: Path, outcome: Outcome) -> tuple[Outcome, MissionSummary | None]:
    """Load the bag, judge the mission, write `summary.json` and the pictures.

    Args:
        plan: of the mission flown.
        directory: the run directory.
        outcome: how the mission ended on the graph.

    Returns:
        The outcome, incomplete where too little of the path was flown or its end was not reached; and the
        figures, None without a readable bag.
    """
    try:
        run = _recorded(plan, directory)
    except ConfigurationError:
        return outcome, None
    run = run.select(run.t > outcome.since - SAME_STAMP)
    if not run.steps:
        return outcome, None
    summary = summarise(run, plan.path, plan.begin)
    if outcome.state == "complete":
        reason = summary.shortfall(plan.options.least_flown) or ("" if summary.completed else _UNFINISHED)
        if reason:
            outcome = dataclasses.replace(outcome, state="incomplete", reason=reason)
    _write_summary(plan, directory, outcome, summary)
    title = f"{plan.mission.name}, {plan.vehicle.name}"
    draw(
        run,
        plan.mission.path,
        summary,
        directory / "overview.png",
        title,
        limits=limits_of(plan.vehicle),
        spatial=plan.path if isinstance(plan.path, SpatialPath) else None,
        command=plan.options.command,
    )
    if isinstance(run, SpatialRun):
        spatial = plan.path if isinstance(plan.path, SpatialPath) else None
        dive_picture.draw(run, plan.mission.path, spatial, directory / "dive.png", title)
    return outcome, summary


def _recorded(plan: Plan, directory: Path) -> Run:
    """Return the run that was recorded: in the run directory, or of a fleet perhaps in one bag for all.

    Raises:
        ConfigurationError: there is no readable bag.
    """
    recorder = plan.parameters.get(topics.RECORDER)
    if recorder is not None and recorder.vehicles:
        return load(Path(recorder.directory), plan.options.namespace)
    return load(directory / "bag")


def _write_summary(plan: Plan, directory: Path, outcome: Outcome, summary: MissionSummary) -> None:
    record: dict[str, Any] = {
        "outcome": outcome.state,
        "reason": outcome.reason,
        "wall_time_s": round(outcome.wall_time, 3),
        "times_real_time": round(outcome.mission_time / outcome.wall_time, 2) if outcome.wall_time else None,
        "timing": "lockstep" if plan.lockstep else "free running",
        "mission": plan.mission.name,
        "vehicle": plan.vehicle.name,
        **json.loads(summary.to_json()),
    }
    write_text(directory / "summary.json", json.dumps(record, indent=2) + "\n")


def show(plan: Plan, directory: Path, outcome: Outcome, summary: MissionSummary, console: Console) -> None:
    """Print the table, the figures, the files and the next command."""
    console.print(_table(f"{escape(plan.mission.name)}: {outcome.state}", summary))
    _show_figures(outcome, summary, console)
    console.print()
    for name, what in _FILES:
        if (directory / name).exists():
            wrote(console, directory / name, what)
    go_on(console, "Look further", to_type("bag.py", "report", directory))


def _table(title: str, summary: MissionSummary) -> Table:
    """Return the subpaths farthest off the path and the whole mission, a row each."""
    table = Table(title=title, title_justify="left")
    table.add_column("subpath")
    columns = _COLUMNS + (_VERTICAL if isinstance(summary, SpatialMissionSummary) else ())
    for heading, _, _ in columns:
        table.add_column(heading, justify="right")
    for part in farthest(summary.subpaths, _MOST_ROWS):
        table.add_row(f"{part.number} {part.kind}", *_cells(part, columns))
    table.add_section()
    if (others := len(summary.subpaths) - _MOST_ROWS) > 0:
        table.add_row(f"{others} others, nearer to the path")
    table.add_row("all", *_cells(summary, columns))
    return table


def _cells(
    part: SubpathSummary | MissionSummary, columns: tuple[tuple[str, str, int], ...]
) -> tuple[str, ...]:
    return tuple(number_cell(getattr(part, name), digits) for _, name, digits in columns)


def _show_figures(outcome: Outcome, summary: MissionSummary, console: Console) -> None:
    """Print the flown share, the corners, the errors of navigation and current, and the speed."""
    console.print(summary.flown_line(), soft_wrap=True)
    if isinstance(summary, SpatialMissionSummary):
        console.print(
            f"depth error: rms {number_cell(summary.rms_depth_error, 3)} m,"
            f" largest {number_cell(summary.largest_depth_error, 3)} m;"
            f" stern planes moved {number_cell(summary.sternplane_travel, 1)}°;"
            f" largest pitch {number_cell(summary.largest_pitch, 1)}°",
            soft_wrap=True,
        )
    for corner in farthest(summary.corners, _MOST_CORNERS):
        if math.isnan(corner.largest_distance):  # not reached
            continue
        console.print(
            f"corner at joint {corner.joint}: at most {number_cell(corner.largest_distance, 2)} m"
            " off the path"
        )
    if (others := len(summary.corners) - _MOST_CORNERS) > 0:
        console.print(f"{others} more corners, nearer to the path: summary.json")
    if not math.isnan(summary.navigation_error):
        away = summary.largest_distance_off_corners
        there = "" if math.isnan(away) else f" at most {away:.2f} m away from corners,"
        console.print(f"true distances;{there} odometry off by at most {summary.navigation_error:.2f} m")
    if not math.isnan(summary.current_estimate_error):
        console.print(
            f"current estimate: within {summary.current_estimate_error:.4f} m/s of the truth after 15 s"
        )
    speed = outcome.mission_time / outcome.wall_time if outcome.wall_time else 0.0
    console.print(f"flown in {outcome.wall_time:.1f} s of wall time, {speed:.0f} times real time")
