"""The columns of the console's rows: one table for server, page and recordings of a track."""

from __future__ import annotations

from typing import NamedTuple


class TrackColumn(NamedTuple):
    """One column.

    Attributes:
        name: in messages.
        unit: SI; empty for none.
        label: for people.
    """

    name: str
    unit: str
    label: str


#: In the order of the values of a row. A value that is not measured is NaN.
COLUMNS = (
    TrackColumn("t", "s", "time since the first row"),
    TrackColumn("x", "m", "east"),
    TrackColumn("y", "m", "north"),
    TrackColumn("z", "m", "up"),
    TrackColumn("yaw", "rad", "yaw, counter-clockwise from east"),
    TrackColumn("pitch", "rad", "pitch, bow up"),
    TrackColumn("u", "m/s", "speed through the water"),
    TrackColumn("ve", "m/s", "velocity over ground, east"),
    TrackColumn("vn", "m/s", "velocity over ground, north"),
    TrackColumn("xe", "m", "along-track error"),
    TrackColumn("ye", "m", "cross-track error, starboard"),
    TrackColumn("ze", "m", "vertical error, below the path"),
    TrackColumn("s", "m", "place along the path"),
    TrackColumn("rudder", "rad", "rudder command, to port"),
    TrackColumn("planes", "rad", "stern plane command, bow down"),
    TrackColumn("thrust", "N", "thrust command"),
    TrackColumn("yaw_ref", "rad", "desired yaw"),
    TrackColumn("pitch_ref", "rad", "desired pitch, bow up"),
    TrackColumn("depth_ref", "m", "desired depth"),
    TrackColumn("current_east", "m/s", "current, east"),
    TrackColumn("current_north", "m/s", "current, north"),
    TrackColumn("altitude", "m", "altitude above the bottom"),
    TrackColumn("true_x", "m", "true east"),
    TrackColumn("true_y", "m", "true north"),
    TrackColumn("true_z", "m", "true up"),
)
NAMES = tuple(column.name for column in COLUMNS)
#: Columns that every odometry fills.
OF_ODOMETRY = ("x", "y", "z", "yaw", "pitch", "ve", "vn")
#: Name -> position in a row.
PLACE = {name: k for k, name in enumerate(NAMES)}
