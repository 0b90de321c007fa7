"""What differs between identifications in the plane and in the vertical: filter, flight, noise."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from auv_sim.flight.batch.compiled import compiled, take_over_pure
from auv_sim.own_vehicle.identify.combinations import SCALE_POWERS, Numbers
from auv_sim.own_vehicle.identify.dive.dive_combinations import DIVE_SCALE_POWERS
from auv_sim.own_vehicle.identify.dive.dive_data import dive_passage_of, surge_error
from auv_sim.own_vehicle.identify.dive.dive_filter import dive_flight, dive_innovations
from auv_sim.own_vehicle.identify.filter.planar_filter import planar_flight, planar_innovations
from auv_sim.own_vehicle.identify.time_grid import Passage, passage_of
from auv_sim.own_vehicle.identify.unknowns import DataSheet

take_over_pure()


class Plane(NamedTuple):
    """What differs between identifications in the plane and in the vertical.

    Attributes:
        compiled, plain: the filter.
        flight: prediction by the commands alone.
        passage_of: (recording, latency) -> passage.
        measured: names of the signals in the order of the states, for their noise.
        least: least standard deviations of those.
        growth: of the states' variances in a second: nearly none.
        alike: groups of states whose growth is increased together where the model is in error.
        scale_powers: of the combinations, in the scale of the log.
        has_thrust: whether the first combination is that of the thrust.
        slow_error: standard deviation and time constant (s) of the thrust's or the measured surge's error, by
            the data sheet, the recordings and the noise of the surge.
        error, error_time: standard deviation (rad) before any data and time constant (s) of the error of the
            fin's angle, or of the measured pitch.
        model_error: measured errors over those that the innovations show.
    """

    compiled: Callable[..., None]
    plain: Callable[..., None]
    flight: Callable[..., None]
    passage_of: Callable[[Any, float], Passage]
    measured: tuple[str, str, str]
    least: tuple[float, float, float]
    growth: tuple[float, float, float]
    alike: tuple[tuple[int, ...], ...]
    scale_powers: Numbers
    has_thrust: bool
    slow_error: Callable[[DataSheet, Any, float], tuple[float, float]]
    error: float
    error_time: float
    model_error: float


#: Error of a rudder's angle: standard deviation, rad, and time constant, s. Without it the likelihood has
#: more local minima. The same of an attitude sensor's drift.
_FIN, _PITCH = (math.radians(0.012), 1.0), (math.radians(0.1), 60.0)
#: Heave and pitch are identified with the motion of the other axes as measured. The errors of divers of 1 to
#: 5 m are 1.3 times what the innovations show (rms): see `vehicle.py identify --study 10 --dive --first 100`.
_MODEL_ERROR = 1.4


HORIZONTAL = Plane(
    compiled(planar_innovations), planar_innovations, compiled(planar_flight), passage_of,
    ("u", "v", "r"), (1e-3, 1e-3, 1e-4), (1e-7, 1e-8, 1e-9), ((0, 1, 2),), SCALE_POWERS, True,
    lambda sheet, recordings, white: (sheet.thrust_drift, sheet.drift_time), *_FIN, 1.0,
)  # fmt: skip
VERTICAL = Plane(
    compiled(dive_innovations), dive_innovations, compiled(dive_flight), dive_passage_of,
    ("theta", "w", "q"), (1e-4, 1e-3, 1e-4), (1e-9, 1e-7, 1e-8), ((0,), (1, 2)), DIVE_SCALE_POWERS, False,
    lambda sheet, recordings, white: surge_error(recordings, white), *_PITCH, _MODEL_ERROR,
)  # fmt: skip
