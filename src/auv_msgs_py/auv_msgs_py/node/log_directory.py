"""Directory of ROS's log files. ROS-free."""

from __future__ import annotations

import os
import tempfile

#: Environment variables that decide where ROS puts its log files; the first that is set counts.
_LOG_PLACES = ("ROS_LOG_DIR", "ROS_HOME", "HOME")


def ensure_log_directory() -> None:
    """Set a temporary directory for ROS's log files where there is no other: without one ROS does not start.

    A service under systemd has no HOME, or one without write permission.
    """
    place = next(filter(None, map(os.environ.get, _LOG_PLACES)), None)
    if place is None or (place == os.environ.get("HOME") and not os.access(place, os.W_OK)):
        os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="auv-ros-log-")
