"""The place of a path at which a mission begins, as an operator names it."""

from __future__ import annotations

import re
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError

_SUBPATH = re.compile(r"\s*subpath\s+(\d{1,6})\s*")
_METRES = re.compile(r"\s*(\d{1,9}(?:\.\d*)?)\s*m\s*")


def path_parameter_of(place: str, path: Any) -> float:
    """Return the path parameter s of a place, Eq. (1), in [0, n).

    Args:
        place: ``subpath 3`` (from 1), ``120 m`` along the path, or empty for its start.
        path: with `n`, `length` and `distance_to_go`.

    Raises:
        ConfigurationError: it names no place of the path before its end.
    """
    if not place.strip():
        return 0.0
    if found := _SUBPATH.fullmatch(place):
        number = int(found[1])
        if not 1 <= number <= path.n:
            raise ConfigurationError("start_at", repr(place), f"a subpath from 1 to {path.n}")
        return float(number - 1)
    found = _METRES.fullmatch(place)
    if found is None:
        raise ConfigurationError("start_at", repr(place), "'subpath 3', '120 m', or nothing")
    metres = float(found[1])
    if not metres < path.length:
        raise ConfigurationError("start_at", repr(place), f"less than the path's {path.length:.1f} m")
    return _after(metres, path)


def _after(metres: float, path: Any) -> float:
    """Return the path parameter `metres` from the start, by bisection."""
    below, above = 0.0, float(path.n)
    for _ in range(80):
        s = 0.5 * (below + above)
        i = min(int(s), path.n - 1)
        if path.length - path.distance_to_go(i, s - i) <= metres:
            below = s
        else:
            above = s
    return below
