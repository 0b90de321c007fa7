"""Checks that a recorded rudder is in radians and positive to port; marks of shares taken for radians."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.abilities import Rudder
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.identify.combinations import Combinations, Numbers
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import RATE, typed

#: Share of the commands that may exceed a limit: a controller may request more than there is for a moment.
EXCEEDING = 0.02
#: Largest angle of a rudder, rad.
_LARGEST_ANGLE = 0.5 * math.pi
#: Largest share of commands beyond 1.1 of the largest angle: a controller may saturate at times.
_SATURATED, _MORE_ANGLE = 0.25, 1.1
#: Largest angle from which on shares and radians hardly differ, rad.
_ABOUT_ONE = 0.9
#: The option for another unit.
_UNITS = "--unit rudder_cmd=deg, percent or share"
#: Correlation of the rudder with the yaw rate's change over the following time (s), sampled every so often
#: (s), of another sign; that of the right sign is -0.65 to -0.8 on the shipped and drawn hulls at sea.
_REVERSED, _EFFECT, _EVERY = 0.3, 0.6, 0.1


def check_rudder(rudder: Numbers, vehicle: Vehicle, where: str, is_unit_given: bool) -> None:
    """Check that a rudder is in radians; arguments and error as `check_commands`."""
    beyond = float(np.mean(np.abs(rudder) > _MORE_ANGLE * vehicle.rudder.max_angle)) if rudder.size else 0.0
    if beyond > _SATURATED or (rudder.size and np.mean(np.abs(rudder) > _LARGEST_ANGLE) > EXCEEDING):
        found = f"angles up to {np.max(np.abs(rudder)):.3g}, {beyond:.0%} of them beyond the rudder's largest"
        expected = f"radians, {vehicle.rudder.max_angle:.2g} at most, or {_UNITS}"
        raise ConfigurationError(f"{where}: rudder_cmd", found, expected)
    largest = float(np.max(np.abs(rudder), initial=0.0))
    if not is_unit_given and beyond > 0.0 and abs(largest - 1.0) < 1e-6:
        has = f"{vehicle.name} has {vehicle.rudder.max_angle:.2g} rad"
        found = f"a rudder that goes to 1 and no farther, where {has}"
        raise ConfigurationError(f"{where}: rudder_cmd", found, f"its unit: {_UNITS}, or rad")


def check_rudder_sign(recordings: Sequence[PlanarData], where: str) -> None:
    """Check that a positive rudder turns to port, REP-103.

    The rudder is correlated with the change of the yaw rate after it, for a given yaw rate.

    Raises:
        ConfigurationError: it turns to starboard.
    """
    rates, changes, angles = [], [], []
    for data in recordings:
        at = np.arange(data.t[0], data.t[-1] - _EFFECT, _EVERY)
        rows = np.searchsorted(data.rudder_t, at, side="right") - 1
        rate, later = (np.interp(at + ahead, data.t, data.r) for ahead in (0.0, _EFFECT))
        kept = rows >= 0
        rates.append(rate[kept])
        changes.append((later - rate)[kept])
        angles.append(data.rudder[rows[kept]])
    rate = np.concatenate(rates)
    known = np.column_stack((rate, np.ones_like(rate)))
    change, angle = (
        y - known @ np.linalg.lstsq(known, y, rcond=None)[0]
        for y in (np.concatenate(changes), np.concatenate(angles))
    )
    to_starboard = float(np.sum(change * angle)) / max(
        float(np.linalg.norm(change) * np.linalg.norm(angle)), 1e-12
    )
    if to_starboard > _REVERSED:
        raise ConfigurationError(
            f"{where}: rudder_cmd",
            "a positive rudder that turns to starboard",
            "one that turns to port, REP-103, or --unit rudder_cmd=-rad (-deg, -percent, -share)",
        )


def share_doubts(found: Identified, known: Combinations, rudder: Rudder) -> list[str]:
    """Return one line where effect and rate of the rudder are off as those of shares taken for radians are.

    Shares of the largest angle make the effect smaller by that angle and the rate larger by its inverse.

    Args:
        found: what was identified.
        known: combinations of the known hull.
        rudder: its limits.
    """
    effect = typed(found.physical).Nuud / known.Nuud
    rate = float(found.physical[RATE]) / found.scaling.sheet.rate
    if not (0.0 < effect < 1.0 < rate and effect / rate < rudder.max_angle < _ABOUT_ONE):
        return []
    return [
        f"the rudder has {effect:.2g} of the known effect and turns {rate:.2g} times as fast: shares of its "
        f"largest angle, {rudder.max_angle:.2g} rad, taken for radians look like that. "
        "Give --unit rudder_cmd=share, or =rad if they are radians"
    ]
