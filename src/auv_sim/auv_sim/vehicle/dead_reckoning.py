"""The way by dead reckoning of the last 30 s, for fixes that arrive late."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import Draws, Now, Ring, slot

#: Time for which dead reckoning is kept, s: no fix is older.
TRACK_TIME = 30.0


def track_of(draws: Draws) -> Ring:
    """Lay out a ring: time (s), displacement north and east (m) since the start."""
    return draws.ring(math.ceil(TRACK_TIME / draws.step) + 3, 3)


@pure
def keep_way(track: Ring, way: complex, now: Now) -> None:
    """Keep the displacement since the start, north + i east, m."""
    at, kept = slot(track, now.k), now.memory.kept
    kept[at], kept[at + 1], kept[at + 2] = now.time, way.real, way.imag


@pure
def way_since(track: Ring, newest: complex, age: float, now: Now) -> complex:
    """Return the displacement by dead reckoning since `age` seconds ago, north + i east, m."""
    then, kept = now.time - age, now.memory.kept
    later, further = now.time, newest
    for k in range(now.k, -1, -1):
        at = slot(track, k)
        time, way = float(kept[at]), complex(kept[at + 1], kept[at + 2])
        if time <= then:
            if k == now.k:
                return newest - way
            return newest - way - (further - way) * (then - time) / (later - time)
        later, further = time, way
        if time < now.time - TRACK_TIME:
            break
    return newest - further
