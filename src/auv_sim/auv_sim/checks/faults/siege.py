"""A flying graph beside a hostile participant: what has to hold, measured."""

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
from auv_path_following.missions import mission_file
from auv_sim.checks.faults.matrix import MISSION
from auv_sim.checks.faults.spoiled_graph import Nodes, SpoiledFlight
from auv_sim.checks.soak.memory import resident

#: Largest growth of a process after the warm-up, MB.
FLAT = 20.0
#: Share of the time, and at least so many seconds, after which a process has all that it needs.
_WARM, _WARM_AT_LEAST = 0.2, 10.0
#: The mission is started again so often if it has ended, s of wall time: a hostile node can stop it.
_RESTART = 5.0
_CHAIN = (topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT)
_NODES = (topics.RECORDER, *_CHAIN)


@dataclass
class Siege:
    """What was measured.

    Attributes:
        wrong: what was not as it has to be, a line each.
        named: node -> topics that it refused messages of, or named a second publisher of.
        growth: process -> growth of its resident memory after the warm-up, MB.
        largest_rudder: that the vehicle was given, rad.
        refused: messages, all nodes.
    """

    wrong: list[str] = field(default_factory=list)
    named: dict[str, set[str]] = field(default_factory=dict)
    growth: dict[str, float] = field(default_factory=dict)
    largest_rudder: float = 0.0
    refused: int = 0


class _Watch:
    """Looks at one flight while it is under attack."""

    def __init__(self, flight: SpoiledFlight, seconds: float) -> None:
        self.flight, self.found = flight, Siege()
        self._warm = time.monotonic() + max(_WARM * seconds, _WARM_AT_LEAST)
        self._base: dict[str, float] = {}
        self._next_look = self._next_start = 0.0
        assert flight.plant is not None
        self._limit = flight.plant.vehicle.rudder.max_angle

    def look(self) -> None:
        """Take in the present state."""
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
            status = self.flight.said.get(name)
            for pair in status.values if status is not None else ():
                named = self.found.named.setdefault(name, set())
                if pair.key.startswith("refused "):
                    named.add(pair.key.removeprefix("refused "))
                elif pair.key == "condition publishers":
                    named |= {part.split(" is published by ")[0] for part in pair.value.split("; ")}

    def start_again(self) -> None:
        """Start a mission that has ended, as an operator would."""
        if time.monotonic() >= self._next_start and self.flight.thrust_cmd == 0.0:
            self._next_start = time.monotonic() + _RESTART
            self.flight.call(topics.START_SERVICE)


def besiege(directory: Path, speed: float, seconds: float, tell: Callable[[float], None]) -> Siege:
    """Fly beside a hostile participant for so long.

    Args:
        directory: logs and bag.
        speed: of the simulator, times real time.
        seconds: of wall time.
        tell: called with the share that is done.

    Raises:
        GraphFailed: the graph does not come up.
    """
    directory.mkdir(parents=True, exist_ok=True)
    mission = directory / "mission.yaml"
    mission.write_text(MISSION, encoding="utf-8")
    nodes = Nodes(directory / "log", mission, {topics.RECORDER: {"directory": str(directory / "bag")}})
    for name in _NODES:
        nodes.start(name)
    flight = SpoiledFlight(nodes, speed, mission_file.load(str(mission)).path.start_pose)
    hostile = None
    try:
        flight.until(lambda: set(_NODES) <= set(flight.said), "all nodes to report")
        flight.call(topics.START_SERVICE)
        flight.until(lambda: flight.thrust_cmd > 0.0, "the mission to run")
        command = [sys.executable, "-m", "auv_sim.checks.faults.hostile", str(seconds)]
        hostile = subprocess.Popen(command, stdin=subprocess.DEVNULL)  # noqa: S603 - our own module
        watch = _Watch(flight, seconds)
        begin = time.monotonic()
        while hostile.poll() is None:
            flight.executor.spin_once(timeout_sec=0.01)
            flight.check_stop()
            watch.look()
            watch.start_again()
            tell(min((time.monotonic() - begin) / seconds, 1.0))
        _judge(watch.found, flight)
        return watch.found
    finally:
        if hostile is not None and hostile.poll() is None:
            hostile.kill()
            hostile.wait()
        flight.close()
        nodes.stop()


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
        for status in flight.said.values() for pair in status.values if pair.key.startswith("refused ")
    )  # fmt: skip
    found.wrong = list(dict.fromkeys(found.wrong))
