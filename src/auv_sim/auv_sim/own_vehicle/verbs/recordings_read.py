"""Recordings as the identification takes them, and the part that is left out of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.bags.content.recorded_manoeuvres import READ, Manoeuvring, manoeuvres_in
from auv_sim.own_vehicle.identify.results.known_vehicle import forces
from auv_sim.own_vehicle.identify.time_grid import PlanarData

#: With at least this much data (s) the last part is left out, and predicted.
ENOUGH, LAST = 150.0, 45.0


def read(
    bags: Sequence[Path], topics: Sequence[str], namespace: str | None, vehicle: Vehicle, hull: Hull
) -> list[PlanarData]:
    """Read recordings.

    Args:
        bags: the recordings.
        topics: other names of topics, NAME=TOPIC.
        namespace: which vehicle, where there are several.
        vehicle, hull: limits, unit of the thrust, drag.

    Raises:
        ConfigurationError: as `manoeuvres_in`; also an unknown name in `topics`.
    """
    names = dict(map(_renaming, topics))
    return [planar(manoeuvres_in(path, names, namespace), vehicle, hull, path.name) for path in bags]


def _renaming(text: str) -> tuple[str, str]:
    name, equals, other = text.partition("=")
    allowed = [topic.name for topic in READ]
    if name not in allowed or not equals or not other:
        raise ConfigurationError("--topic", text, f"NAME=TOPIC with NAME one of {', '.join(allowed)}")
    return name, other


def planar(recorded: Manoeuvring, vehicle: Vehicle, hull: Hull, name: str) -> PlanarData:
    """Return what the identification in the plane needs of a recording."""
    run, rudder = recorded.run, recorded.rudder
    largest = vehicle.rudder.max_angle
    known = np.isfinite(run.r)
    return PlanarData(
        name, run.t[known], run.r[known], recorded.water_t, recorded.water[:, 0], recorded.water[:, 1],
        rudder.t, np.clip(rudder.value, -largest, largest), recorded.thrust.t,
        forces(vehicle, hull, np.clip(recorded.thrust.value, 0.0, vehicle.thrust_max)), run.psi[known],
        recorded.over[known, 0], recorded.over[known, 1], np.zeros(int(known.sum())),
    )  # fmt: skip


def divided(
    recordings: list[PlanarData], left_out: list[float] | None
) -> tuple[list[PlanarData], PlanarData | None]:
    """Return recordings without the part that is left out, and that part."""
    last = recordings[-1]
    begin, end = last.t[0], last.t[-1]
    if left_out is None:
        total = sum(data.t[-1] - data.t[0] for data in recordings)
        if total < ENOUGH:
            return recordings, None
        first, until = end - LAST, end
    elif left_out[1] <= left_out[0]:
        return recordings, None
    else:
        first, until = begin + left_out[0], begin + left_out[1]
    parts = [last.between(begin - 1.0, first), last.between(until, end + 1.0)]
    kept = [part for part in parts if part.t.size and part.t[-1] - part.t[0] > 10.0]
    return [*recordings[:-1], *kept], last.between(first, until)
