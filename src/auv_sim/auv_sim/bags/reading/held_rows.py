"""Rows of a recorded run that lie in a hold, by `mission_state`."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract.mission_word import MissionState


def held_rows(log_ns: NDArray[np.int64], states: Sequence[tuple[int, Any]]) -> NDArray[np.float64]:
    """Return 1 where the mission held at an odometry or since the one before, else 0; NaN without any state.

    Args:
        log_ns: shape (n,), log times of the odometry, ascending, ns.
        states: (log time in ns, std_msgs/String), in the order of log time.

    Returns:
        shape (n,).
    """
    held = np.full(log_ns.size, 0.0 if states else np.nan)
    forever = np.iinfo(np.int64).max
    for (begin, message), (end, _) in itertools.pairwise([*states, (forever, None)]):
        if message.data == MissionState.HOLDING:
            first, last = np.searchsorted(log_ns, (begin, end))
            held[first : last + 1] = 1.0
    return held
