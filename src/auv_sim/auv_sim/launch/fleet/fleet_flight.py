"""A fleet from its file to its picture, with its output on the terminal."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path

from auv_msgs_py.node.graph_look import GraphTaken
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED, make_directory, say
from auv_sim.launch import launcher, mission_flight
from auv_sim.launch.fleet import fleet_launcher, fleet_plan
from auv_sim.launch.fleet.fleet_progress import FleetProgress
from auv_sim.launch.options import Options
from auv_sim.launch.processes.process_group import Starter
from auv_sim.terminal import console as terminal


def fly(fleet: str, options: Options, loader: Starter) -> int:
    """Fly a fleet from its file to its picture.

    Args:
        fleet: its file, or the name of a shipped one.
        options: the command line; each vehicle's mission has further ones from the file.
        loader: of the nodes.

    Returns:
        0 if every mission is complete, 1 if one is not, 130 after an interruption.

    Raises:
        SuiteError: from the launcher or the mission check.
    """
    directory = mission_flight.run_directory(dataclasses.replace(options, mission=Path(fleet).stem))
    plan = fleet_plan.make(fleet, options, directory)
    domain = launcher.domain_of(next(iter(plan.members.values())))
    console = terminal(options.quiet)
    make_directory(directory, new=True)
    for member in plan.members.values():
        mission_flight.announce(member, domain, console)
    paths = {label: member.mission.path for label, member in plan.members.items()}
    try:
        with FleetProgress(paths, console, options.quiet) as progress:
            outcomes = fleet_launcher.fly(plan, domain, progress, loader)
    except GraphTaken:
        shutil.rmtree(directory)  # nothing was flown: the same command must work again
        raise
    from auv_sim.launch.fleet import fleet_results  # after the flight: it imports plotting libraries

    results = fleet_results.conclude(plan, outcomes)
    fleet_results.show(plan, results, console)
    for label, outcome in results.outcomes.items():
        if outcome.state != "complete":
            say(f"{label}: mission {outcome.state}: {outcome.reason}", error=True)
    states = {outcome.state for outcome in results.outcomes.values()}
    if "interrupted" in states:
        return EXIT_INTERRUPTED
    return EXIT_DONE if states == {"complete"} else EXIT_FAILED
