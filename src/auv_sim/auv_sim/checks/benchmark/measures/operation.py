"""Measures an operator's abort: from the call of the service to thrust 0 on the wire."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import qos, topics
from auv_sim.checks.benchmark.measures.children import MeasuredProcesses, processes
from auv_sim.checks.benchmark.measures.law_speed import Tick
from auv_sim.checks.benchmark.measures.rig import NAMESPACE
from auv_sim.checks.benchmark.scale import Scale
from auv_sim.checks.patience import PATIENCE
from auv_sim.launch import mission_plan
from auv_sim.launch.composed import NODES
from auv_sim.launch.options import Options


def abort_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure the time from calling `abort` to a thrust command of 0, ms, free running at 20 Hz."""
    tick("abort")
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name, processes(Path(name)) as children:
        names = start_nodes(children, Path(name))
        took = _aborts(children, names, 6 * scale.rounds)
    return {
        "aborts": len(took),
        "p50_ms": float(np.median(took) * 1e3),
        "largest_ms": float(np.max(took) * 1e3),
    }


def start_nodes(children: MeasuredProcesses, directory: Path) -> set[str]:
    """Start the paper's mission against the wall clock; return the names of its nodes."""
    resolved = mission_plan.make(Options(speed=1.0, quiet=True), directory)
    ros = ["-r", f"__ns:={NAMESPACE}", "--params-file", str(resolved.write(directory / "config"))]
    names = [name for name in NODES if name in resolved.parameters]
    for name in names:
        words = ["--ros-args", *ros, "-p", "use_sim_time:=true"]
        children.start(name, NODES[name].split(":")[0], words)
    return set(names)


def _aborts(children: MeasuredProcesses, names: set[str], number: int) -> list[float]:
    """Start and abort a mission again and again; return the times that it took to stop, s."""
    from auv_sim.launch.monitor import Monitor  # only now: a process with DDS threads must not fork

    monitor, thrust, took = Monitor(NAMESPACE), [0.0], []

    def heard(message: Any) -> None:
        thrust[0] = message.data

    kind = qos.message_class(topics.THRUST_CMD.type)
    profile = qos.requested(topics.THRUST_CMD, reliable=True)
    monitor.node.create_subscription(kind, topics.THRUST_CMD.name, heard, profile)

    def until(condition: Callable[[], bool], pause: float) -> None:
        children.until(condition, lambda: monitor.look(pause), PATIENCE)

    try:
        until(lambda: not monitor.missing_nodes(names, topics.RECORDER in names), 0.05)
        for k in range(number):
            monitor.start()
            until(lambda: thrust[0] > 0.0, 0.002)
            begin = time.perf_counter() + 0.013 * (k % 5)  # at different times between two odometries
            until(lambda at=begin: time.perf_counter() > at, 0.001)  # type: ignore[misc]
            begin = time.perf_counter()
            monitor.abort()
            until(lambda: thrust[0] == 0.0, 0.0005)
            took.append(time.perf_counter() - begin)
    finally:
        monitor.close()
    return took
