"""Measures a flying graph beside a hostile participant, and judges it."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_sim.checks.faults.graph_processes import GraphProcesses, write_mission
from auv_sim.checks.faults.spoiled_graph import SpoiledFlight
from auv_sim.checks.soak.memory import resident

#: Largest growth of a process after the warm-up, MB.
FLAT = 20.0
#: Warm-up after which a process has all the memory it needs: share of the time, and at least s.
_WARM, _WARM_AT_LEAST = 0.2, 10.0
#: A mission that has ended is started again with this period, s of wall time: a hostile node can stop it.
_RESTART = 5.0
_CHAIN = (topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT)
_NODES = (topics.RECORDER, *_CHAIN)


@dataclass
class Siege:
    """What was measured.

    Attributes:
        wrong: every deviation from what was expected, a line each.
        named: node -> topics whose messages it refused, or whose second publisher it named.
        growth: process -> growth of its resident memory after the warm-up, MB.
        largest_rudder: largest rudder command, rad.
        refused: number of refused messages, all nodes.
    """

    wrong: list[str] = field(default_factory=list)
    named: dict[str, set[str]] = field(default_factory=dict)
    growth: dict[str, float] = field(default_factory=dict)
    largest_rudder: float = 0.0
    refused: int = 0


class _Watch:
    """Measures one flight while it is under attack."""

    def __init__(self, flight: SpoiledFlight, seconds: float) -> None:
        self.flight, self.found = flight, Siege()
        self._warm = time.monotonic() + max(_WARM * seconds, _WARM_AT_LEAST)
        self._base: dict[str, float] = {}
        self._next_look = self._next_start = 0.0
        assert flight.plant is not None
        self._limit = flight.plant.vehicle.rudder.max_angle

    def look(self) -> None:
        """Take the present state into account."""
        plant, found = self.flight.plant, self.found
        assert plant is not None
        for rudder in (plant.command.rudder, plant.simulated.rudder):
            found.largest_rudder = max(found.largest_rudder, abs(rudder))
            if not abs(rudder) <= self._limit + 1e-9:
                found.wrong.append(f"a rudder of {rudder} rad")
        now = time.monotonic()
        if now < self._next_look:
            return
        self._next_look = now + 1.0
        pids = {**self.flight.nodes.ids, topics.PLANT: os.getpid()}
        for name, pid in pids.items():
            held = resident(pid) / 1e3
            if now < self._warm:
                self._base[name] = held
            elif name in self._base:
                grown = held - self._base[name]
                found.growth[name] = max(found.growth.get(name, -math.inf), grown)
        self._read_reports()

    def _read_reports(self) -> None:
        for name in (*_CHAIN, topics.PLANT):
            status = self.flight.graph.said.get(name)
            for pair in status.values if status is not None else ():
                named = self.found.named.setdefault(name, set())
                if pair.key.startswith("refused "):
                    named.add(pair.key.removeprefix("refused "))
                elif pair.key == "condition publishers":
                    named |= {part.split(" is published by ")[0] for part in pair.value.split("; ")}

    def start_again(self) -> None:
        """Start a mission that has ended, as an operator would."""
        if time.monotonic() >= self._next_start and self.flight.graph.thrust_cmd == 0.0:
            self._next_start = time.monotonic() + _RESTART
            self.flight.call(topics.START_SERVICE)


def besiege(directory: Path, speed: float, seconds: float, on_progress: Callable[[float], None]) -> Siege:
    """Fly beside a hostile participant.

    Args:
        directory: of logs and bag.
        speed: of the simulator, times real time.
        seconds: of wall time.
        on_progress: called with the share that is done.

    Raises:
        GraphFailed: the graph does not come up.
    """
    mission, start = write_mission(directory)
    bag = {topics.RECORDER: {"directory": str(directory / "bag")}}
    nodes = GraphProcesses(directory / "log", mission, bag)
    for name in _NODES:
        nodes.start(name)
    flight = SpoiledFlight(nodes, speed, start)
    try:
        flight.until(lambda: set(_NODES) <= set(flight.graph.said), "all nodes to report")
        flight.call(topics.START_SERVICE)
        flight.until(lambda: flight.graph.thrust_cmd > 0.0, "the mission to run")
        found = _watch(flight, seconds, on_progress)
        _judge(found, flight)
        return found
    finally:
        flight.close()
        nodes.stop()


def _watch(flight: SpoiledFlight, seconds: float, on_progress: Callable[[float], None]) -> Siege:
    """Start the hostile participant and watch the flight until it ends."""
    command = [sys.executable, "-m", "auv_sim.checks.faults.hostile", str(seconds)]
    hostile = subprocess.Popen(command, stdin=subprocess.DEVNULL)  # noqa: S603 - our own module
    try:
        watch = _Watch(flight, seconds)
        begin = time.monotonic()
        while hostile.poll() is None:
            flight.executor.spin_once(timeout_sec=0.01)
            flight.check_stop()
            watch.look()
            watch.start_again()
            on_progress(min((time.monotonic() - begin) / seconds, 1.0))
        return watch.found
    finally:
        if hostile.poll() is None:
            hostile.kill()
            hostile.wait()


def _judge(found: Siege, flight: SpoiledFlight) -> None:
    found.wrong += [f"{name} ended" for name in flight.nodes.crashed()]
    for name in (*_CHAIN, topics.PLANT):
        heard = {topic.name for topic in topics.CONTRACT if name in topic.subscribers}
        unnamed = sorted(heard - found.named.get(name, set()))
        if unnamed:
            found.wrong.append(f"{name} did not name {', '.join(unnamed)} in /diagnostics")
    for name, grown in found.growth.items():
        if grown > FLAT:
            found.wrong.append(f"{name} grew by {grown:.1f} MB, at most {FLAT:g} MB")
    found.refused = sum(
        int(pair.value)
        for status in flight.graph.said.values() for pair in status.values if pair.key.startswith("refused ")
    )  # fmt: skip
    found.wrong = list(dict.fromkeys(found.wrong))
