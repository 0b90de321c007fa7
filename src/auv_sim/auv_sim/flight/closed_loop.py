"""The whole suite in one loop without ROS: the reference for the graph, and the tool for fast studies.

The nodes run the same steps in the same order with the same times, so the two trajectories agree to
rounding. The graph only adds the conversions of the wire.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from itertools import starmap

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_sim.flight.loops import loop_of
from auv_sim.flight.run_record import Run
from auv_sim.flight.scenario import Scenario


def fly(scenario: Scenario, progress: Callable[[float], None] | None = None) -> Run:
    """Fly until the end of the path or the time limit.

    Args:
        scenario: what to fly.
        progress: called with s every 20 steps.

    Returns:
        One row per step. A mission that was completed ends with the row at which it was.

    Raises:
        ConfigurationError: a law, a gain or the path needs a key that the vehicle's file lacks.
    """
    c = scenario
    dt = c.dt
    loop = loop_of(c)
    config, path, vehicle, answer = loop.pilot, loop.path, loop.vehicle, loop.answer
    state = loop.state
    at_sea, seen = c.sea is not None, vehicle.seen
    rows: list[tuple[float, ...]] = []
    for k in range(int(c.time_limit / c.step) + 1):
        state, command, s, finished, row = answer(config, path, state, seen, at_sea, k * dt, dt if k else 0.0)
        rows.append(row)
        if finished:
            break
        if progress is not None and k % 20 == 0:
            progress(s)
        seen = vehicle.advance(command, dt)
    stamps = topics.FIRST_STAMP_NS + c.step_ns * np.arange(len(rows))
    columns = dict(zip(loop.columns, _table(rows).T, strict=True))
    return Run.from_columns(columns | {"t": stamps * 1e-9})


def _table(rows: list[tuple[float, ...]]) -> NDArray[np.float64]:
    """Return rows of equal length as an array, in a third of the time that `np.array` takes."""
    pack = struct.Struct(f"{len(rows[0])}d").pack
    return np.frombuffer(b"".join(starmap(pack, rows))).reshape(len(rows), -1)
