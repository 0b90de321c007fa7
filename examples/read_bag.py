"""Read a recording: python3 examples/read_bag.py RUN, with the directory of a mission."""

import sys
from pathlib import Path

import numpy as np

from auv_sim.bags.content.recorded_mission import mission_in
from auv_sim.bags.reading.bag_reader import read_bag

bag = read_bag(Path(sys.argv[1]) / "bag")
for name, topic in sorted(bag.topics.items()):
    print(f"{topic.count:7} {name}")

flight = mission_in(bag)
run, summary = flight.run, flight.summary
assert run is not None and summary is not None
print(f"rms cross-track error {np.sqrt(np.mean(run.ye**2)):.3f} m over {run.steps} steps")
print(f"largest distance {summary.largest_distance:.2f} m, flown {100 * summary.flown_share:.1f} %")
