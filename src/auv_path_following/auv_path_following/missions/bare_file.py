"""A waypoint file instead of a mission file: the mission that is assumed around it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import waypoint_files

#: Assumed speed through the water, m/s.
SPEED = 1.5
#: Suffixes of waypoint files that mission files (YAML) may have too.
_AMBIGUOUS = (".json", ".txt")


def is_bare(source: Path) -> bool:
    """Return whether a file is a waypoint file."""
    suffix = source.suffix.lower()
    return suffix in waypoint_files.SUFFIXES and suffix not in _AMBIGUOUS


def notice(mission: dict[str, Any], source: Path, speed: float) -> str:
    """Return a line that says what is assumed.

    Args:
        mission: as `assumed` returns it.
        source: the waypoint file.
        speed: flown through the water, m/s.
    """
    words = ["straight legs (smoothing linear)", f"speed {speed:g} m/s"]
    if origin := mission.get("origin"):
        words.append(f"origin [{origin['latitude_deg']:g}, {origin['longitude_deg']:g}]")
    return f"{source.name} is not a mission file; assumed: {', '.join(words)}"


def assumed(source: Path) -> dict[str, Any]:
    """Return a mission with straight legs between the waypoints, at the file's speed or `SPEED`.

    Raises:
        ConfigurationError: the file cannot be read, or holds no single route.
    """
    content = waypoint_files.read(source)
    try:
        first, *_ = waypoint_files.choose(content, "waypoints").points
    except ConfigurationError as error:
        where = f"{source}: {error.where}" if error.where else str(source)
        raise ConfigurationError(where, error.found, error.expected) from None
    mission: dict[str, Any] = {
        "version": 1,
        "name": source.stem,
        "frame": "wgs84" if content.in_degrees else "ned",
    }
    if content.in_degrees:
        mission["origin"] = {"latitude_deg": first[0], "longitude_deg": first[1]}
    if content.speed is None:
        mission["speed"] = SPEED
    return mission | {"waypoints": {"file": source.name, "smoothing": {"kind": "linear"}}}
