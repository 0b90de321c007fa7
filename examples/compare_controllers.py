"""Compare the heading controllers on one mission in one current."""

import dataclasses

from auv_sim.flight.closed_loop import fly
from auv_sim.flight.metrics import summarise
from auv_sim.launch.mission_plan import scenario
from auv_sim.launch.options import Options

flight = scenario(Options(mission="course_fermat", current=(0.2, -0.1)))
print("controller   rms m   largest m   rudder deg/m")
for name in ("nism", "pid", "smc"):
    gains = dataclasses.replace(flight.autopilot, controller=name)
    s = summarise(fly(dataclasses.replace(flight, autopilot=gains)), flight.path)
    print(f"{name:10} {s.rms_distance:7.3f} {s.largest_distance:11.2f} {s.rudder_travel_per_metre:14.2f}")
