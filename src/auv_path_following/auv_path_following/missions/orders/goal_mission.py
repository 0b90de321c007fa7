"""A goal instead of a mission file: the mission that leads from the vehicle to a pose."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.settings import yaml_file
from auv_path_following.curves.dubins import NOTHING, STRAIGHT, Part, PlanarPose, parts, shortest

#: Depths that differ by less count as one, m.
_SAME_DEPTH = 0.05


def goal_text(
    here: PlanarPose,
    there: PlanarPose,
    radius: float,
    thrust: float,
    depths: tuple[float, float] | None = None,
) -> str:
    """Return the content of a mission file: the shortest path with turns of one radius (Dubins).

    Args:
        here, there: pose of the vehicle, and of the goal, NED.
        radius: of the turns, m.
        thrust: on the way, N.
        depths: here and there, m; None for a vehicle that does not dive.

    Returns:
        The text; empty where the vehicle is at the goal already.
    """
    segments, length = _segments(here, there, radius)
    if not segments:
        return ""
    mission: dict[str, Any] = {
        "version": 1,
        "name": "goal",
        "description": f"to north {there.x:.1f} m, east {there.y:.1f} m",
        "frame": "ned",
        "thrust": thrust,
    }
    if depths is not None:
        first, last = depths
        if abs(last - first) < _SAME_DEPTH:
            mission["depth"] = last
        else:
            mission["depth_profile"] = {"kind": "smooth", "knots": [[0.0, first], [length, last]]}
    return yaml_file.text_of(mission | {"segments": segments})


def _segments(here: PlanarPose, there: PlanarPose, radius: float) -> tuple[list[dict[str, Any]], float]:
    """Return the subpaths of the shortest path as a mission file has them, and its length, m."""
    word = shortest(here, there, radius)
    sides, sizes = word[:3], word[3:]
    found = [
        _line(part) if side == STRAIGHT else _arc(part)
        for side, size, part in zip(sides, sizes, parts(here, there, word, radius), strict=True)
        if size > NOTHING
    ]
    return found, word.size * radius


def _line(part: Part) -> dict[str, Any]:
    x, y, length, chi, _ = part
    return {"line": {"start": [x, y], "length": length, "course_deg": math.degrees(chi)}}


def _arc(part: Part) -> dict[str, Any]:
    x, y, radius, first, last = part
    ends = {"from_deg": math.degrees(first), "to_deg": math.degrees(last)}
    return {"arc": {"centre": [x, y], "radius": radius, **ends}}
