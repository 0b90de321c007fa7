"""Innovations of all recordings for given unknowns, compiled where Numba is installed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np

from auv_sim.flight.batch.compiled import COMPILED, compiled, take_over_pure
from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData
from auv_sim.own_vehicle.identify.filter.exact_servo import fin_angles
from auv_sim.own_vehicle.identify.motion_planes import HORIZONTAL, VERTICAL, Plane
from auv_sim.own_vehicle.identify.time_grid import SAME, Passage, PlanarData
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, HALF_PLAY, LATENCY, RATE, TRIM, DataSheet

take_over_pure()
_fin_angles = compiled(fin_angles)

#: Recordings of one kind.
Recording = PlanarData | DiveData


class Channels(NamedTuple):
    """All recordings on their grids.

    Attributes:
        plane: of the recordings.
        passages: one for each.
        noise: of the filter: see `planar_innovations`.
        dead_band: of the fin, rad.
        latency: with which the grids were made, s.
        rows: 0 for rows of the rate, 1 and 2 for the others, one recording after the other.
        blocks: number of the block of 10 s of each row.
    """

    plane: Plane
    passages: tuple[Passage, ...]
    noise: tuple[float, ...]
    dead_band: float
    latency: float
    rows: Any
    blocks: Any

    def with_noise(self, place: int, value: float) -> Channels:
        """Return the channels with another number in `noise`."""
        return self._replace(noise=(*self.noise[:place], float(value), *self.noise[place + 1 :]))

    def with_trims(self, more: Sequence[float]) -> Channels:
        """Return the channels with an angle (rad) added to the trim of each passage."""
        passages = zip(self.passages, more, strict=True)
        return self._replace(passages=tuple(p._replace(trim=p.trim + float(m)) for p, m in passages))

    @property
    def loads_off(self) -> Numbers:
        """`VerticalLoads.off` of all passages; empty where heave, roll and pitch are not known."""
        return next((p.loads.off for p in self.passages if p.loads is not None), np.zeros(0))

    def with_loads_off(self, off: Numbers) -> Channels:
        """Return the channels with other `VerticalLoads.off`; an empty one changes nothing."""
        if off.size == 0:
            return self
        found = (p if p.loads is None else p.with_loads(p.loads._replace(off=off)) for p in self.passages)
        return self._replace(passages=tuple(found))


#: Places in `Channels.noise`: growth of the first state's variance, variance of the error of fin or pitch.
FIRST_GROWTH, ERROR_VARIANCE = 3, 8
_NO_STATES = np.zeros((0, 4))
#: Length of a block of correlated innovations, s.
_BLOCK = 10.0


def channels_of(
    recordings: Sequence[Recording], sheet: DataSheet, dead_band: float, latency: float | None = None
) -> Channels:
    """Return recordings ready for the filter.

    Args:
        recordings: of one vehicle and one kind.
        sheet: errors of its instruments.
        dead_band: of the fin, rad.
        latency: of the log, s; the sheet's if None.
    """
    latency = sheet.latency if latency is None else latency
    plane = VERTICAL if isinstance(recordings[0], DiveData) else HORIZONTAL
    passages = tuple(plane.passage_of(data, latency) for data in recordings)
    rows, blocks, first = [], [], 0
    for passage in passages:
        rows.append(np.repeat([0, 1, 2], passage.counts))
        block = ((passage.rows - passage.rows.min()) // _BLOCK).astype(int) + first
        first = int(block.max()) + 1
        blocks.append(block)
    signals = zip(plane.measured, plane.least, strict=True)
    measured = [max(least, _white(recordings, name)) ** 2 for name, least in signals]
    drift, time = plane.slow_error(sheet, recordings, _white(recordings, "u"))
    noise = (
        *map(float, measured),
        *plane.growth,
        drift**2,
        1.0 / time,
        plane.error**2,
        1.0 / plane.error_time,
    )
    return Channels(plane, passages, noise, dead_band, latency, np.concatenate(rows), np.concatenate(blocks))


def _white(recordings: Sequence[Recording], name: str) -> float:
    """Return the standard deviation of a signal's white noise, from its second differences."""
    second = np.concatenate([np.diff(getattr(data, name), 2) for data in recordings])
    return 1.4826 * float(np.median(np.abs(second))) / math.sqrt(6.0) if second.size else 0.0


def innovations(channels: Channels, physical: Numbers) -> Numbers:
    """Return the innovations of all recordings, shape (m,); 1e6 where the filter diverges.

    Args:
        channels: the recordings.
        physical: of `Scaling.physical`.
    """
    parts = [_of_passage(passage, channels, physical) for passage in channels.passages]
    return np.clip(np.nan_to_num(np.concatenate(parts), nan=1e6), -1e6, 1e6)


