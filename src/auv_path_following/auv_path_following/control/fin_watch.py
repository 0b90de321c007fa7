"""Watch stern planes: at their stop, or not where the command has them. No ROS, no clock."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, numbers, numbers_of, pure
from auv_path_following.vehicle import Rudder

#: Share of the largest angle from which on a fin counts as at its stop.
_AT_STOP = 0.99


@numbers
@settings
class FinWatchConfig:
    """What is reported of the stern planes; it stops nothing, the limits of guidance do."""

    stop_after: float = setting(
        5.0, "stern planes commanded to their stop for this long are reported; 0: never", unit="s", ge=0.0,
        live=True,
    )  # fmt: skip
    differs_by_deg: float = setting(
        3.0, "difference of sternplane_state from sternplane_cmd that is reported; 0: any", unit="deg",
        ge=0.0, live=True,
    )  # fmt: skip
    differs_after: float = setting(
        1.0, "such a difference is reported after this long", unit="s", ge=0.0, live=True
    )


class FinWatch(NamedTuple):
    """Configuration: settings, and largest angle (rad), rate (rad/s) and dead time (s) of the fin."""

    values: FinWatchConfig
    max_angle: float
    max_rate: float
    dead_time: float


class FinWatchState(NamedTuple):
    """State.

    Attributes:
        angle: where a sound fin is, rad.
        at_stop, differs: time for which it has been so, s.
    """

    angle: float
    at_stop: float
    differs: float


#: The state of a fin in neutral.
NEUTRAL = FinWatchState(0.0, 0.0, 0.0)


def prepare(config: FinWatchConfig, fin: Rudder) -> FinWatch:
    """Return the configuration for a fin."""
    return FinWatch(numbers_of(config), fin.max_angle, fin.max_rate, float(fin.dead_time))


@pure
def watch_fin(
    config: FinWatch, state: FinWatchState, command: float, measured: float, dt: float
) -> tuple[FinWatchState, bool, bool]:
    """Compare a fin with its command.

    Args:
        config, state: of the watch.
        command: rad.
        measured: its angle, rad; NaN: not measured.
        dt: seconds since the last step.

    Returns:
        The state; whether the fin has been at its stop for too long; whether it does not follow.
    """
    c = config.values
    angle = state.angle + bounded(command - state.angle, config.max_rate * dt)
    at_stop = state.at_stop + dt if abs(command) >= _AT_STOP * config.max_angle else 0.0
    allowed = math.radians(c.differs_by_deg)
    differs = state.differs + dt if abs(measured - angle) > allowed > 0.0 else 0.0  # NaN: it does not
    state = FinWatchState(angle, at_stop, differs)
    return state, at_stop > c.stop_after > 0.0, differs > c.differs_after + config.dead_time


def complaint(is_at_stop: bool, differs: bool) -> str:
    """Return what is wrong with the stern planes; empty: nothing."""
    if differs:
        return "the stern planes do not follow their command"
    return "the stern planes are at their stop" if is_at_stop else ""
