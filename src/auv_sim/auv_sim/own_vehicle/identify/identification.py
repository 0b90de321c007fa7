"""Identify a hull from recordings: several starts, the best likelihood, intervals."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from auv_path_following.vehicle import Hull
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers, Prior, prior_of
from auv_sim.own_vehicle.identify.dive.dive_combinations import dive_prior_of
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData
from auv_sim.own_vehicle.identify.innovations import Channels, Recording, channels_of
from auv_sim.own_vehicle.identify.intervals import Covariances, spread_of
from auv_sim.own_vehicle.identify.minimise import Minimised, minimise
from auv_sim.own_vehicle.identify.refine.model_errors import with_model_errors
from auv_sim.own_vehicle.identify.refine.own_trims import own_trim_columns, with_own_trims
from auv_sim.own_vehicle.identify.refine.servo_search import search_servo
from auv_sim.own_vehicle.identify.refine.vertical_loads import load_columns, with_vertical_loads
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import ALL, LATENCY, DataSheet, Scaling

#: Factors on the yaw coefficients for a hull that is damped in yaw, as another start.
_DAMPED = {"Nuv": 0.125, "Nur": 2.0, "Nrr": 0.2}
#: Dead times of the starts, s.
_DEAD_TIMES = (0.05, 0.2)
#: Dead bands that are tried where none is given, deg.
DEAD_BANDS = (0.0, 0.1, 0.2, 0.3, 0.5)
#: The starts are minimised first over these times in turn (s), by a filter with this growth of the variances
#: of u, v, r in a second: it follows the measurements, and its likelihood has few local minima. Those that
#: are left differ with the time.
_BEGINS, _GROWTH = (150.0, math.inf), (1e-2, 1e-3, 1e-4)
#: The prior is widened where an unknown lies farther from its mean, in standard deviations; by this share.
_FAR, _SHARE = 2.0, 0.75
#: A found latency that differs by more from the grid's gets a grid of its own, s.
_NEAR = 0.005


class Identified(NamedTuple):
    """What recordings show of a hull.

    Attributes:
        physical: the unknowns: see `Scaling.physical`.
        spread: their uncertainty.
        dead_band: of the rudder, rad.
        channels, scaling, estimate: as of the last minimisation.
        misfits: of each start, less that of the best.
    """

    physical: Numbers
    spread: Covariances
    dead_band: float
    channels: Channels
    scaling: Scaling
    estimate: Minimised
    misfits: tuple[float, ...]


def _quiet(done: int, total: int, what: str) -> None:
    """Report no progress."""


def identify(
    recordings: Sequence[PlanarData],
    hull: Hull,
    sheet: DataSheet | None = None,
    dead_band: float | None = None,
    progress: Callable[[int, int, str], None] = _quiet,
) -> Identified:
    """Identify a hull in the plane.

    Args:
        recordings: manoeuvres of one vehicle.
        hull: a known hull of about this size.
        sheet: errors of instruments and servo.
        dead_band: of the rudder, rad; None: the one of `DEAD_BANDS` that fits best.
        progress: called with minimisations done, their number, and what the next one is.
    """
    damped = dataclasses.replace(hull, **{name: f * getattr(hull, name) for name, f in _DAMPED.items()})
    prior = prior_of(hull)
    starts = [(prior, _DEAD_TIMES[0]), (prior, _DEAD_TIMES[1]), (prior_of(damped), _DEAD_TIMES[0])]
    return best_of(recordings, starts, DataSheet() if sheet is None else sheet, dead_band, progress)


def identify_dive(
    recordings: Sequence[DiveData],
    hull: Hull,
    vertical: VerticalHull,
    sheet: DataSheet | None = None,
    dead_band: float | None = None,
    progress: Callable[[int, int, str], None] = _quiet,
) -> Identified:
    """Identify heave and pitch.

    Args:
        recordings: manoeuvres of one vehicle.
        hull, vertical: a known hull of about this size.
        sheet: errors of instruments and servo; the rate is that of the stern planes.
        dead_band, progress: as for `identify`.
    """
    prior = dive_prior_of(hull, vertical)
    starts = [(prior, dead_time) for dead_time in _DEAD_TIMES]
    # The trim of the planes acts nearly as a centre of gravity ahead of that of buoyancy.
    sheet = (DataSheet() if sheet is None else sheet)._replace(trim=0.0)
    return best_of(recordings, starts, sheet, dead_band, progress)


def best_of(
    recordings: Sequence[Recording],
    starts: Sequence[tuple[Prior, float]],
    sheet: DataSheet,
    dead_band: float | None,
    progress: Callable[[int, int, str], None],
) -> Identified:
    """Return the estimate of the best likelihood from several starts, with intervals.

    Args:
        recordings: of one vehicle and one kind.
        starts: prior, and dead time of the fin (s).
        sheet: errors of instruments and servo.
        dead_band, progress: as for `identify`.
    """
    bands = [math.radians(band) for band in DEAD_BANDS] if dead_band is None else [dead_band]
    total = len(starts) + len(bands) + 3
    found = _from_starts(recordings, starts, sheet, bands[min(1, len(bands) - 1)], progress, total)
    misfits = [estimate.misfit for _, _, estimate in found]
    channels, scaling, estimate = min(found, key=_evidence)
    tried = []
    for k, band in enumerate(bands):
        progress(len(starts) + k, total, "dead band")
        tried.append(_again(recordings, scaling, estimate, band, channels.loads_off))
    channels, estimate = min(tried, key=lambda one: one[1].cost)
    progress(total - 3, total, "starts with the servo found")
    channels, scaling, estimate = _anew(channels, scaling, estimate, [prior for prior, _ in starts])
    progress(total - 2, total, "errors of the model")
    channels, scaling, estimate = _refined(recordings, channels, scaling, estimate, dead_band is not None)
    progress(total - 1, total, "intervals")
    spread = _spread(channels, scaling, estimate)
    progress(total, total, "done")
    return Identified(
        scaling.physical(estimate.z), spread, channels.dead_band, channels, scaling, estimate,
        tuple(misfit - min(misfits) for misfit in misfits),
    )  # fmt: skip


def _refined(
    recordings: Sequence[Recording], channels: Channels, scaling: Scaling, estimate: Minimised,
    is_band_known: bool,
) -> tuple[Channels, Scaling, Minimised]:  # fmt: skip
    """Return an estimate with its model's errors, trims, vertical loads, best servo near it and prior."""
    channels, estimate = with_model_errors(channels, scaling, estimate)
    channels, estimate = _with_own_trims(recordings, channels, scaling, estimate)
    channels, estimate = with_vertical_loads(channels, scaling, estimate)
    channels, estimate = search_servo(channels, scaling, estimate, is_band_known)
    channels, estimate = with_model_errors(channels, scaling, estimate)
    scaling, estimate = _widened(channels, scaling, estimate)
    channels, estimate = with_vertical_loads(channels, scaling, estimate)
    return channels, scaling, estimate


