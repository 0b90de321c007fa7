"""Cover a polygon with a lawnmower survey and fly it."""

import dataclasses

from auv_path_following.curves.composite import CompositePath
from auv_path_following.missions.routes import survey
from auv_path_following.missions.routes.smoothing import Smoothing
from auv_sim.flight.closed_loop import fly
from auv_sim.flight.metrics import summarise
from auv_sim.launch.mission_plan import scenario
from auv_sim.launch.options import Options

polygon = [(0.0, 0.0), (90.0, 10.0), (100.0, 70.0), (20.0, 90.0)]  # north, east in m
legs = survey.legs(polygon, spacing=25.0, chi=0.0, run_out=5.0)
path = CompositePath(survey.path(legs, Smoothing(kind="dubins", radius=12.0)))

flight = dataclasses.replace(scenario(Options()), path=path, initial=None)  # from the path's start
summary = summarise(fly(flight), path)
print(f"{len(legs)} legs, {path.length:.0f} m, {summary.duration:.0f} s")
print(f"flown {100 * summary.flown_share:.1f} %, largest distance {summary.largest_distance:.2f} m")
