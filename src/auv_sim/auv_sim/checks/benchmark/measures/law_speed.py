"""Measures plain simulation: one vehicle, many vehicles, long paths."""

from __future__ import annotations

import dataclasses
import math
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance.path_follower import PathFollower
from auv_path_following.missions.routes.smoothing import Smoothing, smooth
from auv_sim.checks.benchmark.scale import Scale
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.flight.scenario import Scenario
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options

Tick = Callable[[str], None]
#: Most vehicles flown uncompiled: more take half an hour and show nothing new.
_UNCOMPILED = 10
#: Least number of flights that are timed together: few vehicles fly again and again.
_FLIGHTS = 100


def _scenario(duration: float) -> Scenario:
    flight = mission_plan.make(Options(quiet=True), Path()).scenario()
    return dataclasses.replace(flight, time_limit=duration)


def _best(rounds: int, measure: Callable[[], float]) -> float:
    return min(measure() for _ in range(rounds))


def closed_loop_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure the vehicle-steps per second of `closed_loop.fly`."""
    tick("closed loop")
    scenario = _scenario(5.0 * scale.flight)

    def measure() -> float:
        begin = time.perf_counter()
        steps = closed_loop.fly(scenario).steps
        return (time.perf_counter() - begin) / steps

    return {"vehicle_steps_per_second": 1.0 / _best(2 * scale.rounds + 1, measure)}


def vehicles(scale: Scale) -> tuple[int, ...]:
    """Return the numbers of vehicles that the batch engine flies."""
    return tuple(number for number in scale.vehicles if COMPILED or number <= _UNCOMPILED)


def batch_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure the vehicle-steps per second of the batch engine, all cores, by number of vehicles.

    All numbers of vehicles fly the same time. What is done once for each flight is separated by flights that
    are a tenth as long: `fixed_us` is what a flight without steps would take, `step_us` what each step adds.
    """
    threads = len(os.sched_getaffinity(0))
    engine.fly([_scenario(scale.flight)])  # compiles
    rates, fixed, marginal = {}, {}, {}
    for number in vehicles(scale):
        tick(f"batch, {number} vehicles")
        long, short = (_different(_scenario(scale.flight * share), number) for share in (1.0, 0.1))
        repeats = max(_FLIGHTS // number, 1)
        turns = [(_fly(long, threads, repeats), _fly(short, threads, repeats)) for _ in range(scale.rounds)]
        (time, steps), (short_time, short_steps) = (min(runs) for runs in zip(*turns, strict=True))
        rates[str(number)] = steps / time
        slope = (time - short_time) / (steps - short_steps)
        marginal[str(number)] = 1e6 * slope
        fixed[str(number)] = 1e6 * max(time - slope * steps, 0.0) / (number * repeats)
    return {
        "vehicle_steps_per_second": rates,
        "step_us": marginal,
        "fixed_us": fixed,
        "threads": threads,
        "compiled": COMPILED,
    }


def _fly(scenarios: list[Scenario], threads: int, repeats: int) -> tuple[float, int]:
    """Fly them `repeats` times; return s and vehicle-steps."""
    steps, begin = 0, time.perf_counter()
    for _ in range(repeats):
        steps += int(engine.fly(scenarios, threads).steps.sum())
    return time.perf_counter() - begin, steps


def _different(scenario: Scenario, number: int) -> list[Scenario]:
    """Return the scenario `number` times, each in another current, so that no two fly alike."""
    angles = [2.0 * math.pi * k / number for k in range(number)]
    currents = [Current(0.2 * math.cos(angle), 0.2 * math.sin(angle)) for angle in angles]
    return [dataclasses.replace(scenario, current=current) for current in currents]


def subpath_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure one step of guidance, us, on a spiral halfway along the path, by number of subpaths."""
    paths = []
    for number in scale.subpaths:
        tick(f"guidance, {number} subpaths")
        corners = max(number // 3, 2)  # a leg and two half spirals each
        points = [(100.0 * k, 60.0 * (k % 2)) for k in range(corners + 2)]
        paths.append(CompositePath(smooth(points, Smoothing(kind="fermat", radius=15.0))))
    rounds = [[_guidance_step(path) for path in paths] for _ in range(8 * scale.rounds)]
    best = [1e6 * min(costs) for costs in zip(*rounds, strict=True)]
    return {"step_us": {str(path.n): cost for path, cost in zip(paths, best, strict=True)}}


def _guidance_step(path: CompositePath) -> float:
    follower, steps = PathFollower(path), 500
    spiral = path.n // 6 * 3 + 1
    follower.place_at(spiral)
    p = path.evaluate(spiral, 0.0)
    navigation, water = Navigation(p.x, p.y, p.chi, 0.0), WaterVelocity(1.9, 0.0)
    begin = time.perf_counter()
    for _ in range(steps):
        follower.update(navigation, water, NO_CURRENT, 0.0)
    return (time.perf_counter() - begin) / steps
