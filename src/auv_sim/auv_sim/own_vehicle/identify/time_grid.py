"""Measurements and commands of a recording on one line of time: the nodes that the filter visits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.dive.vertical_motion import VerticalLoads, VerticalMotion, vertical_loads

#: Longest step of the filter, s.
LONGEST_STEP = 0.06
#: A longer gap between measurements of the yaw rate begins a new passage, s.
LONGEST_GAP = 1.0
#: Time after a gap without commands in which a fin follows the next ones, s; until then its angle is unknown.
FOLLOWED = 5.0
#: Commands are kept from this time before an interval on, s.
_BEFORE = 5.0
#: Times nearer than this are one node, s.
SAME = 1e-3


class PlanarData(NamedTuple):
    """A recording of manoeuvres in the plane: NED and FRD, SI units, radians.

    Attributes:
        name: for people.
        t, r: times (s) and yaw rates, as measured.
        water_t, u, v: arrival of each new sample of the velocity through the water, and its components.
        rudder_t, rudder: times and values of the rudder commands.
        thrust_t, thrust: the same of the thrust.
        psi: heading at `t`.
        over_u, over_v: velocity over ground at `t`, m/s; NaN where there is none.
        leg: number of the manoeuvre at `t`; zeros where it is not recorded.
        vertical: heave, roll and pitch beside it; None where they are not known.
    """

    name: str
    t: Numbers
    r: Numbers
    water_t: Numbers
    u: Numbers
    v: Numbers
    rudder_t: Numbers
    rudder: Numbers
    thrust_t: Numbers
    thrust: Numbers
    psi: Numbers
    over_u: Numbers
    over_v: Numbers
    leg: Numbers
    vertical: VerticalMotion | None = None

    def between(self, begin: float, end: float) -> PlanarData:
        """Return the measurements of an interval (s), with the commands since shortly before it."""
        rows, water = (self.t >= begin) & (self.t < end), (self.water_t >= begin) & (self.water_t < end)
        rudder = _since(self.rudder_t, begin - _BEFORE) & (self.rudder_t < end)
        thrust = _since(self.thrust_t, begin - _BEFORE) & (self.thrust_t < end)
        return PlanarData(
            self.name, self.t[rows], self.r[rows], self.water_t[water], self.u[water], self.v[water],
            self.rudder_t[rudder], self.rudder[rudder], self.thrust_t[thrust], self.thrust[thrust],
            self.psi[rows], self.over_u[rows], self.over_v[rows], self.leg[rows],
            self.vertical,
        )  # fmt: skip


def _since(t: Numbers, begin: float) -> NDArray[np.bool_]:
    """Return the times from `begin` on, and the last one before it."""
    rows: NDArray[np.bool_] = np.append(t[1:] > begin, True)
    return rows


def shared_time(data: PlanarData) -> float:
    """Return how long odometry, both commands and the velocity through the water all exist, s."""
    streams = (data.t, data.water_t, data.rudder_t, data.thrust_t)
    if not all(times.size for times in streams):
        return 0.0
    begin, end = max(times[0] for times in streams), min(data.t[-1], data.water_t[-1])
    return max(float(end - begin), 0.0)


class Grid(NamedTuple):
    """The arrays that `planar_filter.planar_innovations` reads, one entry for each node.

    Attributes:
        step: to the next node, s.
        begins: whether a node begins a passage.
        thrust: of the step, N.
        rate_row, rate: row of r among the innovations or -1, and r, rad/s.
        u_row, v_row, u, v: rows of u and v among them or -1, and these, m/s.
        given: further accelerations of u, v (m/s^2) and r (rad/s^2) in the step, (n, 3).
    """

    step: Numbers
    begins: NDArray[np.bool_]
    thrust: Numbers
    rate_row: NDArray[np.int64]
    rate: Numbers
    u_row: NDArray[np.int64]
    v_row: NDArray[np.int64]
    u: Numbers
    v: Numbers
    given: Numbers


class Passage(NamedTuple):
    """One recording, ready for the filter.

    Attributes:
        grid: its nodes.
        times: of the nodes and of the end of the last step, s.
        issued, commands: times (s) and angles (rad) of the fin's commands.
        rows: time of each row of the innovations, s: channel after channel.
        counts: rows of each channel.
        trim: of the fin, in addition to that of all recordings, rad.
        loads: by heave, roll and pitch; None where they are not known.
    """

    grid: Grid
    times: Numbers
    issued: Numbers
    commands: Numbers
    rows: Numbers
    counts: tuple[int, int, int]
    trim: float = 0.0
    loads: VerticalLoads | None = None

    @property
    def middles(self) -> Numbers:
        """Times in the middle of each step, s: motion given at its beginning would be half a step late."""
        return 0.5 * (self.times[:-1] + self.times[1:])

    def with_loads(self, loads: VerticalLoads | None) -> Passage:
        """Return the passage with other loads, if there are any."""
        if loads is None:
            return self
        return self._replace(grid=self.grid._replace(given=loads.accelerations()), loads=loads)


def passage_of(data: PlanarData, latency: float) -> Passage:
    """Return the nodes of a recording.

    Args:
        data: its measurements and commands.
        latency: age of a velocity when it arrives, s.
    """
    measured = data.water_t - latency
    first = max(data.t[0], data.rudder_t[0], data.thrust_t[0], measured[0]) - SAME
    rows, samples = data.t >= first, measured >= first
    t, at = data.t[rows], measured[samples]
    at = _snapped(at, t)
    times = np.union1d(t, at)
    times = _filled(times)
    n = times.size
    of_rate, of_water = np.searchsorted(times, t), np.searchsorted(times, at)
    u, v, rate = np.zeros(n), np.zeros(n), np.interp(times, t, data.r[rows])
    rate_row, u_row = np.full(n, -1), np.full(n, -1)
    u[of_water], v[of_water] = data.u[samples], data.v[samples]
    rate_row[of_rate], u_row[of_water] = np.arange(t.size), t.size + np.arange(at.size)
    begins, unused = _begins(times, u_row >= 0, data.rudder_t)
    rate_row[unused], u_row[unused] = -1, -1
    v_row = np.where(u_row >= 0, u_row + at.size, -1)
    step = np.append(np.diff(times), SAME)
    last = np.searchsorted(data.thrust_t, times + SAME, side="right") - 1
    thrust = data.thrust[np.maximum(last, 0)]
    grid = Grid(step, begins, thrust, rate_row, rate, u_row, v_row, u, v, np.zeros((n, 3)))
    every = np.concatenate((t, at, at))
    ends = np.append(times, times[-1] + SAME)
    passage = Passage(grid, ends, data.rudder_t, data.rudder, every, (t.size, at.size, at.size))
    if data.vertical is None:
        return passage
    turning = np.interp(passage.middles, t, data.r[rows])
    return passage.with_loads(vertical_loads(data.vertical, latency, passage.middles, turning))


def _snapped(at: Numbers, t: Numbers) -> Numbers:
    """Return times, each moved to the nearest of `t` where that is near."""
    right = np.clip(np.searchsorted(t, at), 1, t.size - 1)
    nearest = np.where(at - t[right - 1] < t[right] - at, t[right - 1], t[right])
    return np.where(np.abs(nearest - at) < SAME, nearest, at)


def _filled(times: Numbers) -> Numbers:
    """Return times with further ones between those that lie too far apart for one step."""
    gaps = np.diff(times)
    parts = np.where(gaps < LONGEST_GAP, np.ceil(gaps / LONGEST_STEP - 1e-9), 1).astype(int)
    if (parts <= 1).all():
        return times
    pieces = [np.linspace(a, a + g, k, endpoint=False) for a, g, k in zip(times, gaps, parts, strict=False)]
    return np.append(np.concatenate(pieces), times[-1])


def _begins(
    times: Numbers, has_water: NDArray[np.bool_], commands: Numbers
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return the nodes at which a passage begins, and those before one: fin, u and v are not known there."""
    begins, unused = np.zeros(times.size, bool), np.zeros(times.size, bool)
    waiting, ready = True, times[0]
    for k in range(times.size):
        if k > 0 and times[k] - times[k - 1] >= LONGEST_GAP:
            within = commands[(commands > times[k - 1]) & (commands < times[k])]
            silent = np.diff(within, prepend=times[k - 1], append=times[k]).max() >= LONGEST_GAP
            waiting, ready = True, times[k] + (FOLLOWED if silent else 0.0)
        if waiting and has_water[k] and times[k] >= ready:
            begins[k], waiting = True, False
        unused[k] = waiting
    return begins, unused
