"""Flies a fleet: starts all nodes, starts all missions, and watches them to their ends."""

from __future__ import annotations

import contextlib
import json
import os
import time
from collections.abc import Mapping
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import StopRequest
from auv_sim.launch import launcher
from auv_sim.launch.fleet.fleet_plan import FleetPlan
from auv_sim.launch.fleet.fleet_progress import FleetProgress
from auv_sim.launch.fleet.fleet_stand_by import FleetStandBy
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.operation import console_child
from auv_sim.launch.operation.mission_stages import DISCOVERY_BOUND, STALL_BOUND
from auv_sim.launch.outcome import MissionFailed, Outcome
from auv_sim.launch.processes import discovery
from auv_sim.launch.processes.placement import Processor
from auv_sim.launch.processes.process_group import Children, Starter

_RECORDER_MODULE = "auv_sim.nodes.fleet.fleet_recorder"
_CLOCK_MODULE = "auv_sim.nodes.fleet.fleet_clock_node"


def fly(plan: FleetPlan, domain: int, progress: FleetProgress, loader: Starter) -> dict[str, Outcome]:
    """Fly all missions; return the outcome of each vehicle.

    Args:
        plan: what to fly.
        domain: ROS domain.
        progress: the display on the terminal.
        loader: of the nodes; it has forked none yet.

    Raises:
        MissionFailed: a node died or never came up; nothing is left running.
    """
    environment = launcher.environment_of(next(iter(plan.members.values())), plan.directory, domain)
    os.environ.update(environment)
    interrupt = StopRequest()
    children = Children(plan.directory / "log", environment)
    try:
        children.fork(loader, commands_of(plan))
        look = discovery.look_for(domain)
        if plan.has_console:
            console_child.start(children, domain)
        # Imported after the forks: the nodes load meanwhile, and a process with DDS threads must not fork.
        from auv_sim.launch.monitor import Monitor

        monitors = {label: Monitor(member.options.namespace) for label, member in plan.members.items()}
        try:
            return _FleetFlight(plan, children, loader, monitors, progress, interrupt).run(look)
        finally:
            # The recorders stop first, while the others still hold messages that they have not yet received.
            children.stop([name for name in children.ids if name.endswith(topics.RECORDER)] or None)
            children.stop()
            *others, last = monitors.values()
            for monitor in others:
                monitor.leave()
            last.close()
    finally:
        children.stop()
        interrupt.withdraw()


def commands_of(plan: FleetPlan) -> dict[str, tuple[str, list[str]]]:
    """Write the configuration; return module and arguments of each process, by name."""
    files = plan.write()
    clock = ["--ros-args", "--params-file", str(files[topics.FLEET_CLOCK])]
    commands = {topics.FLEET_CLOCK: (_CLOCK_MODULE, clock)}
    each = plan.one_bag is None
    if not each:
        words = [launcher.ros_arguments(member, files[label]) for label, member in plan.members.items()]
        commands[topics.RECORDER] = _RECORDER_MODULE, [json.dumps(words)]
    for label, member in plan.members.items():
        for name, command in launcher.commands_of(member, files[label], recorded=each).items():
            commands[f"{label}.{name}"] = command
    return commands


def place(members: Mapping[str, Plan], ids: Mapping[str, int], held: contextlib.ExitStack) -> None:
    """Put the nodes of each vehicle in lockstep on one processor, the vehicles in turn.

    Args:
        members: vehicle -> plan of its mission.
        ids: process -> its number; a vehicle's begin with its name and a dot.
        held: releases the processors at its end.
    """
    first = next(iter(members.values()))
    if not first.lockstep or first.options.composed or first.options.any_processor:
        return
    processors = []
    for _ in members:
        processor = Processor()
        held.callback(processor.release)
        if processor.number is not None:
            processors.append(processor)
    for k, label in enumerate(members if processors else ()):
        own = {
            name.removeprefix(f"{label}."): pid for name, pid in ids.items() if name.startswith(f"{label}.")
        }
        processors[k % len(processors)].place(own)


