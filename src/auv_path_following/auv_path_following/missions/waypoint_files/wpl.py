"""QGC WPL 110: the text files of Mission Planner, MAVProxy and older QGroundControl."""

from __future__ import annotations

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.waypoint_files.content import Content, bounded, decimal
from auv_path_following.missions.waypoint_files.mavlink_items import Item, follow

_HEAD = b"QGC WPL"
_FORMAT = "QGC WPL 110 (positions alone: a .csv file with a header)"
_COLUMNS = 12


def read(data: bytes) -> Content:
    """Read the mission; item 0 in MAV_FRAME_GLOBAL is the home position, which is not flown.

    Raises:
        ConfigurationError: it is another format, or a line is wrong.
    """
    if not data.startswith(_HEAD):
        raise ConfigurationError("line 1", f"{data[:40].decode('ascii', 'replace')!r}", _FORMAT)
    content = Content()
    items: list[Item] = []
    for number, line in enumerate(bounded(data.decode("utf-8", "replace").splitlines()), start=1):
        if number == 1 or not line.strip() or line.lstrip().startswith("#"):
            continue
        item = _item(number, line)
        if not items and item.label == "0" and (item.command, item.frame) == (16, 0):
            content.notices.append("home position (item 0) not taken")
            continue
        items.append(item)
    follow(items, content)
    return content


def _item(number: int, line: str) -> Item:
    columns = line.split()
    try:
        if len(columns) != _COLUMNS:
            raise ValueError
        index, _, frame, command = (int(decimal(column)) for column in columns[:4])
        params = [decimal(column) for column in columns[4:11]]
        return Item(str(index), command, frame, params, decimal(columns[11]) != 0.0)
    except (OverflowError, ValueError):
        expected = f"{_COLUMNS} numbers: index, current, frame, command, 7 parameters, autocontinue"
        raise ConfigurationError(f"line {number}", f"{line.strip()[:60]!r}", expected) from None
