"""Runs the graph, or its floor, as separate processes and observes them from outside."""

from __future__ import annotations

import dataclasses
import itertools
import json
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_sim.checks.benchmark.measures.children import BenchmarkFailed, MeasuredProcesses, processes
from auv_sim.checks.benchmark.measures.stopwatch import BLOCK, MARK
from auv_sim.checks.benchmark.usage import MemoryUse, Usage, memory
from auv_sim.checks.patience import PATIENCE
from auv_sim.launch import mission_plan
from auv_sim.launch.composed import NODES
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options
from auv_sim.launch.processes.placement import Processor

NAMESPACE = "/auv"
#: What is flown in three dimensions.
DIVE = Options(quiet=True, mission="paper_ramps", vehicle="remus100_6dof")
COMPOSED = "composed"
#: Without what a mission is flown without: a vehicle's driver, and the display.
_GRAPH = tuple(name for name in NODES if name not in (topics.MAVLINK_DRIVER, topics.DISPLAY))
_TIMED = "auv_sim.checks.benchmark.measures.timed_plant"
_FLOOR = "auv_sim.checks.benchmark.measures.floor"


@dataclass(frozen=True)
class Setup:
    """One lockstep run.

    Attributes:
        floor: empty callbacks instead of the suite's nodes.
        plain: the floor as rclpy nodes usually are.
        recorded: with a recorder.
        composed: all nodes in one process.
        placed: processes where the launcher puts them (`launch.processes.placement`).
        steps: how many to time.
        dives: the mission with ramps of a vehicle that dives, instead of the paper's mission.
    """

    floor: bool = False
    plain: bool = False
    recorded: bool = False
    composed: bool = False
    placed: bool = True
    steps: int = 2000
    dives: bool = False


@dataclass(frozen=True)
class Observed:
    """What was observed of some processes between the mission's start and the watch's report.

    Attributes:
        report: the watch's figures.
        seconds: of wall time.
        usage: process name -> what it used.
        memory: process name -> what it occupied at the end.
    """

    report: dict[str, Any]
    seconds: float
    usage: dict[str, Usage]
    memory: dict[str, MemoryUse]


@dataclass(frozen=True)
class LockstepTiming:
    """One lockstep run: seconds per step of each block of steps, and each process' share of a step."""

    blocks: tuple[float, ...]
    usage: dict[str, Usage]
    memory: dict[str, MemoryUse]

    @property
    def step(self) -> float:
        """Wall seconds per step."""
        return sum(self.blocks) / len(self.blocks)

    @property
    def cpu(self) -> float:
        """Processor seconds per step, all processes."""
        return sum(used.cpu for used in self.usage.values())


def lockstep(setup: Setup) -> LockstepTiming:
    """Run the graph or its floor for `setup.steps` steps.

    Raises:
        BenchmarkFailed: it did not run.
    """

    def start(directory: Path, children: MeasuredProcesses) -> set[str]:
        names = [name for name in _GRAPH if setup.recorded or name != topics.RECORDER]
        if setup.floor:
            flags = {"--recorded": setup.recorded, "--plain": setup.plain}
            words = ["--steps", str(setup.steps), *(flag for flag, given in flags.items() if given)]
            for group in [names] if setup.composed else [[name] for name in names]:
                children.start(COMPOSED if setup.composed else group[0], _FLOOR, [*group, *words])
            return set(names)
        resolved = mission_plan.make(DIVE if setup.dives else Options(quiet=True), directory)
        resolved = resolved if setup.recorded else without_recorder(resolved)
        _start_suite(resolved, directory, children, "lockstep", setup.steps, setup.composed)
        return set(names)

    seen = observe(start, 1.0, setup.placed and not setup.composed)
    steps = seen.report["steps"]
    share = {name: Usage(used.cpu / steps, used.switches / steps) for name, used in seen.usage.items()}
    blocks = tuple((b - a) / BLOCK for a, b in itertools.pairwise(seen.report["readings"]))
    return LockstepTiming(blocks, share, seen.memory)


def free_running(rate: float, seconds: float) -> Observed:
    """Fly against the wall clock.

    Args:
        rate: odometries a second.
        seconds: how long.

    Raises:
        BenchmarkFailed: it did not run.
    """

    def start(directory: Path, children: MeasuredProcesses) -> set[str]:
        resolved = mission_plan.make(Options(speed=1.0, quiet=True), directory)
        plant = dataclasses.replace(resolved.parameters[topics.PLANT], step=1.0 / rate)
        resolved = dataclasses.replace(resolved, parameters={**resolved.parameters, topics.PLANT: plant})
        _start_suite(resolved, directory, children, "latency", round(rate * seconds), False)
        return set(_GRAPH)

    return observe(start, seconds)


def without_recorder(resolved: Plan) -> Plan:
    """Return the same mission without a recorder."""
    parameters = {
        name: dataclasses.replace(settings, recorded=False)
        for name, settings in resolved.parameters.items()
        if name != topics.RECORDER
    }
    return dataclasses.replace(resolved, parameters=parameters)


def _start_suite(
    resolved: Plan, directory: Path, children: MeasuredProcesses, kind: str, steps: int, composed: bool
) -> None:
    ros = ["-r", f"__ns:={NAMESPACE}", "--params-file", str(resolved.write(directory / "config"))]
    ros += ["-p", "use_sim_time:=true"]
    names = [name for name in NODES if name in resolved.parameters]
    if composed:
        children.start(COMPOSED, _TIMED, [kind, str(steps), json.dumps(dict.fromkeys(names, ros))])
        return
    for name in names:
        if name == topics.PLANT:
            children.start(name, _TIMED, [kind, str(steps), "--ros-args", *ros])
        else:
            children.start(name, NODES[name].split(":")[0], ["--ros-args", *ros])


def observe(
    start: Callable[[Path, MeasuredProcesses], set[str]], seconds: float, placed: bool = False
) -> Observed:
    """Start processes, start their mission, wait for the watch, stop everything.

    Args:
        start: starts the processes and returns the names of the nodes in them.
        seconds: how long the measurement should take, roughly.
        placed: put the processes where the launcher puts those of a lockstep mission.
    """
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name, processes(Path(name)) as children:
        names = start(Path(name), children)
        from auv_sim.launch.monitor import Monitor  # only now: a process with DDS threads must not fork

        monitor = Monitor(NAMESPACE)
        processor = Processor(None if placed else ())

        def until(condition: Callable[[], bool]) -> None:
            children.until(condition, lambda: monitor.look(0.05), PATIENCE + 2.0 * seconds)

        try:
            until(lambda: not monitor.missing_nodes(names, topics.RECORDER in names))
            processor.place(children.ids)
            before, begin = children.usage(), time.perf_counter()
            refused = monitor.start()
            if refused:
                raise BenchmarkFailed(f"the nodes did not start: {refused}")
            led = next(child for child in children if child.name in (topics.PLANT, COMPOSED))
            until(lambda: MARK in led.log.read_text(encoding="utf-8"))
            took, after = time.perf_counter() - begin, children.usage()
            occupied = {name: memory(pid) for name, pid in children.ids.items()}
        finally:
            monitor.close()
            processor.release()
        line = next(line for line in reversed(led.last_lines(20)) if line.startswith(MARK))
    used = {
        name: Usage(after[name].cpu - before[name].cpu, after[name].switches - before[name].switches)
        for name in after
    }
    return Observed(json.loads(line.removeprefix(MARK)), took, used, occupied)
