"""What the report's page has of a vehicle that dives: columns, and the view in three dimensions."""

from __future__ import annotations

import base64
import contextlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.recorded_mission import RecordedMission, configuration
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import Bag
from auv_sim.flight.figures.mission_summary import SpatialMissionSummary, SpatialSubpathSummary
from auv_sim.flight.path_cells import metres_of
from auv_sim.flight.run_record import SpatialRun
from auv_sim.vehicle import sea
from auv_sim.vehicle.diving.bottom import Bottom, bottom_at, bottom_of
from auv_sim.vehicle.draws import Draws

#: Of a sea's bottom, this many rows and columns are drawn.
_MESH = 24
#: A path is drawn with points this far apart, m.
_SPACING = 1.0

Column = NDArray[np.float64]


def packed(values: Column) -> str:
    """Return numbers as the page reads them."""
    return base64.b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode()


def spatial_columns(flight: RecordedMission) -> dict[str, Column]:
    """Return the derived columns of a run in three dimensions, in the units of the page."""
    run, spatial = flight.run, flight.spatial
    assert isinstance(run, SpatialRun)
    columns = {"depth": run.depth, "depth_d": run.depth_d}
    if np.isfinite(run.theta_true).any():
        columns["track_theta"] = np.degrees(np.where(np.isfinite(run.theta_true), run.theta_true, run.theta))
    bottom = run.bottom
    if np.isfinite(bottom).any():
        columns["bottom"] = bottom
    if flight.mission is None or not np.isfinite(run.s).any():
        return columns
    if flight.mission.altitude is not None:
        columns |= {"ze": np.full(run.steps, np.nan), "depth_error": run.depth - run.depth_d}
    elif spatial is not None:
        away, depth = spatial.closest(*run.track, run.depth, run.subpath(spatial.n))
        columns |= {"distance": away, "depth_path": depth, "depth_error": run.depth - depth}
    way = metres_of(spatial or flight.mission.path, np.nan_to_num(run.s))
    return columns | {"way": np.maximum.accumulate(way)}


def space(flight: RecordedMission, columns: dict[str, Column]) -> dict[str, Any] | None:
    """Return what the view in three dimensions needs beside the columns; None without a track with depths."""
    run = flight.run
    if not isinstance(run, SpatialRun) or not np.isfinite(run.depth).any():
        return None
    bottom = None
    if "bottom" in columns:
        heard = np.isfinite(columns["bottom"])
        place = (*run.track, columns["bottom"])
        bottom = dict(zip("xyz", (packed(axis[heard]) for axis in place), strict=True))
    points = None
    if flight.spatial is not None:
        points = flight.spatial.polyline(_SPACING)[:3]
    elif flight.mission is None:
        points = published_path(flight.bag)
    path = points and dict(zip("xyz", map(packed, points), strict=True))
    colours = [
        {"name": "distance", "label": "distance to the path", "unit": "m", "signed": False},
        {"name": "depth_error", "label": "depth error, below is positive", "unit": "m", "signed": True},
        {"name": "ze", "label": "error ze of guidance", "unit": "m", "signed": True},
    ]
    shown = [colour for colour in colours if colour["name"] in columns]
    return {"path": path, "bottom": bottom, "mesh": _mesh(flight, run), "colours": shown}


def published_path(bag: Bag) -> tuple[Column, Column, Column] | None:
    """Return north, east and depth of the path that guidance published, m; None where it is not recorded."""
    try:
        topic = bag.find(topics.PATH.name)
        messages = messages_of(topic) if topic is not None and topic.type == topics.PATH.type else []
    except ConfigurationError:
        return None
    if not messages:
        return None
    points = [pose.pose.position for pose in messages[-1][1].poses]
    return np.array([p.y for p in points]), np.array([p.x for p in points]), np.array([-p.z for p in points])


def _mesh(flight: RecordedMission, run: SpatialRun) -> dict[str, Any] | None:
    """Return the bottom of the recorded sea around the track, if it has one."""
    x, y = (axis[np.isfinite(axis)] for axis in run.track)
    bottom = _sea_bottom(flight)
    if bottom is None or not x.size:
        return None
    margin = max(5.0, 0.1 * max(np.ptp(x), np.ptp(y)))
    north, east = (np.linspace(axis.min() - margin, axis.max() + margin, _MESH) for axis in (x, y))
    z = np.array([[bottom_at(bottom, float(n), float(e)) for e in east] for n in north])
    return {"n": north.tolist(), "e": east.tolist(), "z": packed(z.ravel())} if np.isfinite(z).all() else None


def _sea_bottom(flight: RecordedMission) -> Bottom | None:
    with configuration(flight.bag) as directory, contextlib.suppress(ConfigurationError):
        if (directory / "sea.yaml").exists():
            return bottom_of(sea.load(str(directory / "sea.yaml")).bottom, Draws(1.0, 1))
    return None


def depth_figures(part: object) -> list[float]:
    """Return the further figures of a row of the page's table: rms and largest depth error, m."""
    if isinstance(part, SpatialMissionSummary | SpatialSubpathSummary):
        return [part.rms_depth_error, part.largest_depth_error]
    return []
