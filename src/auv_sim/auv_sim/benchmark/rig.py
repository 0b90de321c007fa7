"""Runs the graph, or its floor, for so many lockstep steps, and looks at its processes from outside."""

from __future__ import annotations

import dataclasses
import json
import os
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from auv_msgs_py import topics
from auv_msgs_py.errors import SuiteError
from auv_sim.benchmark.stopwatch import MARK
from auv_sim.benchmark.usage import Memory, Usage, memory, usage
from auv_sim.mission import plan
from auv_sim.mission.composed import NODES
from auv_sim.mission.plan import Options, Plan
from auv_sim.mission.processes import Children

NAMESPACE = "/auv"
_TIMED = "auv_sim.benchmark.timed_plant"
_FLOOR = "auv_sim.benchmark.floor"
#: Wall time for the nodes to find each other, and for one step, s.
_PATIENCE = 60.0


class BenchmarkFailed(SuiteError):
    """Something that was to be measured did not run."""


@dataclass(frozen=True)
class Setup:
    """What to run.

    Attributes:
        floor: empty callbacks instead of the suite's nodes.
        plain: the floor as rclpy nodes usually are.
        recorded: with a recorder.
        composed: all nodes in one process.
        steps: how many to time.
    """

    floor: bool = False
    plain: bool = False
    recorded: bool = False
    composed: bool = False
    steps: int = 2000
    options: Options = Options(quiet=True)


@dataclass(frozen=True)
class Timing:
    """One run.

    Attributes:
        steps: that were timed.
        blocks: seconds per step of each block of steps, in order.
        usage: process name -> processor time and switches per step.
        memory: process name -> memory at the end.
        start_up: seconds from the first process to the first step.
    """

    steps: int
    blocks: tuple[float, ...]
    usage: dict[str, Usage]
    memory: dict[str, Memory]
    start_up: float

    @property
    def step(self) -> float:
        """Seconds per step: the mean."""
        return sum(self.blocks) / len(self.blocks)

    @property
    def cpu(self) -> float:
        """Processor seconds per step, all processes."""
        return sum(used.cpu for used in self.usage.values())


def run(setup: Setup, interrupted: Callable[[], bool] = lambda: False) -> Timing:
    """Start everything, wait for the stopwatch, stop everything."""
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name:
        directory = Path(name)
        environment = {
            "ROS_DOMAIN_ID": str(1 + os.getpid() % 100),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        os.environ.update(environment)
        children = Children(directory / "log", environment)
        try:
            begin = time.monotonic()
            names = _start(setup, directory, children)
            from auv_sim.mission.monitor import Monitor  # only now: DDS threads must not fork

            monitor = Monitor(NAMESPACE)
            try:
                _until(lambda: not monitor.missing_nodes(names, setup.recorded), children, monitor, interrupted)
                started = time.monotonic() - begin
                before = _usage(children)
                refused = monitor.start()
                if refused:
                    raise BenchmarkFailed(f"the nodes did not start: {refused}")
                led = next(child for child in children if child.name in (topics.PLANT, "composed"))
                lines: list[str] = []

                def done() -> bool:
                    lines[:] = [text for text in led.last_lines() if text.startswith(MARK)]
                    return bool(lines)

                _until(done, children, monitor, interrupted)
                after = _usage(children)
                occupied = {child.name: memory(child.process.pid) for child in children}
            finally:
                monitor.close()
        finally:
            children.stop()
    told = json.loads(lines[-1].removeprefix(MARK))
    readings, block = told["readings"], told["block"]
    per_step = {
        name: Usage(
            (after[name].cpu - before[name].cpu) / told["steps"],
            (after[name].switches - before[name].switches) / told["steps"],
        )
        for name in after
    }
    blocks = tuple((b - a) / block for a, b in zip(readings, readings[1:]))
    return Timing(told["steps"], blocks, per_step, occupied, started)


def _usage(children: Children) -> dict[str, Usage]:
    return {child.name: usage(child.process.pid) for child in children}


def _until(condition, children, monitor, interrupted) -> None:
    deadline = time.monotonic() + _PATIENCE
    while not condition():
        dead = children.dead()
        if dead is not None:
            raise BenchmarkFailed(f"{dead.name} ended early: {' '.join(dead.last_lines(3))}")
        if interrupted():
            raise KeyboardInterrupt
        if time.monotonic() > deadline:
            raise BenchmarkFailed(f"nothing came of it within {_PATIENCE:g} s")
        monitor.look(0.05)


def _start(setup: Setup, directory: Path, children: Children) -> set[str]:
    names = [name for name in NODES if setup.recorded or name != topics.RECORDER]
    if setup.floor:
        flags = {"--recorded": setup.recorded, "--plain": setup.plain}
        words = ["--steps", str(setup.steps), *(flag for flag, given in flags.items() if given)]
        for group in [names] if setup.composed else [[name] for name in names]:
            children.start("composed" if setup.composed else group[0], _FLOOR, [*group, *words])
        return set(names)
    resolved = plan.make(setup.options, directory)
    if not setup.recorded:
        resolved = without_recorder(resolved)
    ros = ["-r", f"__ns:={NAMESPACE}", "--params-file", str(resolved.write(directory / "config"))]
    ros += ["-p", "use_sim_time:=true"]
    steps = str(setup.steps)
    if setup.composed:
        children.start("composed", _TIMED, [steps, json.dumps(dict.fromkeys(names, ros))])
        return set(names)
    for name in names:
        if name == topics.PLANT:
            children.start(name, _TIMED, [steps, "--ros-args", *ros])
        else:
            children.start(name, NODES[name].split(":")[0], ["--ros-args", *ros])
    return set(names)


def without_recorder(resolved: Plan) -> Plan:
    """The same mission, not recorded."""
    parameters = {
        name: dataclasses.replace(settings, recorded=False)
        for name, settings in resolved.parameters.items()
        if name != topics.RECORDER
    }
    return dataclasses.replace(resolved, parameters=parameters)
