"""MAVLink mission items: waypoints, items left out with a notice, and items refused."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import (
    Content,
    FileShape,
    Point,
    heights_of,
    listed,
    number,
    shape,
)

#: MAV_FRAMEs of positions in degrees; they differ in the reference of a height: 10, 11 are over the terrain.
_GLOBAL_FRAMES = (0, 3, 5, 6, 10, 11)
#: Commands up to this one move the vehicle; of the later ones only `_MOVING` do.
_LAST_NAVIGATION = 95
_WAYPOINT, _SPEED = 16, 178
_FENCE_VERTEX = 5001
#: Most kinds of commands that are listed; the others are counted.
_MOST_KINDS = 30

#: Commands taken as waypoints -> what the vehicle would do there besides passing.
_PASSED = {
    _WAYPOINT: "",
    82: "",
    17: "waiting without end",
    18: "circling",
    19: "waiting",
    31: "circling to a height",
}
#: Commands after which a mission ends.
_ENDS = {17: "waiting without end", 20: "return to launch", 21: "landing", 85: "landing"}
#: Commands that are left out: they do not change the path.
_LEFT_OUT = {
    20: "return to launch",
    21: "landing",
    22: "takeoff",
    24: "takeoff",
    80: "region of interest",
    84: "takeoff",
    85: "landing",
    93: "delay",
    112: "delay",
    114: "wait for a distance",
    115: "heading change",
    179: "home position",
    181: "relay",
    182: "relay",
    183: "servo",
    184: "servo",
    189: "landing sequence marker",
    195: "region of interest",
    196: "region of interest",
    197: "region of interest",
    201: "region of interest",
    **dict.fromkeys((200, 202, 203, 205, 206, 214, 530, 531, 532, 2000, 2001, 2500, 2501), "camera"),
    211: "gripper",
    5000: "fence return point",
    5002: "exclusion fence",
    5003: "inclusion circle",
    5004: "exclusion circle",
    5100: "rally point",
}
#: Later commands that are refused because they move the vehicle.
_MOVING = {
    177: "jump",
    190: "rally landing",
    191: "go-around",
    192: "reposition",
    194: "reverse",
    213: "yaw and speed",
    224: "mission jump",
    252: "override",
    601: "jump to a tag",
}
_CONVERT = dict.fromkeys(
    (177, 601), "waypoints written out, or `closed: true` and `repeat: N` in the mission file"
)
_DELETE = "waypoints only (commands 16 and 82): delete the item, or put waypoints in its place"


class Item(NamedTuple):
    """One mission item.

    Attributes:
        label: its number in the file.
        command: MAV_CMD.
        frame: MAV_FRAME.
        params: seven values; the fifth to seventh are latitude, longitude (deg) and height (m).
        goes_on: whether the mission continues after it without the operator.
    """

    label: str
    command: Any
    frame: Any
    params: Any
    goes_on: bool = True

    def value(self, index: int) -> float:
        """Return a parameter; 0 where it is left empty.

        Raises:
            ConfigurationError: it is not a number.
        """
        try:
            given = self.params[index]
            value = 0.0 if given is None else number(given)
        except (IndexError, KeyError, TypeError, ValueError):
            raise ConfigurationError(
                f"item {self.label}", f"no number as parameter {index + 1}", "one"
            ) from None
        return 0.0 if math.isnan(value) else value


def follow(items: Iterable[Item], content: Content) -> None:
    """Add the line through a list of items, the one speed along it, and its inclusion fences.

    A command that would lead the vehicle elsewhere becomes the line's `refusal`; any other that is not taken
    gets a notice.
    """
    walk = _Walk()
    refusal = None
    try:
        for item in items:
            if item.command == _FENCE_VERTEX:
                walk.corners.append(_position(item))
                if len(walk.corners) >= item.value(0):
                    content.fences.append(shape("polygon", f"fence {len(content.fences) + 1}", walk.corners))
                    walk.corners = []
            else:
                walk.take(item)
    except ConfigurationError as error:
        refusal = error
    content.speed = walk.whole_speed()
    notices = walk.notices()
    if not walk.points and refusal is None:
        content.notices += notices
        return
    points, heights = tuple(walk.points), heights_of(walk.heights)
    made = FileShape("line", "mission", points, 0, heights, False, walk.reference, tuple(notices), refusal)
    content.add([made])


@dataclass
class _Walk:
    points: list[Point] = field(default_factory=list)
    heights: list[float] = field(default_factory=list)
    reference: str = ""
    corners: list[list[float]] = field(default_factory=list)
    speeds: list[tuple[int, float, str]] = field(default_factory=list)
    left_out: dict[str, list[str]] = field(default_factory=dict)
    end: tuple[str, str] | None = None

    def take(self, item: Item) -> None:
        """Take one item.

        Raises:
            ConfigurationError: it would lead the vehicle elsewhere.
        """
        command = item.command
        if not isinstance(command, int) or isinstance(command, bool):
            raise ConfigurationError(f"item {item.label}", f"command {command!r:.40}", "a number (MAV_CMD)")
        if command in _PASSED:
            self._pass(item)
        elif command == _SPEED:
            self._change_speed(item)
        elif command in _LEFT_OUT:
            self._leave_out(_LEFT_OUT[command], item)
        elif command <= _LAST_NAVIGATION or command in _MOVING:
            word = f" ({_MOVING[command]})" if command in _MOVING else ""
            found = f"command {command}{word}"
            raise ConfigurationError(f"item {item.label}", found, _CONVERT.get(command, _DELETE))
        else:
            self._leave_out(f"command {command}", item)
        if command in _ENDS:
            self.end = self.end or (_ENDS[command], item.label)

    def _pass(self, item: Item) -> None:
        if self.end is not None:
            what, label = self.end
            found = f"a waypoint behind item {label}, {what}, where the mission ends"
            raise ConfigurationError(
                f"item {item.label}", found, "waypoints up to there: delete one of the two"
            )
        latitude, longitude, height = _position(item)
        self.points.append((latitude, longitude))
        self.heights.append(height)
        if item.frame in (10, 11) and height < 0.0:
            self.reference = self.reference or f"over the terrain (item {item.label})"
        if item.command == _WAYPOINT and item.value(0) > 0.0:
            self._leave_out(f"hold of {item.value(0):g} s", item)
        if _PASSED[item.command]:
            self._leave_out(_PASSED[item.command], item)
        if not item.goes_on:
            self._leave_out("stop until the operator goes on", item)

    def _change_speed(self, item: Item) -> None:
        speed = item.value(1)
        if item.value(0) in (0.0, 1.0) and speed > 0.0:
            self.speeds.append((len(self.points), speed, item.label))
        elif speed > 0.0:
            self._leave_out("climb or descent speed", item)

    def _leave_out(self, what: str, item: Item) -> None:
        self.left_out.setdefault(what, []).append(item.label)

    def whole_speed(self) -> float | None:
        """Return the speed from the first waypoint to the last, if it is constant."""
        if any(passed > 1 for passed, _, _ in self.speeds):
            return None
        return self.speeds[-1][1] if self.speeds else None

    def notices(self) -> list[str]:
        """List what is not taken, one line for each kind."""
        kinds = list(self.left_out.items())
        found = [f"{what} ({_numbered(labels)}) not taken" for what, labels in kinds[:_MOST_KINDS]]
        if len(kinds) > _MOST_KINDS:
            found.append(f"{len(kinds) - _MOST_KINDS} other kinds of commands not taken")
        if self.speeds and self.whole_speed() is None:
            changes = listed(f"to {speed:g} m/s (item {label})" for _, speed, label in self.speeds)
            found.append(f"speed change {changes} not taken: a mission has one speed")
        return found


def _numbered(labels: list[str]) -> str:
    return f"item{'s' * (len(labels) > 1)} {listed(labels)}"


def _position(item: Item) -> list[float]:
    """[latitude, longitude, height]."""
    if isinstance(item.frame, bool) or item.frame not in _GLOBAL_FRAMES:
        expected = "latitude and longitude (MAV_FRAME_GLOBAL...)"
        raise ConfigurationError(f"item {item.label}", f"frame {item.frame!r:.40}", expected)
    try:
        latitude, longitude = number(item.params[4]), number(item.params[5])
    except (IndexError, KeyError, TypeError, ValueError):
        raise ConfigurationError(f"item {item.label}", "no position", "latitude and longitude") from None
    if latitude == 0.0 and longitude == 0.0:
        found = "latitude 0, longitude 0, which autopilots read as `where the vehicle is`"
        raise ConfigurationError(f"item {item.label}", found, "a position, or no such item")
    has_height = len(item.params) > 6 and item.params[6] is not None
    return [latitude, longitude, item.value(6) if has_height else math.nan]
