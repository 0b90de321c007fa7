"""A fleet from its file to its picture, with its output on the terminal."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path

from auv_msgs_py.node.graph_look import GraphTaken
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED, make_directory, say
from auv_sim.launch import launcher, mission_flight
from auv_sim.launch.fleet import fleet_launcher, fleet_plan
from auv_sim.launch.fleet.fleet_plan import FleetPlan
from auv_sim.launch.fleet.fleet_progress import FleetProgress
from auv_sim.launch.options import Options
from auv_sim.launch.outcome import Outcome
from auv_sim.launch.processes.process_group import Starter
from auv_sim.terminal import console as terminal


def run_directory(fleet: str, options: Options) -> Path:
    """Return the run directory, which does not exist yet: of the command line, else by the fleet's name."""
    return mission_flight.run_directory(dataclasses.replace(options, mission=Path(fleet).stem))


def fly(fleet: str, options: Options, loader: Starter, nodes_are_launched: bool = False) -> int:
    """Fly a fleet from its file to its picture.

    Args:
        fleet: its file, or the name of a shipped one.
        options: the command line; each vehicle's mission has further ones from the file.
        loader: of the nodes.
        nodes_are_launched: whether `ros2 launch` starts the nodes.

    Returns:
        0 if every mission is complete, 1 if one is not, 130 after an interruption.

    Raises:
        SuiteError: from the launcher or the mission check.
    """
    directory = run_directory(fleet, options)
    plan = fleet_plan.make(fleet, options, directory)
    any_member = next(iter(plan.members.values()))  # all of a fleet are in one domain
    with launcher.domain_of(any_member, nodes_are_launched) as chosen:
        return _fly(plan, directory, chosen, options.quiet, loader)


def _fly(plan: FleetPlan, directory: Path, domain: int, is_quiet: bool, loader: Starter) -> int:
    """Fly a plan and conclude each mission's run directory; return the exit code."""
    console = terminal(is_quiet)
    make_directory(directory, new=True)
    for member in plan.members.values():
        mission_flight.announce(member, domain, console)
    paths = {label: member.mission.path for label, member in plan.members.items()}
    try:
        with FleetProgress(paths, console, is_quiet) as progress:
            outcomes = fleet_launcher.fly(plan, domain, progress, loader)
    except GraphTaken:
        shutil.rmtree(directory)  # nothing was flown: the same command must work again
        raise
    plan, outcomes = _flown(plan, outcomes)
    if not outcomes:
        console.print("no planned mission was flown")
        return EXIT_DONE
    from auv_sim.launch.fleet import fleet_results  # after the flight: it imports plotting libraries

    results = fleet_results.conclude(plan, outcomes)
    fleet_results.show(plan, results, console)
    return _reported(results.outcomes)


def _reported(outcomes: dict[str, Outcome]) -> int:
    """Print the missions that are not complete; return the exit code."""
    for label, outcome in outcomes.items():
        if outcome.state != "complete":
            say(f"{label}: mission {outcome.state}: {outcome.reason}", error=True)
    states = {outcome.state for outcome in outcomes.values()}
    if "interrupted" in states:
        return EXIT_INTERRUPTED
    return EXIT_DONE if states == {"complete"} else EXIT_FAILED


def _flown(plan: FleetPlan, outcomes: dict[str, Outcome]) -> tuple[FleetPlan, dict[str, Outcome]]:
    """Return the vehicles that flew their planned missions last: the others have no figures."""
    flown = {
        label: outcome for label, outcome in outcomes.items() if outcome.state != "idle" and not outcome.other
    }
    return dataclasses.replace(plan, members={label: plan.members[label] for label in flown}), flown
