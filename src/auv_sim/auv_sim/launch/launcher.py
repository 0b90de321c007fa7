"""Flies one mission: starts the nodes, takes it through its stages, and leaves nothing running."""

from __future__ import annotations

import json
import os
from contextlib import AbstractContextManager
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import StopRequest
from auv_msgs_py.values.ros_domain import domain_of_environment
from auv_sim.launch.composed import NODES
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.operation import console_child
from auv_sim.launch.operation.mission_stages import MissionStages
from auv_sim.launch.outcome import Outcome
from auv_sim.launch.processes import discovery
from auv_sim.launch.processes.domains import domain_for
from auv_sim.launch.processes.placement import Processor
from auv_sim.launch.processes.process_group import Children, Starter
from auv_sim.launch.progress_display import ProgressDisplay
from auv_sim.launch.vehicle_driver import EMULATOR, EMULATOR_MODULE

_COMPOSED = "composed"


def domain_of(plan: Plan, nodes_are_launched: bool = False) -> AbstractContextManager[int]:
    """Return a context of a flight's ROS domain.

    The domain is that of `--domain`; else that of the environment where others share it, which are a vehicle
    or the processes of `ros2 launch`; else a free one, claimed until the context ends.

    Args:
        plan: of the flight.
        nodes_are_launched: whether `ros2 launch` starts the nodes.

    Raises:
        ConfigurationError: ROS_DOMAIN_ID is not a domain, or none is free.
    """
    asked = plan.options.domain
    if asked is None and (plan.options.no_sim or nodes_are_launched):
        asked = domain_of_environment()
    return domain_for(asked)


def fly(plan: Plan, directory: Path, domain: int, progress: ProgressDisplay, loader: Starter) -> Outcome:
    """Run a mission.

    Args:
        plan: what to fly.
        directory: logs and the bag go below it.
        domain: ROS domain.
        progress: the display on the terminal.
        loader: of the nodes; it has forked none yet.

    Raises:
        MissionFailed: a node died or never came up; nothing is left running.
    """
    environment = environment_of(plan, directory, domain)
    os.environ.update(environment)
    interrupt = StopRequest()
    children = Children(directory / "log", environment)
    separate = plan.lockstep and not plan.options.composed
    processor = Processor(None if separate and not plan.options.any_processor else ())
    try:
        start_nodes(plan, children, loader, plan.write(directory / "config"))
        look = discovery.look_for(domain)
        if plan.options.console:
            console_child.start(children, domain)
        # Imported after the forks: the nodes load meanwhile, and a process with DDS threads must not fork.
        from auv_sim.launch.monitor import Monitor

        monitor = Monitor(plan.options.namespace)
        try:
            return MissionStages(plan, children, loader, monitor, progress, interrupt, processor).run(look)
        finally:
            # The recorder stops first, while the others still hold messages that it has not yet received.
            children.stop([topics.RECORDER])
            children.stop()
            monitor.close()
    finally:
        children.stop()
        processor.release()
        interrupt.withdraw()


def environment_of(plan: Plan, directory: Path, domain: int) -> dict[str, str]:
    """Return the environment variables of all processes of a mission."""
    # ROS's own logs belong to the run, too: a service has no home directory for them.
    environment = {"ROS_DOMAIN_ID": str(domain), "ROS_LOG_DIR": str(directory / "log" / "ros")}
    environment |= discovery.variables()
    if plan.options.simulator or "ROS_AUTOMATIC_DISCOVERY_RANGE" not in os.environ:
        environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    return environment


def start_nodes(plan: Plan, children: Children, loader: Starter, parameters: Path) -> None:
    """Start the emulated vehicle, if any, and let `loader` prepare the nodes.

    Args:
        plan: of the mission.
        children: the processes are added here.
        loader: of the nodes.
        parameters: file that `Plan.write` has written.
    """
    if plan.emulator is not None:
        children.start(EMULATOR, EMULATOR_MODULE, plan.emulator)
    children.fork(loader, commands_of(plan, parameters))


def ros_arguments(plan: Plan, parameters: Path) -> list[str]:
    """Return the ROS arguments of all nodes of a mission."""
    sim_time = "true" if plan.use_sim_time else "false"
    words = ["-r", f"__ns:={plan.options.namespace}", "--params-file", str(parameters)]
    return [*words, "-p", f"use_sim_time:={sim_time}"]


def commands_of(plan: Plan, parameters: Path, recorded: bool = True) -> dict[str, tuple[str, list[str]]]:
    """Return module and arguments of each process of a mission's nodes, by name.

    Args:
        plan: of the mission.
        parameters: file that `Plan.write` has written.
        recorded: whether its recorder is among the nodes.
    """
    ros = ros_arguments(plan, parameters)
    names = [name for name in NODES if name in plan.parameters and (recorded or name != topics.RECORDER)]
    nodes = {name: (NODES[name].split(":")[0], ["--ros-args", *ros]) for name in names}
    if plan.options.composed:
        together = json.dumps(dict.fromkeys((name for name in names if name != topics.DISPLAY), ros))
        alone = {name: node for name, node in nodes.items() if name == topics.DISPLAY}
        nodes = {_COMPOSED: ("auv_sim.launch.composed", [together])} | alone
    return nodes
