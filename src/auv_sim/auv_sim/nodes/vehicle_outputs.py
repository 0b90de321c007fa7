"""The messages that the simulator publishes at each step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import fill_current, fill_odometry, fill_water_velocity, set_stamp
from auv_msgs_py.contract.frames import is_ned
from auv_msgs_py.contract.spatial_conversions import (
    fill_spatial_current,
    fill_spatial_odometry,
    fill_spatial_water,
)
from auv_msgs_py.contract.wire import Clock, Float64, Odometry, TwistWithCovarianceStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_sim.nodes.reported_covariance import ReportedCovariances
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.simulated import SimulatedVehicle


class VehicleOutputs:
    """Fills and publishes /clock, the vehicle's topics and the simulator's truth.

    Args:
        node: the simulator; its parameters name the frames.
        sea: whose errors the navigation has: the true odometry is published as well, and covariances are
            reported. None: without errors.
        dives: whether the vehicle has stern planes.
    """

    def __init__(self, node: SuiteNode, sea: Sea | None, dives: bool = False) -> None:
        p = node.parameters
        self._covariances = (
            None if sea is None else ReportedCovariances(sea.sensors, dives, is_ned(p.world_frame))
        )
        self._clock, self._rudder = Clock(), Float64()
        self._odometry = Odometry(p.world_frame, p.body_frame)
        self._truth = Odometry(p.world_frame, p.body_frame) if sea is not None else None
        self._water, self._true_current = TwistWithCovarianceStamped(p.body_frame), Vector3Stamped()
        # In free running the fleet's /clock drives the vehicle, which then publishes none.
        clock = topics.VEHICLE_CLOCK if p.shared_clock else topics.CLOCK
        has_clock = p.lockstep or not p.shared_clock
        self._outputs: list[tuple[Any, Any]] = [
            (node.advertise(topic), message)
            for topic, message in (
                (clock, self._clock if has_clock else None), (topics.ODOM, self._odometry),
                (topics.WATER_VELOCITY, self._water), (topics.RUDDER_STATE, self._rudder),
                (topics.TRUE_CURRENT, self._true_current), (topics.TRUE_ODOM, self._truth),
            )
            if message is not None
        ]  # fmt: skip

    def fill(self, vehicle: SimulatedVehicle, at_rest: bool, stamp: int) -> None:
        """Fill the messages with the vehicle's present state.

        Args:
            vehicle: the simulated vehicle.
            at_rest: whether it is held over ground before the mission.
            stamp: ns.
        """
        set_stamp(self._clock.clock, stamp)
        u, v = (0.0, 0.0) if at_rest else vehicle.ground_velocity
        water = vehicle.passing_water if at_rest else vehicle.water_velocity
        fill_odometry(self._odometry, vehicle.navigation, u, v, stamp)
        fill_water_velocity(self._water, water, stamp)
        self._fill_covariances(vehicle, (u, v), water)
        self._rudder.data = vehicle.rudder
        fill_current(self._true_current, vehicle.current, stamp)
        if self._truth is not None:
            fill_odometry(self._truth, *vehicle.truth, stamp)

    def _fill_covariances(self, vehicle: Any, velocity: Sequence[float], water: Sequence[float]) -> None:
        if self._covariances is not None:
            self._odometry.pose.covariance = self._covariances.pose(vehicle)
            self._odometry.twist.covariance = self._covariances.twist(velocity)
            self._water.twist.covariance = self._covariances.water(water)

    def publish(self, with_water_velocity: bool) -> None:
        """Publish the filled messages, the velocity through the water only where it was measured."""
        for publisher, message in self._outputs:
            if with_water_velocity or message is not self._water:
                publisher.publish(message)


class SpatialVehicleOutputs(VehicleOutputs):
    """The same for a vehicle that dives; its altitude is published only with an altimeter.

    Args:
        node, sea: as those of `VehicleOutputs`.
        with_altitude: whether there is an altimeter.
    """

    def __init__(self, node: SuiteNode, sea: Sea | None, with_altitude: bool) -> None:
        super().__init__(node, sea, dives=True)
        self._planes = Float64()
        self._outputs.append((node.advertise(topics.STERNPLANE_STATE), self._planes))
        self._range: Any = None
        if with_altitude:
            from sensor_msgs.msg import Range

            self._range = Range(radiation_type=Range.ULTRASOUND)
            self._range.header.frame_id = node.parameters.body_frame
            self._outputs.append((node.advertise(topics.ALTITUDE), self._range))

    def fill(self, vehicle: Any, at_rest: bool, stamp: int) -> None:
        set_stamp(self._clock.clock, stamp)
        velocity = (0.0, 0.0, 0.0) if at_rest else vehicle.ground_velocity
        roll_rate = vehicle.motion.p
        fill_spatial_odometry(self._odometry, vehicle.navigation, velocity, roll_rate, stamp)
        water = vehicle.passing_water if at_rest else vehicle.water_velocity
        fill_spatial_water(self._water, water, stamp)
        self._fill_covariances(vehicle, velocity, water)
        self._rudder.data, self._planes.data = vehicle.rudder, vehicle.sternplanes
        fill_spatial_current(self._true_current, vehicle.current, stamp)
        if self._truth is not None:
            navigation, *velocity = vehicle.truth
            fill_spatial_odometry(self._truth, navigation, tuple(velocity), roll_rate, stamp)
        if self._range is not None:
            set_stamp(self._range.header.stamp, stamp)
            self._range.range = vehicle.altitude


def outputs_of(node: SuiteNode, simulated: Any, sea: Sea | None) -> VehicleOutputs:
    """Return the outputs of a simulated vehicle in a sea; an altimeter is one whose range is not NaN."""
    if isinstance(simulated, SimulatedDiver):
        return SpatialVehicleOutputs(node, sea, not math.isnan(simulated.altitude))
    return VehicleOutputs(node, sea)
