"""The executable `mission_supervisor`: a mission, or a vehicle's nodes, under `ros2 launch`.

It does what `scripts/mission.py` does (same plan, same refusals, same run directory, same exit codes), but
`ros2 launch` starts the nodes: see `nodes_file`.
"""

from __future__ import annotations

import dataclasses
import os
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.node.graph_look import GraphTaken
from auv_msgs_py.node.run import StopRequest
from auv_sim.cli import mission
from auv_sim.command_line import EXIT_DONE, Parser, command, make_directory, say
from auv_sim.launch import launcher, mission_flight
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import checked_options, common_options
from auv_sim.launch.outcome import MissionFailed
from auv_sim.launch.processes import discovery
from auv_sim.launch.processes.process_group import Children
from auv_sim.launch.ros_launch.launch_arguments import REPORT, SHUTDOWN
from auv_sim.launch.ros_launch.nodes_file import NodesFile
from auv_sim.terminal import console


def parser() -> Parser:
    """Return the command line's parser: the options of `scripts/mission.py`, and two more."""
    p = mission.parser_of_one()
    p.prog = "mission_supervisor"
    p.description = "Supervise a mission whose nodes ros2 launch starts."
    p.add_argument("--nodes-only", action="store_true", help="start the nodes; the mission begins by `start`")
    p.add_argument("--fleet", metavar="FILE", help="several vehicles: file, or the name of a shipped one")
    p.add_argument(
        "--on-exit", choices=(REPORT, SHUTDOWN), default=REPORT,
        help="with --nodes-only, when a node has ended: report it and go on, or end all",
    )  # fmt: skip
    p.add_argument("--no-recorder", action="store_true", help="with --nodes-only: record nothing")
    return p


@command("mission", interrupted="mission interrupted")
def main(argv: Sequence[str] | None = None) -> int:
    """Supervise; returns the exit code of `scripts/mission.py`, with --nodes-only 0 after a signal."""
    given = vars(parser().parse_args(argv))
    nodes_only, no_recorder = given.pop("nodes_only"), given.pop("no_recorder")
    fleet, ends = given.pop("fleet"), given.pop("on_exit") == SHUTDOWN
    if fleet is not None:
        return _fly_fleet(fleet, given)
    if nodes_only and given["vehicle_driver"] is None:
        given["no_sim"] = True
    options = checked_options(given)
    directory = mission_flight.run_directory(options)
    options = dataclasses.replace(options, out=directory)
    nodes = NodesFile(directory)
    if not nodes_only:
        return mission_flight.fly(options, nodes, nodes_are_launched=True)
    plan = mission_flight.prepare(options, directory)
    if no_recorder:
        kept = {name: settings for name, settings in plan.parameters.items() if name != topics.RECORDER}
        plan = dataclasses.replace(plan, parameters=kept)
    with launcher.domain_of(plan, nodes_are_launched=True) as domain:
        make_directory(directory, new=True)
        mission_flight.announce(plan, domain, console())
        try:
            _stand_by(plan, directory, domain, nodes, ends)
        except GraphTaken:
            shutil.rmtree(directory)  # nothing was started: the same command must work again
            raise
    return EXIT_DONE


def _fly_fleet(fleet: str, given: dict[str, Any]) -> int:
    options = common_options(given)
    from auv_sim.launch.fleet import fleet_flight

    directory = fleet_flight.run_directory(fleet, options)
    options = dataclasses.replace(options, out=directory)
    return fleet_flight.fly(fleet, options, NodesFile(directory), nodes_are_launched=True)


def _stand_by(plan: Plan, directory: Path, domain: int, nodes: NodesFile, ends: bool) -> None:
    """Start the nodes once the graph has room for them; hold the claim and the emulator until a signal.

    Report each process that has ended.

    Args:
        plan, directory, domain, nodes: of the vehicle.
        ends: whether the end of a node ends everything.

    Raises:
        GraphTaken: another process holds what the nodes claim.
        MissionFailed: a node has ended, and `ends`.
    """
    environment = launcher.environment_of(plan, directory, domain)
    os.environ.update(environment)
    interrupt = StopRequest()
    children = Children(directory / "log", environment)
    try:
        parameters = plan.write(directory / "config")
        from auv_sim.launch.monitor import Monitor

        look_for = discovery.look_for(domain)
        monitor = Monitor(plan.options.namespace)
        try:
            look = monitor.look_around(plan.claim(), look_for)
            while not (interrupt.requested or look.ended()):
                monitor.look(0.02)
            if not interrupt.requested:
                launcher.start_nodes(plan, children, nodes, parameters)
                nodes.open_gate()
            reported: set[str] = set()
            while not interrupt.requested:
                monitor.look(0.1)
                _report_ended(children, reported, ends)
        finally:
            monitor.close()
    finally:
        children.stop()
        interrupt.withdraw()


def _report_ended(children: Children, reported: set[str], ends: bool) -> None:
    """Report the processes that have ended and are not yet in `reported`.

    Raises:
        MissionFailed: there is one, and `ends`.
    """
    for child in children:
        if child.name not in reported and child.exit_code is not None:
            reported.add(child.name)
            if ends and child.name != topics.DISPLAY:
                raise MissionFailed(child.obituary())
            say(f"{child.obituary()}\nthe other nodes go on", error=True)


if __name__ == "__main__":
    raise SystemExit(main())
