"""Look-ahead distance from speed and cross-track error; not part of the paper, off by default."""

from __future__ import annotations

import math

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import numbers, pure, squared


@numbers
@settings
class AdaptiveLookaheadConfig:
    """Delta between 1.5 and 4 hull lengths."""

    enabled: bool = setting(False, "choose Delta by speed and cross-track error", live=True)
    hull_length: float = setting(1.6, "length of the hull", unit="m", gt=0.0, le=1000.0, live=True)
    smallest: float = setting(1.5, "smallest Delta, in hull lengths", gt=0.0, le=100.0, live=True)
    largest: float = setting(4.0, "largest Delta, in hull lengths", gt=0.0, le=100.0, live=True)
    time: float = setting(
        2.7,
        "far from the path Delta is the distance travelled in this time",
        unit="s",
        gt=0.0,
        le=100.0,
        live=True,
    )
    near: float = setting(0.75, "share of that Delta on the path itself", gt=0.0, le=2.0, live=True)
    width: float = setting(
        1.0,
        "cross-track error of the transition between the two",
        unit="m",
        gt=0.0,
        le=1000.0,
        live=True,
    )


@pure
def adaptive_lookahead(config: AdaptiveLookaheadConfig, ye: float, Ur: float) -> float:
    """Return Delta, m: time Ur far away, `near` of it on the path, never beyond the bounds.

    A short look-ahead converges faster on the path, where the angles are small and the rudder can follow;
    from far away it would only demand a sharper turn at the end of the approach.
    """
    share = 1.0 + (config.near - 1.0) * math.exp(-squared(ye / config.width))
    length = config.hull_length
    return min(max(config.time * Ur * share, config.smallest * length), config.largest * length)
