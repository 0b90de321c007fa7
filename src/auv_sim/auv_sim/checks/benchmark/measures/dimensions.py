"""Measures three dimensions against the plane: a step over the graph, and both engines without ROS."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from auv_sim.checks.benchmark.measures.rig import DIVE, LockstepTiming, Setup, lockstep
from auv_sim.checks.benchmark.scale import Scale
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options

Tick = Callable[[str], None]
_MICRO = 1e6
#: What is flown: name -> the launcher's options.
_FLOWN = {"planar": Options(quiet=True), "dives": DIVE}


def dimension_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure a planar mission and one in three dimensions in turns, best of the rounds.

    Returns:
        place -> kind -> microseconds of a step, and its processor time; "engine": kind -> microseconds a step
        of a whole mission on one core, of `closed_loop` and of the compiled engine.
    """
    runs: dict[str, dict[str, list[LockstepTiming]]] = {"separate": {}, "composed": {}}
    for _ in range(scale.rounds):
        for place, found in runs.items():
            for kind in _FLOWN:
                tick(f"dimensions, {place}/{kind}")
                setup = Setup(composed=place == "composed", steps=scale.steps, dives=kind == "dives")
                found.setdefault(kind, []).append(lockstep(setup))
    figures: dict[str, Any] = {
        place: {
            kind: {
                "step_us": min(timing.step for timing in timings) * _MICRO,
                "cpu_us": min(timing.cpu for timing in timings) * _MICRO,
            }
            for kind, timings in found.items()
        }
        for place, found in runs.items()
    }
    figures["engine"] = {kind: _engines(options, scale, tick) for kind, options in _FLOWN.items()}
    return figures | {"compiled": COMPILED}


def _engines(options: Options, scale: Scale, tick: Tick) -> dict[str, float]:
    """Return the time of a step of both engines, us, in a whole mission or in `50 scale.flight` seconds."""
    tick("dimensions, without ROS")
    scenario = mission_plan.make(options, Path()).scenario()
    scenario = dataclasses.replace(scenario, time_limit=50.0 * scale.flight)
    engine.fly([scenario])  # compiles
    best = {"closed_loop": float("inf"), "batch": float("inf")}
    for _ in range(2 * scale.rounds + 1):
        begin = time.perf_counter()
        steps = closed_loop.fly(scenario).steps
        best["closed_loop"] = min(best["closed_loop"], (time.perf_counter() - begin) / steps)
        begin = time.perf_counter()
        steps = int(engine.fly([scenario]).steps.sum())
        best["batch"] = min(best["batch"], (time.perf_counter() - begin) / steps)
    return {name: seconds * _MICRO for name, seconds in best.items()}
