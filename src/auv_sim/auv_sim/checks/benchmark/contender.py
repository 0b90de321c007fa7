"""One side of a comparison of two checkouts: flies on request and answers with the time it took.

The source of this file runs with the interpreter of either checkout (`python -c`), so it uses nothing of the
benchmark, and of the suite only what every version has: `scenario(options)`, `closed_loop.fly`, `engine.fly`.

Arguments: what to fly (closed_loop or batch), sea file or -, flights, s of each, threads. Each line on
standard input asks for one round; the answer is a line with the seconds for a vehicle-step.
"""

from __future__ import annotations

import dataclasses
import importlib
import math
import sys
import time
from typing import Any


def first_of(*names: str) -> Any:
    """Return the first of these modules that the checkout has: by today's name, then by its former one.

    Raises:
        ModuleNotFoundError: it has none.
    """
    for name in names[:-1]:
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError as error:
            if not f"{name}.".startswith(f"{error.name}."):
                raise  # the module is there, and something that it imports is not
    return importlib.import_module(names[-1])


Current = first_of("auv_msgs_py.values.types", "auv_msgs_py.types").Current
Options = first_of("auv_sim.launch.options", "auv_sim.mission.options").Options
closed_loop = first_of("auv_sim.flight.closed_loop", "auv_sim.closed_loop")
mission_plan = first_of("auv_sim.launch.mission_plan", "auv_sim.mission.plan")


def main(what: str, sea: str, flights: int, duration: float, threads: int) -> None:
    """Answer until standard input ends."""
    options = Options() if sea == "-" else Options(sea=sea, seed=0, params="rough")
    flight = dataclasses.replace(mission_plan.scenario(options), time_limit=duration)
    angles = [2.0 * math.pi * k / flights for k in range(flights)]
    # Each in a current of its own, so that no two do the same.
    currents = [Current(0.2 * math.cos(angle), 0.2 * math.sin(angle)) for angle in angles]
    scenarios = [dataclasses.replace(flight, current=current, seed=k) for k, current in enumerate(currents)]
    if what == "batch":
        engine = first_of("auv_sim.flight.batch.engine", "auv_sim.batch.engine")
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
