"""The plant as a function from a state to the next one.

The same formulas in the same order as in `RemusPlant`; a test holds both together over whole missions.
"""

from __future__ import annotations

import math

from auv_msgs_py.types import Current
from auv_sim.batch.compiled import compiled
from auv_sim.batch.numbers import Plant
from auv_sim.batch.shared import derivative, moved
from auv_sim.plant.remus import PlantState


@compiled
def advance(
    c: Plant, state: PlantState, rudder: float, command: float, thrust: float, dt: float, current: Current
) -> tuple[PlantState, float]:
    """`RemusPlant.advance` with its `RudderServo`: the state and the rudder's angle after `dt` seconds."""
    target = min(max(command, -c.max_angle), c.max_angle)
    substeps = max(1, math.ceil(dt / c.max_step - 1e-9))
    h = dt / substeps
    for _ in range(substeps):
        reach_half, reach = c.max_rate * (0.5 * h), c.max_rate * h
        half = rudder + min(max(target - rudder, -reach_half), reach_half)
        end = rudder + min(max(target - rudder, -reach), reach)
        k1 = derivative(c.dynamics, state, rudder, thrust, current)
        k2 = derivative(c.dynamics, moved(state, k1, 0.5 * h), half, thrust, current)
        k3 = derivative(c.dynamics, moved(state, k2, 0.5 * h), half, thrust, current)
        k4 = derivative(c.dynamics, moved(state, k3, h), end, thrust, current)
        state = PlantState(
            state.x + h / 6.0 * (k1[0] + 2.0 * (k2[0] + k3[0]) + k4[0]),
            state.y + h / 6.0 * (k1[1] + 2.0 * (k2[1] + k3[1]) + k4[1]),
            state.psi + h / 6.0 * (k1[2] + 2.0 * (k2[2] + k3[2]) + k4[2]),
            state.ur + h / 6.0 * (k1[3] + 2.0 * (k2[3] + k3[3]) + k4[3]),
            state.vr + h / 6.0 * (k1[4] + 2.0 * (k2[4] + k3[4]) + k4[4]),
            state.r + h / 6.0 * (k1[5] + 2.0 * (k2[5] + k3[5]) + k4[5]),
        )
        rudder = end
    return state, rudder