def _spread(channels: Channels, scaling: Scaling, estimate: Minimised) -> Covariances:
    """Return the uncertainty of an estimate; trims and vertical loads were estimated beside it."""
    parts = channels, scaling, estimate
    further = np.hstack((own_trim_columns(*parts), load_columns(*parts)))
    return spread_of(*parts, further, channels.loads_off.size)


def _from_starts(
    recordings: Sequence[Recording], starts: Sequence[tuple[Prior, float]], sheet: DataSheet,
    dead_band: float, progress: Callable[[int, int, str], None], total: int,
) -> list[tuple[Channels, Scaling, Minimised]]:  # fmt: skip
    """Return the estimate from each start, with the vertical loads found by the filter that follows."""
    channels = channels_of(recordings, sheet, dead_band)
    begins = [_following(recordings[0], seconds, sheet, dead_band) for seconds in _BEGINS]
    found = []
    for k, (prior, dead_time) in enumerate(starts):
        progress(k, total, f"start {k + 1} of {len(starts)}")
        scaling = Scaling(prior, sheet._replace(dead_time=dead_time))
        following = begins[k % len(begins)]
        first = minimise(following, scaling, np.zeros(ALL), rounds=2, steps=10)
        following, first = with_vertical_loads(following, scaling, first)
        own = channels.with_loads_off(following.loads_off)
        found.append((own, scaling, minimise(own, scaling, first.z)))
    return found


