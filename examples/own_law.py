"""Try a guidance law of your own on the simulated hull, before it is registered: pure pursuit of a line."""

import math

from auv_msgs_py.values.types import Current, Navigation, Reference
from auv_path_following import vehicle
from auv_path_following.control import autopilot
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

DT, THRUST = 0.05, 6.48  # s, N


def my_law(navigation: Navigation, lookahead: float = 8.0) -> float:
    """Return psi_d (rad): aim at the point of the line east = 0 that lies `lookahead` m ahead."""
    return math.atan2(-navigation.y, lookahead)


hull = vehicle.load("remus100")
boat = SimulatedVehicle(hull, PlantState(0.0, 15.0, 0.0, 1.9, 0.0, 0.0), current=Current(0.0, 0.1))
gains = autopilot.prepare(autopilot.AutopilotConfig(), hull)
state = autopilot.first_state(gains)
for step in range(1800):
    navigation = boat.seen.navigation
    reference = Reference(my_law(navigation), 0.0, THRUST)
    state, command, _ = autopilot.steer(gains, state, navigation, reference, DT)
    if step % 300 == 0:
        print(f"{step * DT:5.1f} s  {navigation.y:6.2f} m starboard of the line")
    boat.advance(command, DT)
print(f"left by the current, which this law ignores: {boat.motion.y:.2f} m")
