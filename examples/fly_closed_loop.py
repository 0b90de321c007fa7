"""Fly a shipped mission in a current, without ROS, and print its figures for each subpath."""

from auv_sim.flight.closed_loop import fly
from auv_sim.flight.metrics import summarise
from auv_sim.launch.mission_plan import scenario
from auv_sim.launch.options import Options

flight = scenario(Options(mission="paper_composite", current=(0.1, 0.2)))
summary = summarise(fly(flight), flight.path)
for part in summary.subpaths:
    print(
        f"{part.number} {part.kind:16} rms {part.rms_distance:.3f} m, largest {part.largest_distance:.3f} m"
    )
print(f"{summary.duration:.1f} s, at most {summary.largest_distance:.2f} m off the path")
