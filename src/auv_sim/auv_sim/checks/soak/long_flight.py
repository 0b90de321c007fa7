"""What `scripts/soak.py` does: fly long, watch the memory of each process, count the messages."""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.settings.result_files import write_text
from auv_path_following import vehicle
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.load import load, load_messages
from auv_sim.checks.soak import memory
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, make_directory
from auv_sim.flight.metrics import summarise
from auv_sim.launch import launcher, mission_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options
from auv_sim.launch.outcome import MissionFailed, Outcome
from auv_sim.launch.processes.adopted import Loader
from auv_sim.launch.processes.domains import free_domain
from auv_sim.launch.progress_display import ProgressDisplay
from auv_sim.terminal import console as terminal
from auv_sim.terminal import headed_table, wrote

#: A lawnmower with a way back, closed, 1.26 km: followed as often as the hour takes.
SURVEY = """\
version: 1
name: soak survey
description: four legs 40 m apart and the way back, over and over
frame: ned
speed: 1.9
repeat: {repeat}
waypoints:
  points: {points}
  closed: true
  smoothing: {{kind: circular, radius: 8}}
"""
_POINTS = ((0, 0), (180, 0), (180, 40), (20, 40), (20, 80), (180, 80), (180, 120), (0, 120), (-30, 60))
#: Depths of the waypoints for a vehicle that dives, m: every leg is deeper, and the way back comes up.
_DEPTHS = (10, 10, 14, 14, 18, 18, 22, 22, 16)
#: Warm-up, as a share of the mission: after it a process has all the memory it needs.
_WARM = 0.2
#: Least share of the path that has to be flown. In the current the turns of 8 m take the vehicle farther from
#: the path than a flown cell may be, which costs two per cent.
_LEAST_SHARE = 0.95
#: Period of the memory readings, s of wall time.
_PERIOD = 1.0


class Watch(ProgressDisplay):
    """A progress bar that also keeps the memory of each process.

    Args:
        resolved: what is flown.
        console: where to draw.
    """

    def __init__(self, resolved: Plan, console: Console) -> None:
        super().__init__(resolved.mission.path, console, quiet=not console.is_terminal)
        #: (steps, {name: kB}), one row a second.
        self.rows: list[tuple[float, dict[str, int]]] = []
        self._step = resolved.parameters[topics.PLANT].step
        self._next = 0.0

    def update(self, s: float, ye: float, mission_time: float, wall_time: float) -> None:
        super().update(s, ye, mission_time, wall_time)
        if time.monotonic() >= self._next:
            self._next = time.monotonic() + _PERIOD
            self.rows.append((mission_time / self._step, memory.of_children(os.getpid())))


@dataclass(frozen=True)
class Growth:
    """One process: resident memory after the warm-up and at the end (kB), slope (kB per 1000 steps)."""

    name: str
    warm: float
    end: float
    slope: float


def growth(rows: Sequence[tuple[float, dict[str, int]]]) -> list[Growth]:
    """Fit each process's memory over the steps after the warm-up, by least squares.

    Args:
        rows: (steps, {name: kB}).
    """
    steps = np.array([row[0] for row in rows])
    late = steps >= _WARM * steps[-1]
    found = []
    for name in sorted(rows[-1][1]):
        kilobytes = np.array([row[1].get(name, math.nan) for row in rows])
        good = late & np.isfinite(kilobytes)
        slope = float(np.polyfit(steps[good] / 1e3, kilobytes[good], 1)[0])
        found.append(Growth(name, float(kilobytes[good][0]), float(kilobytes[good][-1]), slope))
    return found


def soak(arguments: argparse.Namespace) -> int:
    """Fly the soak survey, print and write memory and losses.

    Args:
        arguments: the command line's: minutes of mission time, vehicle, flat (largest growth, kB per 1000
            steps), out.

    Returns:
        The exit code: 0 if nothing grew or was lost, else 1.

    Raises:
        MissionFailed: the mission was not flown to its end.
    """
    directory = (arguments.out or Path("runs") / f"soak-{time.strftime('%Y%m%d-%H%M%S')}").absolute()
    make_directory(directory, new=True)
    resolved = _plan(directory, arguments.minutes, arguments.vehicle)
    console = terminal()
    watch = Watch(resolved, console)
    outcome = _flown(resolved, directory, watch)
    expected = topics.PER_STEP + topics.SPATIAL_PER_STEP * resolved.vehicle.dives
    steps, lost = _counted(directory / "bag", resolved.parameters[topics.PLANT].step, expected)
    grown = growth(watch.rows)
    memory.draw(watch.rows, _WARM * watch.rows[-1][0], directory / "soak.png")
    title = f"{outcome.mission_time / 60.0:.1f} minutes of mission, {steps} steps"
    steps_per_minute = 60.0 / resolved.parameters[topics.PLANT].step
    console.print(_table(title, grown, arguments.flat, steps_per_minute))
    console.print(
        f"{steps / outcome.wall_time:.0f} steps a second,"
        f" {outcome.mission_time / outcome.wall_time:.0f} times real time;"
        f" {'; '.join(lost) if lost else 'no message lost, no step missed'}",
        highlight=False,
    )
    _write(directory / "soak.json", outcome, steps, lost, grown)
    console.print()
    wrote(console, directory / "soak.png", "memory of each process")
    good = not lost and all(one.slope <= arguments.flat for one in grown)
    return EXIT_DONE if good else EXIT_FAILED