def innovations_of(tries: Sequence[tuple[Channels, Numbers]]) -> list[Numbers]:
    """Return the innovations of recordings for different filters and unknowns, one after the other."""
    if not COMPILED:
        return [innovations(*one) for one in tries]
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda one: innovations(*one), tries))


def filtered(passage: Passage, channels: Channels, physical: Numbers) -> Numbers:
    """Return the filter's states at each node of a passage, measurements used, shape (n, 4).

    They are u, v, r and the thrust's error in the plane; theta, w, q and the surge's error of a dive.
    """
    states = np.full((passage.times.size - 1, 4), np.nan)
    means, changes = rudder_of(passage, channels.dead_band, physical)
    out = np.zeros(passage.rows.size)
    c = arguments_of(channels, physical)
    channels.plane.compiled(c, channels.noise, passage.grid, means, changes, out, states)
    return states


def flown(
    passage: Passage, channels: Channels, physical: Numbers, first: int, length: int, state: Numbers
) -> Numbers:
    """Return the three states after each of `length` steps from node `first`, by the commands alone."""
    means, changes = rudder_of(passage, channels.dead_band, physical)
    out = np.zeros((length, 3))
    c = arguments_of(channels, physical)
    channels.plane.flight(c, passage.grid, means, changes, first, length, tuple(map(float, state)), out)
    return out


def _of_passage(passage: Passage, channels: Channels, physical: Numbers) -> Numbers:
    out = np.zeros(passage.rows.size)
    means, changes = rudder_of(passage, channels.dead_band, physical)
    arguments = arguments_of(channels, physical)
    with np.errstate(all="ignore"):
        channels.plane.compiled(arguments, channels.noise, passage.grid, means, changes, out, _NO_STATES)
    return out


def rudder_of(passage: Passage, dead_band: float, physical: Numbers) -> tuple[Numbers, Numbers]:
    """Return the mean angle of the fin in each step of a passage, and its change in it, rad."""
    # The servo's way before the first node is a step of its own.
    begin = min(passage.times[0], passage.issued[0]) - SAME
    times = np.append(begin, passage.times)
    means, changes = np.zeros(times.size - 1), np.zeros(times.size - 1)
    rate, dead_time, half_play = (float(physical[k]) for k in (RATE, DEAD_TIME, HALF_PLAY))
    _fin_angles(
        times,
        passage.issued,
        passage.commands,
        rate,
        dead_time,
        dead_band,
        max(half_play, 0.0),
        means,
        changes,
    )
    return means[1:] + (physical[TRIM] + passage.trim), changes[1:]


def arguments_of(channels: Channels, physical: Numbers) -> Numbers:
    """Return what `planar_innovations` and `dive_innovations` take as `c`."""
    lead = channels.latency - physical[LATENCY]
    return np.concatenate((physical[:COUNT], physical[HALF_PLAY + 1 : LATENCY], [lead]))


def many_innovations(channels: Channels, sets: Sequence[Numbers]) -> Numbers:
    """Return the innovations of several sets of unknowns, shape (m, sets)."""
    if COMPILED:
        with ThreadPoolExecutor(2) as pool:
            return np.array(list(pool.map(lambda one: innovations(channels, one), sets))).T
    return _uncompiled(channels, sets)


def _uncompiled(channels: Channels, sets: Sequence[Numbers]) -> Numbers:
    """Compute all sets in one pass of NumPy, in a hundredth of the time of one after the other."""
    parts = []
    arguments = list(np.array([arguments_of(channels, one) for one in sets]).T)
    for passage in channels.passages:
        seen: dict[tuple[float, ...], tuple[Numbers, Numbers]] = {}
        rudders = []
        for one in sets:
            key = tuple(float(one[k]) for k in (RATE, DEAD_TIME, HALF_PLAY, TRIM))
            if key not in seen:
                seen[key] = rudder_of(passage, channels.dead_band, one)
            rudders.append(seen[key])
        means, changes = np.array(rudders).transpose(1, 2, 0)
        out = np.zeros((passage.rows.size, len(sets)))
        with np.errstate(all="ignore"):
            channels.plane.plain(arguments, channels.noise, passage.grid, means, changes, out, _NO_STATES)
        parts.append(out)
    return np.clip(np.nan_to_num(np.concatenate(parts), nan=1e6), -1e6, 1e6)
