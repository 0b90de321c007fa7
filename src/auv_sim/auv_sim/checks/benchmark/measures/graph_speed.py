"""Measures the graph: lockstep against its floor, latency against the wall clock, start-up, memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from auv_sim.checks.benchmark.measures.children import BenchmarkFailed
from auv_sim.checks.benchmark.measures.rig import LockstepTiming, Setup, free_running, lockstep
from auv_sim.checks.benchmark.measures.start_up import first_command
from auv_sim.checks.benchmark.scale import Scale

Tick = Callable[[str], None]
_MICRO = 1e6


def _setups(steps: int) -> Iterator[tuple[str, Setup]]:
    for composed in (False, True):
        place = "composed" if composed else "separate"
        yield f"{place}/plain floor", Setup(floor=True, plain=True, composed=composed, steps=steps)
        for recorded in (False, True):
            suffix = ", recorded" if recorded else ""
            yield (
                f"{place}/floor{suffix}",
                Setup(floor=True, recorded=recorded, composed=composed, steps=steps),
            )
            yield f"{place}/suite{suffix}", Setup(recorded=recorded, composed=composed, steps=steps)
            if recorded and not composed:
                scattered = Setup(recorded=True, placed=False, steps=steps)
                yield f"{place}/suite{suffix}, on any processor", scattered


def lockstep_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure the time per step of suite and floor, in turns, best of the rounds; and memory per process.

    Other load only adds time: of several runs the fastest describes the program best.
    """
    runs: dict[str, list[LockstepTiming]] = {}
    for _ in range(scale.rounds):
        for name, setup in _setups(scale.steps):
            tick(f"lockstep, {name}")
            runs.setdefault(name, []).append(lockstep(setup))
    figures: dict[str, Any] = {}
    for name, timings in runs.items():
        place, kind = name.split("/")
        best = min(timings, key=lambda timing: timing.step)
        figures.setdefault(place, {})[kind] = {
            "step_us": best.step * _MICRO,
            "best_block_us": min(min(timing.blocks) for timing in timings) * _MICRO,
            "cpu_us": min(timing.cpu for timing in timings) * _MICRO,
            "cpu_by_process_us": {name: used.cpu * _MICRO for name, used in best.usage.items()},
            "switches": sum(used.switches for used in best.usage.values()),
        }
    memory = min(runs["separate/suite, recorded"], key=lambda timing: timing.step).memory
    figures["memory"] = {name: used._asdict() for name, used in memory.items()}
    return figures


def latency_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure odom -> rudder_cmd against the wall clock: latency, jitter, missed cycles, processor time."""
    figures: dict[str, Any] = {}
    for rate in (20, 50, 100):
        tick(f"latency at {rate} Hz")
        seen = free_running(rate, scale.seconds)
        latencies = np.array(seen.report["latencies"]) * 1e3
        if not len(latencies):
            raise BenchmarkFailed(f"no command came at {rate} Hz")
        periods = np.diff(seen.report["sent"]) * 1e3
        p50, p99, p999 = np.percentile(latencies, (50.0, 99.0, 99.9))
        figures[str(rate)] = {
            "cycles": len(seen.report["sent"]),
            "p50_ms": float(p50),
            "p99_ms": float(p99),
            "p99.9_ms": float(p999),
            "largest_ms": float(latencies.max()),
            "jitter_ms": float(latencies.std()),
            "period_jitter_ms": float(periods.std()),
            "missed": seen.report["missed"],
            "cpu_percent": {name: 100.0 * used.cpu / seen.seconds for name, used in seen.usage.items()},
        }
    return figures


def start_up_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure the time from calling the launcher to the first rudder command, s, best of the rounds."""
    times = []
    for _ in range(scale.rounds):
        tick("start-up")
        times.append(first_command())
    return {"seconds": min(times)}
