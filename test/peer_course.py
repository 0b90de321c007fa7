"""The course on which the REMUS 100 of MSS is demonstrated: its current, and distances to its legs."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.settings.schema import validated
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.sea import Sea

PEER = vehicle.load("mss_remus100")
COURSE = mission_file.load("mss_course", PEER).spatial
assert COURSE is not None
#: Corners, north, east, down, m.
CORNERS = np.array(
    [COURSE.evaluate(0, 0.0)[:3], *(COURSE.evaluate(i, 1.0)[:3] for i in range(COURSE.n))], np.float64
)


def drift(t: float) -> tuple[float, float, float]:
    """The current at t s: 0.5 m/s towards 150 deg, from 500 s 160 deg, from 800 s 0.65 m/s; 0.1 m/s down."""
    towards, speed = math.radians(150.0 if t < 500.0 else 160.0), 0.5 if t < 800.0 else 0.65
    return speed * math.cos(towards), speed * math.sin(towards), 0.1


def course_sea() -> Sea:
    """The current as a schedule; nothing else is imperfect."""
    times = (0.0, 499.99, 500.0, 799.99, 800.0)
    rows = [[t, *drift(t)] for t in times]
    return validated(Sea, {"name": "course", "current": {"schedule": rows}}, "course")


def course_start(speed: float = 1.0) -> BodyState:
    """On the first corner, along the first leg."""
    x, y, z, gamma, chi = COURSE.start_pose
    return body_at(x, y, z, 0.0, gamma, chi, speed)


def distances(x: Any, y: Any, z: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the distance to the legs, and the depth error at the horizontally closest point, m."""
    places = np.column_stack([x, y, z])
    near, flat = np.full(len(places), np.inf), np.full(len(places), np.inf)
    depth = np.zeros(len(places))
    for a, b in itertools.pairwise(CORNERS):
        leg = b - a
        share = np.clip((places - a) @ leg / (leg @ leg), 0.0, 1.0)
        near = np.minimum(near, np.linalg.norm(a + share[:, None] * leg - places, axis=1))
        share = np.clip((places[:, :2] - a[:2]) @ leg[:2] / (leg[:2] @ leg[:2]), 0.0, 1.0)
        offset = np.linalg.norm(a[:2] + share[:, None] * leg[:2] - places[:, :2], axis=1)
        closer = offset < flat
        flat[closer] = offset[closer]
        depth[closer] = (places[:, 2] - a[2] - share * leg[2])[closer]
    return near, depth


def rms(values: Any) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))
