"""Compares this checkout with another one, in one run and in turns: what a change has gained."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.checks.benchmark import contender
from auv_sim.checks.benchmark.measures.children import BenchmarkFailed
from auv_sim.checks.benchmark.measures.rig import Setup, lockstep
from auv_sim.checks.benchmark.measures.start_up import environment, first_command
from auv_sim.checks.benchmark.scale import Scale

Tick = Callable[[str], None]
_SEA = "rough"


def interpreter_of(checkout: Path) -> str:
    """Return the interpreter of a checkout's environment, of this Python's version.

    Raises:
        ConfigurationError: there is none.
    """
    name = f"py{sys.version_info[0]}{sys.version_info[1]}"
    python = checkout.absolute() / ".venv" / name / "bin" / "python"
    if not python.exists():
        found = f"{checkout}, which has no .venv/{name}"
        raise ConfigurationError("--against", found, "a checkout in which scripts/benchmark.py has run once")
    return str(python)


class Contender:
    """A process that flies a round on request."""

    def __init__(self, python: str, *words: object) -> None:
        self.times: list[float] = []
        self._process = subprocess.Popen(  # noqa: S603 - an interpreter of the suite, our own source
            [python, "-c", Path(contender.__file__).read_text(encoding="utf-8"), *map(str, words)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=environment(),
        )

    def fly(self, counts: bool = True) -> None:
        """Fly a round and keep its time, s a vehicle-step, unless it only warms up."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write("fly\n")
        self._process.stdin.flush()
        answer = self._process.stdout.readline()
        if not answer:
            raise BenchmarkFailed("a checkout to compare with does not fly; its output stands above")
        if counts:
            self.times.append(float(answer))

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.communicate()


@contextmanager
def _contenders(theirs: str, scale: Scale) -> Iterator[dict[str, Contender]]:
    ours, threads = sys.executable, len(os.sched_getaffinity(0))
    most, flight, whole = scale.vehicles[-1], scale.flight, 5.0 * scale.flight
    commands = {
        "their closed_loop": (theirs, "closed_loop", "-", 1, whole, 1),
        "our closed_loop": (ours, "closed_loop", "-", 1, whole, 1),
        "our batch": (ours, "batch", "-", most, flight, threads),
        "their closed_loop at sea": (theirs, "closed_loop", _SEA, 1, whole, 1),
        "our batch at sea": (ours, "batch", _SEA, max(most // 1000, 2), whole, 1),
    }
    with ExitStack() as stack:
        found = {}
        for name, command in commands.items():
            found[name] = Contender(*command)
            stack.callback(found[name].close)
        for one in found.values():
            one.fly(counts=False)
        yield found


def ticks(scale: Scale) -> int:
    """Return how often `figures` calls back."""
    return 3 * scale.rounds


def figures(scale: Scale, tick: Tick, theirs: str) -> dict[str, Any]:
    """Measure both checkouts in turns.

    Args:
        scale: how thoroughly.
        tick: called before each round.
        theirs: the other checkout's interpreter.

    Returns:
        Ratios, best of the rounds: ours / theirs for times, how many times as fast for engines.
    """
    best = _best_speeds(scale, tick, theirs)
    starts = _starts(scale, tick, theirs)
    middle = {name: statistics.median(times) for name, times in starts.items()}
    step = _lockstep_times(scale, tick)
    return {
        "closed_loop": best["our closed_loop"] / best["their closed_loop"],
        "batch": best["their closed_loop"] / best["our batch"],
        "batch_at_sea": best["their closed_loop at sea"] / best["our batch at sea"],
        "first_command": middle["ours"] / middle["theirs"],
        "first_command_composed": middle["ours, composed"] / middle["theirs, composed"],
        "recorded": step["False True"] / step["False False"],
        "recorded_composed": step["True True"] / step["True False"],
        "vehicles": scale.vehicles[-1],
        "step_us": {name: 1e6 * time for name, time in best.items()},
        "start_up_s": starts,
        "lockstep_us": {name: 1e6 * time for name, time in step.items()},
    }


def _best_speeds(scale: Scale, tick: Tick, theirs: str) -> dict[str, float]:
    """Fly without ROS in turns: contender -> its best time, s a vehicle-step."""
    with _contenders(theirs, scale) as flying:
        for _ in range(scale.rounds):
            tick("against: without ROS")
            for _ in range(3):
                for one in flying.values():
                    one.fly()
        return {name: min(one.times) for name, one in flying.items()}


def _starts(scale: Scale, tick: Tick, theirs: str) -> dict[str, list[float]]:
    """Start missions in turns: side -> times to the first rudder command, s."""
    starts: dict[str, list[float]] = {}
    for _ in range(scale.rounds):
        tick("against: start-up")
        for composed in (False, True):
            for side, python in (("theirs", theirs), ("ours", sys.executable)):
                times = starts.setdefault(f"{side}{', composed' * composed}", [])
                times.append(first_command(python, composed))
    return starts


def _lockstep_times(scale: Scale, tick: Tick) -> dict[str, float]:
    """Run our lockstep in turns: "composed recorded" -> its best time, s a step."""
    found: dict[str, list[float]] = {}
    for _ in range(scale.rounds):
        tick("against: recording")
        for composed in (False, True):
            for is_recorded in (False, True):
                setup = Setup(recorded=is_recorded, composed=composed, steps=scale.steps)
                found.setdefault(f"{composed} {is_recorded}", []).append(lockstep(setup).step)
    return {name: min(times) for name, times in found.items()}