def _evidence(found: tuple[Channels, Scaling, Minimised]) -> float:
    """Return the negative logarithm of likelihood and prior, for a comparison of different priors."""
    channels, scaling, estimate = found
    loads = 0.5 * float(channels.loads_off @ channels.loads_off)
    return estimate.cost + loads + float(np.log(np.diag(scaling.prior.root)).sum())


def _anew(
    channels: Channels, scaling: Scaling, estimate: Minimised, priors: Sequence[Prior]
) -> tuple[Channels, Scaling, Minimised]:
    """Return the best of an estimate and of minimisations from the mean of each prior, with its servo.

    Each has the vertical loads that fit it best.
    """
    begins = [(scaling, estimate)]
    for prior in {id(prior): prior for prior in priors}.values():
        own = scaling._replace(prior=prior)
        z = np.append(np.zeros(COUNT), estimate.z[COUNT:])
        begins.append((own, minimise(channels, own, z, first=estimate.deviations)))
    loaded = [(own, *with_vertical_loads(channels, own, first)) for own, first in begins]
    return min(((others, own, best) for own, others, best in loaded), key=_evidence)


def _following(data: Recording, seconds: float, sheet: DataSheet, dead_band: float) -> Channels:
    """Return the channels of the first `seconds`, with a filter that follows the measurements."""
    channels = channels_of([data.between(data.t[0] - 1.0, data.t[0] + seconds)], sheet, dead_band)
    return channels._replace(noise=(*channels.noise[:3], *_GROWTH, *channels.noise[6:]))


def _with_own_trims(
    recordings: Sequence[Recording], channels: Channels, scaling: Scaling, estimate: Minimised
) -> tuple[Channels, Minimised]:
    """Return an estimate with a trim for each recording where they differ, and the errors of its model."""
    own, found = with_own_trims(channels, scaling, estimate, [data.name for data in recordings])
    return (channels, estimate) if own is channels else with_model_errors(own, scaling, found)


def _widened(channels: Channels, scaling: Scaling, estimate: Minimised) -> tuple[Scaling, Minimised]:
    """Return an estimate whose prior is as wide as the hull differs from the known one, if it does."""
    for _ in range(2):
        farthest = float(np.abs(estimate.z[:COUNT]).max())
        if farthest < _FAR:
            break
        wider = scaling._replace(prior=scaling.prior._replace(root=scaling.prior.root * _SHARE * farthest))
        z = wider.scaled(scaling.physical(estimate.z))
        scaling, estimate = wider, minimise(channels, wider, z, first=estimate.deviations)
    return scaling, estimate


def _again(
    recordings: Sequence[Recording], scaling: Scaling, estimate: Minimised, band: float, loads_off: Numbers
) -> tuple[Channels, Minimised]:
    """Minimise from an estimate with another dead band, on the grid of the latency found."""
    latency = float(scaling.physical(estimate.z)[LATENCY])
    latency = latency if abs(latency - scaling.sheet.latency) > _NEAR else scaling.sheet.latency
    channels = channels_of(recordings, scaling.sheet, band, max(latency, 0.0)).with_loads_off(loads_off)
    return channels, minimise(channels, scaling, estimate.z, first=estimate.deviations)