def survey(dives: bool, repeat: int) -> str:
    """Return the soak survey as a mission file; with depths for a vehicle that dives."""
    depths = [(depth,) for depth in _DEPTHS] if dives else [()] * len(_POINTS)
    points = [[*point, *depth] for point, depth in zip(_POINTS, depths, strict=True)]
    return SURVEY.format(points=points, repeat=repeat)


def _plan(directory: Path, minutes: float, name: str) -> Plan:
    """Write the survey with as many laps as last `minutes`, and plan it in a current."""
    mission, dives = directory / "soak.yaml", vehicle.load(name).dives
    write_text(mission, survey(dives, 1))
    options = Options(mission=str(mission), vehicle=name)
    once = mission_plan.make(options, directory).verdicts.duration
    write_text(mission, survey(dives, math.ceil(60.0 * minutes / once)))
    flown = dataclasses.replace(options, current=(0.1, 0.2), upwelling=-0.05 if dives else None)
    return mission_plan.make(flown, directory)


def _flown(resolved: Plan, directory: Path, watch: Watch) -> Outcome:
    """Fly; return the outcome of a complete mission."""
    with watch, Loader() as loader, free_domain() as domain:
        outcome = launcher.fly(resolved, directory, domain, watch, loader)
    if outcome.state == "interrupted":
        raise KeyboardInterrupt(f"interrupted: {outcome.reason}")
    if outcome.state != "complete":
        raise MissionFailed(f"{outcome.state}: {outcome.reason}")
    if reason := summarise(load(directory / "bag"), resolved.mission.path).shortfall(_LEAST_SHARE):
        raise MissionFailed(f"incomplete: {reason}")
    return outcome


def _table(title: str, grown: Sequence[Growth], flat: float, steps_per_minute: float) -> Table:
    numbers = ("after warm-up, MB", "at the end, MB", "slope, kB per 1000 steps", "kB per minute flown")
    table = headed_table(title, ("process",), numbers)
    for one in grown:
        colour = "green" if one.slope <= flat else "red"
        table.add_row(
            one.name, f"{one.warm / 1e3:.1f}", f"{one.end / 1e3:.1f}",
            f"[{colour}]{one.slope:+.2f}[/{colour}]", f"{one.slope * steps_per_minute / 1e3:+.2f}",
        )  # fmt: skip
    return table


def _write(file: Path, outcome: Outcome, steps: int, lost: list[str], grown: Sequence[Growth]) -> None:
    record = {
        "minutes": outcome.mission_time / 60.0,
        "steps": steps,
        "wall_time_s": outcome.wall_time,
        "lost": lost,
        "processes": [vars(one) for one in grown],
    }
    write_text(file, json.dumps(record, indent=2) + "\n")


def _counted(bag: Path, step: float, expected: tuple[Topic, ...]) -> tuple[int, list[str]]:
    """Return how many steps were recorded, and a line for each expected topic that lacks some."""
    stamps = np.array(
        [nanoseconds(message.header.stamp) for _, message in load_messages(bag, topics.ODOM.name)]
    )
    lost = []
    missed = int(np.sum(np.diff(stamps) != round(step * 1e9)))
    if missed:
        lost.append(f"{missed} steps of odom missed")
    counts = {topic.name.rsplit("/", 1)[-1]: topic.count for topic in read_bag(bag, _nothing).topics.values()}
    for topic in expected:
        if counts.get(topic.name, 0) != len(stamps):
            lost.append(f"{len(stamps) - counts.get(topic.name, 0)} of {topic.name} lost")
    return len(stamps), lost


def _nothing(_: str, __: str) -> bool:
    return False