class _FleetFlight:
    """The stages of a fleet's flight."""

    def __init__(
        self, plan: FleetPlan, children: Children, loader: Starter, monitors: Mapping[str, Any],
        progress: FleetProgress, interrupt: StopRequest,
    ) -> None:  # fmt: skip
        self._plan = plan
        self._children = children
        self._loader = loader
        self._monitors = monitors
        self._progress = progress
        self._interrupt = interrupt
        self._looks: list[Any] = []
        self._outcomes: dict[str, Outcome] = {}

    def run(self, look: float) -> dict[str, Outcome]:
        """Fly, after observing the graph for at least `look` s."""
        begin = time.monotonic()
        if not self._graph_free(look) or not self._all_listening():
            ended = Outcome("interrupted", "stopped before the missions began", time.monotonic() - begin, 0.0)
            return dict.fromkeys(self._plan.members, ended)
        with contextlib.ExitStack() as held:
            place(self._plan.members, self._children.ids, held)
            if self._plan.has_console:
                self._progress.say(console_child.addresses(self._children, self._spin), needed=True)
                everyone = self._monitors, self._progress, self._interrupt
                return FleetStandBy(self._plan, *everyone, self._spin).run()
            for label, monitor in self._monitors.items():
                if refused := monitor.start():
                    raise MissionFailed(f"{label}: the mission could not be started: {refused}")
                if not self._plan.lockstep:
                    monitor.first_stamp = None  # rows before the start are not part of the mission
            self._until_over(time.monotonic())
        return {label: self._outcomes[label] for label in self._plan.members}

    def _graph_free(self, look: float) -> bool:
        """Observe the graph for `look` s and until all nodes have loaded; False when interrupted."""
        claims = self._plan.claims()
        self._looks = [monitor.look_around(claims[label], look) for label, monitor in self._monitors.items()]
        # Each look has to end: `all` over a generator would leave out those after the first that has not.
        while not all([look.ended(self._loader.at_gate()) for look in self._looks]):  # noqa: C419
            if self._interrupt.requested:
                return False
            self._spin(0.02)
        self._loader.open_gate()
        return True

    def _all_listening(self) -> bool:
        """Wait until every node subscribes to its topics; False when interrupted."""
        deadline = time.monotonic() + DISCOVERY_BOUND
        while not self._interrupt.requested:
            for look in self._looks:
                look.check()
            missing = [
                f"{label}'s {name}"
                for label, monitor in self._monitors.items()
                for name in sorted(monitor.missing_nodes(set(self._plan.members[label].parameters), True))
            ]
            if not missing:
                return True
            self._progress.waiting_for(", ".join(missing))
            if time.monotonic() > deadline:
                raise MissionFailed(f"no sign of {', '.join(missing)} within {DISCOVERY_BOUND:g} s")
            self._spin(0.05)
        return False

    def _until_over(self, begin: float) -> None:
        """Watch until every mission is over; abort all on a signal."""
        moved_at = dict.fromkeys(self._monitors, begin)
        stamps = {label: monitor.stamp for label, monitor in self._monitors.items()}
        while len(self._outcomes) < len(self._monitors):
            self._spin(0.1)
            now = time.monotonic()
            for label, monitor in self._monitors.items():
                if label in self._outcomes:
                    continue
                if monitor.stamp != stamps[label]:
                    moved_at[label], stamps[label] = now, monitor.stamp
                elif now - moved_at[label] > STALL_BOUND:
                    raise MissionFailed(f"{label}: time stood still for {STALL_BOUND:g} s")
                if self._interrupt.requested:
                    monitor.abort()
                if state := self._ended(label, monitor):
                    reason = "stopped by a signal" if state == "interrupted" else ""
                    reason = self._why_aborted(label) if state == "aborted" else reason
                    self._outcomes[label] = Outcome(state, reason, now - begin, monitor.mission_time)
                self._progress.update(label, monitor.s, monitor.mission_time, now - begin, state)
        self._spin(0.3)  # the zero commands of an abort must reach the vehicles

    def _ended(self, label: str, monitor: Any) -> str:
        """Return how a vehicle's mission has ended; empty while it is under way."""
        if self._interrupt.requested:
            return "interrupted"
        if monitor.completed(self._plan.members[label].mission.path.n):
            return "complete"
        return "aborted" if monitor.state == "aborted" else ""

    def _why_aborted(self, label: str) -> str:
        for child in self._children:
            for line in reversed(child.last_lines(20)) if child.name.startswith(f"{label}.") else ():
                if "aborted: " in line:
                    return str(line.split("aborted: ", 1)[1])
        return "the mission was aborted"

    def _spin(self, seconds: float) -> None:
        dead = self._children.dead()
        if dead is not None and not self._interrupt.requested:  # a signal may have reached the nodes, too
            raise MissionFailed(dead.obituary())
        for monitor in self._monitors.values():
            monitor.look(0.0)
        time.sleep(seconds)
