"""Where ROS puts its log files. ROS-free."""

from __future__ import annotations

import os
import tempfile

#: Where ROS puts its log files: the first of these that is set decides.
_LOG_PLACES = ("ROS_LOG_DIR", "ROS_HOME", "HOME")


def ensure_log_directory() -> None:
    """Give ROS's log files a temporary directory where they have none: without one ROS does not start.

    A service under systemd has no HOME, or one that it cannot write.
    """
    place = next(filter(None, map(os.environ.get, _LOG_PLACES)), None)
    if place is None or (place == os.environ.get("HOME") and not os.access(place, os.W_OK)):
        os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="auv-ros-log-")
