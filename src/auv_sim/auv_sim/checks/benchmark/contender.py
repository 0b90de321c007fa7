"""One side of a comparison of two checkouts: flies when it is asked to, and answers with the time it took.

The source of this file runs with the interpreter of either checkout (`python -c`), so it uses nothing of the
benchmark and only what every version of the suite has: `plan.scenario`, `closed_loop.fly`, `engine.fly`.

Arguments: what to fly (closed_loop or batch), sea file or -, flights, s of each, threads. Each line on
standard input asks for one round; the answer is a line with the seconds for a vehicle-step.
"""

from __future__ import annotations

import dataclasses
import math
import sys
import time

from auv_msgs_py.values.types import Current
from auv_sim.flight import closed_loop
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options


def main(what: str, sea: str, flights: int, duration: float, threads: int) -> None:
    """Answer until standard input ends."""
    options = Options() if sea == "-" else Options(sea=sea, seed=0, params="rough")
    flight = dataclasses.replace(mission_plan.scenario(options), time_limit=duration)
    angles = [2.0 * math.pi * k / flights for k in range(flights)]
    # Each in a current of its own, so that no two do the same.
    currents = [Current(0.2 * math.cos(angle), 0.2 * math.sin(angle)) for angle in angles]
    scenarios = [dataclasses.replace(flight, current=current, seed=k) for k, current in enumerate(currents)]
    if what == "batch":
        from auv_sim.flight.batch import engine

        engine.fly(scenarios[:1])  # compiles
    for _ in sys.stdin:
        begin = time.perf_counter()
        if what == "batch":
            steps = int(engine.fly(scenarios, threads).steps.sum())
        else:
            steps = sum(closed_loop.fly(scenario).steps for scenario in scenarios)
        print((time.perf_counter() - begin) / steps, flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4]), int(sys.argv[5]))
