"""Fly a hundred random starts and currents with the batch engine (compiled where Numba is installed)."""

import dataclasses
import math

import numpy as np

from auv_msgs_py.values.types import Current
from auv_sim.flight.batch import engine
from auv_sim.launch.mission_plan import scenario
from auv_sim.launch.options import Options
from auv_sim.vehicle.remus import PlantState

nominal = scenario(Options(mission="course_fermat"))
x, y, chi = nominal.path.start_pose
rng = np.random.default_rng(seed=1)
flights = []
for _ in range(100):
    course, speed = rng.uniform(-math.pi, math.pi), rng.uniform(0.0, 0.4)
    start = PlantState(*rng.normal((x, y), 10.0), chi + rng.normal(0.0, 1.0), 1.9, 0.0, 0.0)
    current = Current(speed * math.cos(course), speed * math.sin(course))
    flights.append(dataclasses.replace(nominal, initial=start, current=current))

figures = engine.fly(flights, threads=2)
print(f"{figures.completed.sum()} of {len(flights)} completed")
print(f"time to the path: median {np.median(figures.time_to_path):.1f} s")
print(f"largest distance after that: worst {figures.late_largest_distance.max():.2f} m")
