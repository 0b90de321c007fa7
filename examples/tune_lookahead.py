"""Choose the look-ahead distance for ideal sensors: fly a range of them in currents from four sides."""

import dataclasses

import numpy as np

from auv_msgs_py.values.types import Current
from auv_sim.flight.batch import engine
from auv_sim.launch.mission_plan import scenario
from auv_sim.launch.options import Options

nominal = scenario(Options(mission="course_fermat"))
lookaheads = np.arange(1.5, 8.1, 0.5)  # m
currents = [Current(0.3, 0.0), Current(-0.3, 0.0), Current(0.0, 0.3), Current(0.0, -0.3)]
flights = []
for lookahead in lookaheads:
    law = dataclasses.replace(nominal.guidance.ailos, lookahead=float(lookahead))
    guidance = dataclasses.replace(nominal.guidance, ailos=law)
    flights += [dataclasses.replace(nominal, guidance=guidance, current=current) for current in currents]

rms = engine.fly(flights, threads=2).rms_distance.reshape(len(lookaheads), -1)
for lookahead, row in zip(lookaheads, rms, strict=True):
    print(f"{lookahead:5.1f} m: rms distance {row.mean():.3f} m, worst current {row.max():.3f} m")
print(f"best: {lookaheads[rms.max(axis=1).argmin()]:.1f} m")
