"""The emulated vehicle that dives: depth, attitude, stern planes and altimeter in its messages. ROS-free."""

from __future__ import annotations

import math
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.attitude import quaternion_of
from auv_msgs_py.values.types import Current, SpatialCurrent
from auv_path_following.vehicle import Vehicle
from auv_sim.nodes.mavlink.emulated_vehicle import ALTITUDE, Emulator
from auv_sim.nodes.mavlink.mapping import pulse_of, water_track
from auv_sim.nodes.mavlink.soundings import distance_sensor
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at, to_world
from auv_sim.vehicle.remus import PlantState


class DivingEmulator(Emulator):
    """A vehicle with stern planes, driven as `Emulator`.

    Args:
        hull, initial, current: as those of `Emulator`.
        bottom: depth of a level bottom, m; 0: no altimeter.
    """

    def __init__(self, hull: Vehicle, initial: BodyState, current: SpatialCurrent, bottom: float) -> None:
        super().__init__(hull, initial, current)
        self._bottom = bottom
        if bottom > 0.0:
            self.kinds["altitude"] = ALTITUDE

    def _attitude(self) -> Any:
        state, n = self.plant.motion, self.plant.navigation
        rates = (0.0, 0.0, 0.0) if self.in_tube else (state.p, state.q, state.r)
        psi = math.remainder(n.psi, math.tau)
        return mavlink.MAVLink_attitude_message(self.now_ms, n.phi, n.theta, psi, *rates)

    def _position(self) -> Any:
        n = self.plant.navigation
        velocity = (0.0, 0.0, 0.0) if self.in_tube else self.plant.ground_velocity
        over_ground = to_world(*quaternion_of(n.phi, n.theta, n.psi), *velocity)
        return mavlink.MAVLink_local_position_ned_message(self.now_ms, n.x, n.y, n.z, *over_ground)

    def _water(self) -> Any:
        velocity = (0.0, 0.0, 0.0) if self.in_tube else self.plant.water_velocity
        return water_track(self.now_ms * 1000, *velocity)

    def _servo(self) -> Any:
        assert self.limits.sternplanes is not None  # without stern planes it is no vehicle that dives
        pulses = (
            pulse_of(self.plant.rudder, self.limits.rudder),
            pulse_of(self.plant.sternplanes, self.limits.sternplanes),
        )
        return mavlink.MAVLink_servo_output_raw_message(self.now_ms * 1000 % 2**32, 0, *pulses, *[0] * 6)

    def _altitude(self) -> Any:
        """Return the range to the bottom along body z; where the beam misses it, the largest range."""
        n = self.plant.navigation
        down = math.cos(n.phi) * math.cos(n.theta)
        distance = (self._bottom - n.z) / down if down > 0.0 else math.inf
        return distance_sensor(self.now_ms, distance)


def emulator_of(
    hull: Vehicle,
    initial: tuple[float, float, float, float, float],
    surge: float,
    current: SpatialCurrent,
    bottom: float = 0.0,
) -> Emulator:
    """Return the emulated vehicle of a hull.

    Args:
        hull: of the plant; one with stern planes dives.
        initial: north, east, depth (m), pitch and heading (rad).
        surge: its speed through the water at the first thrust, m/s.
        current: of the water, m/s, NED.
        bottom: depth of the bottom, m; 0: no altimeter.
    """
    x, y, z, theta, psi = initial
    if hull.dives:
        return DivingEmulator(hull, body_at(x, y, z, 0.0, theta, psi, surge), current, bottom)
    return Emulator(hull, PlantState(x, y, psi, surge, 0.0, 0.0), Current(current.Vx, current.Vy))
