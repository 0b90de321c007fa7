"""One mission from its files to its picture, with its output on the terminal."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from auv_msgs_py.node.graph_look import GraphTaken
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED, make_directory, say
from auv_sim.launch import launcher, mission_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options
from auv_sim.launch.processes.process_group import Starter
from auv_sim.launch.progress_display import ProgressDisplay
from auv_sim.terminal import console as terminal

_EXIT = {
    "complete": EXIT_DONE,
    "incomplete": EXIT_FAILED,
    "aborted": EXIT_FAILED,
    "interrupted": EXIT_INTERRUPTED,
    "idle": EXIT_DONE,
    "ended": EXIT_FAILED,
}


def fly(options: Options, loader: Starter, nodes_are_launched: bool = False) -> int:
    """Fly a mission from its files to its picture; returns the exit code.

    Args:
        options: the command line.
        loader: of the nodes.
        nodes_are_launched: whether `ros2 launch` starts the nodes.

    Raises:
        SuiteError: from the launcher or the mission check.
    """
    directory = run_directory(options)
    resolved = prepare(options, directory)
    with launcher.domain_of(resolved, nodes_are_launched) as chosen:
        return _fly(resolved, directory, chosen, loader)


def _fly(resolved: Plan, directory: Path, domain: int, loader: Starter) -> int:
    """Fly a plan and conclude its run directory; return the exit code."""
    options = resolved.options
    console = terminal(options.quiet)
    make_directory(directory, new=True)
    announce(resolved, domain, console)
    try:
        with ProgressDisplay(resolved.mission.path, console, options.quiet) as progress:
            outcome = launcher.fly(resolved, directory, domain, progress, loader)
    except GraphTaken:
        shutil.rmtree(directory)  # nothing was flown: the same command must work again
        raise
    if outcome.state == "idle":
        console.print("no mission was started")
        return _EXIT[outcome.state]
    if outcome.state != "complete":
        say(f"mission {outcome.state}: {outcome.reason}", error=True)
    if outcome.other:
        names = f"{escape(outcome.other)}, not {escape(resolved.mission.name)}"
        console.print(f"no figures: the last mission flown was {names}", highlight=False, soft_wrap=True)
        return _EXIT[outcome.state]
    from auv_sim.launch import mission_results  # after the flight: it imports plotting libraries

    outcome, summary = mission_results.conclude(resolved, directory, outcome)
    if summary is not None:
        mission_results.show(resolved, directory, outcome, summary, console)
    if outcome.state == "incomplete":
        say(f"mission incomplete: {outcome.reason}", error=True)
    return _EXIT[outcome.state]


def prepare(options: Options, directory: Path) -> Plan:
    """Return the plan of a mission; `--force` does not make a planar vehicle dive.

    Raises:
        ConfigurationError: from the plan, or the mission has depths that the vehicle cannot reach.
    """
    plan = mission_plan.make(options, directory)
    if not plan.vehicle.dives:
        plan.mission.require_planar()
    return plan


def announce(resolved: Plan, domain: int, console: Console) -> None:
    """Print the mission's headline and the findings of its check."""
    path = resolved.mission.path
    timing = "lockstep" if resolved.lockstep else "free running"
    console.print(
        f"[bold]{escape(resolved.mission.name)}[/bold]: {path.n} subpaths, {path.length:.1f} m,"
        f" {escape(resolved.vehicle.name)}, {timing}, ROS domain {domain},"
        f" namespace {resolved.options.namespace}",
        highlight=False,
    )
    for level, verdicts in (("refused", resolved.verdicts.refusals), ("warning", resolved.verdicts.warnings)):
        for verdict in verdicts:
            console.print(f"[yellow]{level}[/yellow] {escape(str(verdict))}", highlight=False, soft_wrap=True)
    for notice in resolved.verdicts.notices:
        console.print(f"[cyan]notice[/cyan] {escape(notice)}", highlight=False, soft_wrap=True)


def run_directory(options: Options) -> Path:
    """Return the run directory, which does not exist yet: of the command line, else by mission and time.

    Raises:
        ConfigurationError: the command line's exists.
    """
    if options.out is not None:
        if options.out.exists():
            raise ConfigurationError("--out", f"{options.out}, which exists", "a new directory")
        return options.out.absolute()
    name = Path(options.mission).stem
    base = Path.cwd() / "runs" / f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"
    directory, number = base, 1
    while directory.exists():
        number += 1
        directory = base.with_name(f"{base.name}-{number}")
    return directory
