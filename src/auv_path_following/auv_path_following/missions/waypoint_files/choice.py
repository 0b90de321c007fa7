"""Choose the shape of a file that a mission takes, and list the others."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Literal, NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    Kind,
    Point,
    labels,
    listed,
    shown,
)
from auv_path_following.missions.waypoint_files.file_depths import depths_of

#: What the shape is for: points to pass, the polygon of a survey, or the area that must not be left.
Use = Literal["waypoints", "survey", "geofence"]

_FIRST: dict[Use, tuple[Kind, ...]] = {
    "waypoints": ("line", "polygon", "point"),
    "survey": ("polygon", "line", "point"),
    "geofence": ("polygon", "line", "point"),
}
_NOTHING: dict[Use, tuple[str, str]] = {
    "waypoints": ("no waypoints", "a line, a polygon or points"),
    "survey": ("no polygon", "a polygon, a line or points"),
    "geofence": ("no area", "an inclusion fence, a polygon, a closed line or points"),
}
_SPLIT = "a polygon without holes: split it into parts around the hole, one mission each, or delete the hole"


class Chosen(NamedTuple):
    """The chosen part of a file.

    Attributes:
        points: as in `FileShape`.
        outline: whether they are the outline of a polygon, which is closed.
        notices: parts that are not taken, one line each.
        depths: of the points, m, positive down; None for a planar path.
    """

    points: list[Point]
    outline: bool
    notices: list[str]
    depths: list[float] | None = None


def choose(content: Content, use: Use, feature: str | None = None, take_depths: bool = True) -> Chosen:
    """Take the one line or polygon for this use, else all points in their order.

    Waypoints prefer a line to a polygon, surveys and geofences a polygon to a line.

    Args:
        content: of the file.
        use: purpose of the shape.
        feature: name of the shape to take; None where the file holds only one.
        take_depths: whether waypoints have the depths of the file.

    Raises:
        ConfigurationError: nothing fits, several do, or what fits must not be taken as it stands.
    """
    pool = _pool(content, use)
    named = labels(pool)
    matching = [k for k, shape in enumerate(pool) if feature in (None, named[k], shape.name)]
    if feature is not None and not matching:
        raise ConfigurationError("", f"no feature {shown(feature)}", f"one of {_names(named)}")
    for kind in _FIRST[use]:
        chosen = [k for k in matching if pool[k].kind == kind]
        if len(chosen) > 1 and kind != "point":
            found = f"{len(chosen)} {kind}s ({_names(named[k] for k in chosen)})"
            raise ConfigurationError("", found, "one, or `feature: NAME`")
        if use == "geofence" and kind == "line":
            chosen = [k for k in chosen if pool[k].points and pool[k].points[0] == pool[k].points[-1]]
        if chosen:
            break
    else:
        raise _nothing(content, use)
    for k in chosen:
        _refuse(pool[k], use)
    points = [point for k in chosen for point in pool[k].points]
    taken = [pool[k] for k in chosen]
    ignored = "" if take_depths else "the mission file ignores them (depths: ignore)"
    depths, left_out = depths_of(taken, ignored if use == "waypoints" else "an area has no depth")
    notices = [*_about(taken, use), *([left_out] if left_out else []), *content.notices]
    if rest := [k for k in range(len(pool)) if k not in set(chosen)]:
        notices.append(_left_out([pool[k] for k in rest], [named[k] for k in rest]))
    return Chosen(points, kind == "polygon", notices, depths)


def _pool(content: Content, use: Use) -> list[FileShape]:
    if use == "survey":
        return [*content.areas, *content.shapes]
    if use == "geofence" and content.fences:
        return content.fences
    return content.shapes


def _names(names: Iterable[str]) -> str:
    return listed(map(shown, names))


def _nothing(content: Content, use: Use) -> ConfigurationError:
    found, expected = _NOTHING[use]
    if content.notices:
        found += f" ({'; '.join(content.notices[:3])})"
    if content.fences:
        expected += "; it holds a geofence: name the file as `geofence: {file: ...}`"
    return ConfigurationError("", found, expected)


def _refuse(shape: FileShape, use: Use) -> None:
    if shape.refusal is not None:
        raise shape.refusal
    if shape.holes and use != "waypoints":
        where = shown(shape.name) if shape.name else "polygon"
        raise ConfigurationError(
            where, f"a polygon with {shape.holes} hole(s), which would be crossed", _SPLIT
        )


def _about(chosen: list[FileShape], use: Use) -> list[str]:
    found = [notice for shape in chosen for notice in shape.notices]
    if use == "waypoints" and any(shape.holes for shape in chosen):
        found.append("the polygon's holes are not taken: only its outline is followed")
    if use != "waypoints" and chosen[0].kind == "line":
        found.append(f"the line {shown(chosen[0].name)} is taken as an outline and closed")
    return found


def _left_out(rest: list[FileShape], names: list[str]) -> str:
    counts = Counter(shape.kind for shape in rest)
    kinds = " and ".join(f"{count} {kind}{'s' * (count > 1)}" for kind, count in counts.items())
    return f"{kinds} not taken: {_names(names)}"
