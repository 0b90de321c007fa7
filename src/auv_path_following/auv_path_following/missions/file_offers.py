"""Speed and geofence that a waypoint file contains beside the route."""

from __future__ import annotations

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions.site import Point, Site


def speed(site: Site, thrust: float | None, asked: float | None) -> float | None:
    """Return the mission's speed through the water, m/s: its own, else that of its waypoint file.

    Args:
        site: with the files read.
        thrust: of the mission, N; it excludes a speed.
        asked: speed of the mission, m/s.

    Raises:
        ConfigurationError: neither the mission nor a file has one.
    """
    offers = {path.name: content.speed for path, content in site.files.items() if content.speed is not None}
    for name, offered in offers.items():
        if thrust is None and asked is None:
            site.note(f"{name}: its speed of {offered:g} m/s is taken, as speed through the water")
            return offered
        if offered != asked:
            site.note(f"{name}: its speed of {offered:g} m/s not taken: the mission file has its own")
    if thrust is None and asked is None:
        found = "0 of thrust and speed, nor one speed in the waypoint file"
        raise ConfigurationError("", found, "exactly one of thrust, speed")
    return asked


def geofence(site: Site) -> list[Point]:
    """Return the corners (north, east), m, of the one inclusion fence of the route's file; empty without."""
    for path, content in list(site.files.items()):
        name = path.relative_to(site.folder).as_posix()
        if len(content.fences) == 1:
            site.note(f"{name}: its inclusion fence is taken as geofence")
            return site.read(name, "geofence").points
        if content.fences:
            names = ", ".join(repr(fence.name) for fence in content.fences)
            site.note(f"{name}: {len(content.fences)} inclusion fences not taken: name one as `geofence:"
                      f" {{file: {name}, feature: ...}}` ({names})")  # fmt: skip
    return []


def leave_geofence(site: Site, taken: str = "") -> None:
    """Note the inclusion fences that the mission's own geofence replaces.

    Args:
        site: with the files that were read.
        taken: file of the geofence; empty where its corners are in the mission file.
    """
    for path, content in site.files.items():
        if content.fences and path != site.folder / taken:
            site.note(f"{path.name}: its inclusion fence not taken: the mission file has its own geofence")
