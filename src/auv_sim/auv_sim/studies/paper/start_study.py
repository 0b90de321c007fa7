"""Convergence from random starts in random currents, the same for every law and plant."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, fields
from pathlib import Path

import numpy as np

from auv_msgs_py.settings.result_files import replacing
from auv_path_following.missions import mission_file
from auv_sim.flight.batch import engine
from auv_sim.studies.paper.paper_flights import MISSION, PaperFlight
from auv_sim.studies.paper.variants import PLANTS, START_LAWS

#: Starts lie within this distance of the path's start, m; currents are up to this strong, m/s.
LARGEST_OFFSET = 30.0
STRONGEST_CURRENT = 0.4
#: First subpath (counted from 0) that counts for the rms: the first after the corner's legs.
FIRST_SUBPATH = 2


@dataclass(frozen=True)
class StartResult:
    """One start. Distances in m, the rate in rad/s; NaN where the flight never got there.

    `distance_after_settling` counts from where the path is joined, see `auv_sim.flight.batch.tally.ARRIVED`.
    """

    law: str
    plant: str
    seed: int
    run: int
    finished: bool
    distance_after_settling: float
    rms_after_corner: float
    largest_rudder_rate: float


@dataclass(frozen=True)
class StartRow:
    """All starts of one law on one plant: shares, and the worst figures."""

    law: str
    plant: str
    runs: int
    finished: float
    distance_median: float
    distance_worst: float
    rms_median: float
    rms_worst: float
    largest_rudder_rate: float


@dataclass(frozen=True)
class StartJob:
    law: str
    plant: str
    seed: int
    run: int
    flight: PaperFlight


def starts(runs: int, seed: int) -> list[tuple[tuple[float, float, float], tuple[float, float]]]:
    """Return starts (x, y in m, heading in rad) and currents (north, east in m/s), uniform over discs.

    A start depends only on the seed and its own number, so the first hundred of a thousand are a hundred.
    """
    x0, y0, _ = mission_file.load(MISSION).path.start_pose
    found = []
    for run in range(runs):
        offset, bearing, heading, strength, direction = np.random.default_rng([seed, run]).random(5).tolist()
        away, flow = LARGEST_OFFSET * math.sqrt(offset), STRONGEST_CURRENT * math.sqrt(strength)
        b, d = 2.0 * math.pi * bearing, 2.0 * math.pi * direction
        start = (x0 + away * math.cos(b), y0 + away * math.sin(b), 2.0 * math.pi * heading)
        found.append((start, (flow * math.cos(d), flow * math.sin(d))))
    return found


def jobs(runs: int, seed: int, laws: Sequence[str], plants: Sequence[str]) -> list[StartJob]:
    """Return every flight of the study, run by run, so that a part of it is a smaller study."""
    return [
        StartJob(
            law,
            plant,
            seed,
            run,
            PaperFlight(name=f"{law}-{plant}-{run}", plant=plant, start=s, current=c, **START_LAWS[law]),
        )
        for run, (s, c) in enumerate(starts(runs, seed))
        for law in laws
        for plant in plants
    ]


def study(
    work: Sequence[StartJob], workers: int, done: Callable[[], None] = lambda: None
) -> list[StartResult]:
    """Fly all jobs with the batch engine; return the results in their order.

    Args:
        work: what to fly.
        workers: threads.
        done: called after each flight, from any thread.
    """
    flights = engine.fly([job.flight.scenario() for job in work], workers, lambda _: done())
    # Of equal steps, so the rms over several subpaths weighs each with its time.
    time = np.nan_to_num(flights.subpath_duration[:, FIRST_SUBPATH:])
    squares = np.nan_to_num(flights.subpath_rms_distance[:, FIRST_SUBPATH:]) ** 2
    with np.errstate(invalid="ignore"):
        rms = np.sqrt((squares * time).sum(axis=1) / time.sum(axis=1))
    return [
        StartResult(
            job.law,
            job.plant,
            job.seed,
            job.run,
            bool(flights.completed[k]),
            float(flights.late_largest_distance[k]),
            float(rms[k]),
            math.radians(flights.largest_rudder_rate[k]),
        )
        for k, job in enumerate(work)
    ]


def table(results: Sequence[StartResult]) -> list[StartRow]:
    """Return a row for each law and plant, in order of appearance."""
    rows = []
    for law, plant in dict.fromkeys((r.law, r.plant) for r in results):
        mine = [r for r in results if (r.law, r.plant) == (law, plant)]
        distance = np.array([r.distance_after_settling for r in mine])
        # A flight that never passed the corner has no rms: it counts as infinite.
        rms = np.array([r.rms_after_corner if r.finished else math.inf for r in mine])
        rows.append(
            StartRow(
                law,
                PLANTS[plant].label,
                len(mine),
                float(np.mean([r.finished for r in mine])),
                float(np.median(distance)),
                float(np.max(distance)),
                float(np.median(rms)),
                float(np.max(rms)),
                max(r.largest_rudder_rate for r in mine),
            )
        )
    return rows


def write(results: Sequence[StartResult], file: Path) -> None:
    """Write every start as a line of CSV."""
    with replacing(file) as draft, draft.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(field.name for field in fields(StartResult))
        writer.writerows(astuple(result) for result in results)
