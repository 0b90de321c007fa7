"""Flights of the study: limit cycles on a line from four starts, and three courses in two waters."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from auv_msgs_py.values.types import Current
from auv_path_following.guidance.switching import with_overrides
from auv_path_following.missions import mission_file
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.trial_flights import LINE, Flight, line_time, start_at, thrust_of, with_laws
from auv_sim.studies.gains.study_hulls import late

#: Missions by which gains are compared, and the current of the second water (east), m/s.
MISSIONS = ("paper_composite", "course_linear", "survey_wgs84")
CURRENT = 0.39
#: Times between two odometries, s.
STEPS = (0.1, 0.05, 0.02)
#: y (m), heading (deg), yaw rate (rad/s): beside the line, across it, turning, astern.
STARTS = ((8.0, 0.0, 0.0), (0.0, 90.0, 0.0), (0.0, 0.0, 0.4), (20.0, 180.0, 0.0))

_courses = Courses()


class Figures(NamedTuple):
    """Of one flight along a course: rms, rms away from corners (m), travel of the rudder (deg/m)."""

    rms: float
    off: float
    travel: float
    completed: bool


def unrest(hull: Vehicle, delay: float, step: float, gains: GainSet) -> float:
    """Return the rms yaw rate in the second half of a flight on a line, deg/s: the worst of four starts.

    Args:
        hull: the plant, whose dead time is replaced.
        delay: dead time, s.
        step: between two odometries, s.
        gains: to fly with.
    """
    plant, thrust = late(hull, delay), thrust_of(hull)
    speed = hull.speed_at(thrust)
    flights = [
        Flight(
            Scenario(
                path=LINE, vehicle=plant, thrust=thrust, step=step, time_limit=line_time(hull),
                initial=start_at(hull, y, math.radians(heading), speed, rate),
            ),
            True,
        )
        for y, heading, rate in STARTS
    ]  # fmt: skip
    found = engine.fly([with_laws(flight, gains, hull) for flight in flights], courses=_courses)
    return float(np.max(np.nan_to_num(found.late_rms_yaw_rate, nan=math.inf)))


def fly_courses(hull: Vehicle, gains: GainSet, threads: int = 1) -> dict[tuple[str, bool], Figures]:
    """Fly the missions in still water and in a current; return figures by (mission, in the current)."""
    thrust = thrust_of(hull)
    scenarios, keys = [], []
    for name in MISSIONS:
        mission = _mission(name)
        own = mission.switching
        switching = with_overrides(gains.guidance.switching, own.mode, own.radius)
        guidance = dataclasses.replace(gains.guidance, switching=switching)
        for flowing in (False, True):
            current = Current(0.0, CURRENT if flowing else 0.0)
            scenarios.append(
                Scenario(
                    path=mission.path, vehicle=hull, thrust=thrust, current=current, guidance=guidance,
                    autopilot=gains.autopilot, pitch=gains.pitch, time_limit=4000.0,
                )
            )  # fmt: skip
            keys.append((name, flowing))
    found = engine.fly(scenarios, threads, courses=_courses)
    return {
        key: Figures(
            float(found.rms_distance[k]), float(found.off_corners_rms_distance[k]),
            float(found.rudder_travel_per_metre[k]), bool(found.completed[k]),
        )
        for k, key in enumerate(keys)
    }  # fmt: skip


_missions: dict[str, mission_file.Mission] = {}


def _mission(name: str) -> mission_file.Mission:
    if name not in _missions:
        _missions[name] = mission_file.load(name)
    return _missions[name]
