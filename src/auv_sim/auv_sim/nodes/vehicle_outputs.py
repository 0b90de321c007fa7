"""The messages that the simulator publishes at each step."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import fill_current, fill_odometry, fill_water_velocity, set_stamp
from auv_msgs_py.contract.wire import Clock, Float64, Odometry, TwistWithCovarianceStamped, Vector3Stamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_sim.vehicle.simulated import SimulatedVehicle


class VehicleOutputs:
    """Fills and publishes /clock, the vehicle's topics and the simulator's truth.

    Args:
        node: the simulator; its parameters name the frames.
        with_true_odometry: whether the navigation errs, so that the true odometry is published as well.
    """

    def __init__(self, node: SuiteNode, with_true_odometry: bool) -> None:
        p = node.parameters
        self._clock, self._rudder = Clock(), Float64()
        self._odometry = Odometry(p.world_frame, p.body_frame)
        self._truth = Odometry(p.world_frame, p.body_frame) if with_true_odometry else None
        self._water, self._true_current = TwistWithCovarianceStamped(p.body_frame), Vector3Stamped()
        self._outputs: list[tuple[Any, Any]] = [
            (node.advertise(topic), message)
            for topic, message in (
                (topics.CLOCK, self._clock), (topics.ODOM, self._odometry),
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
        fill_odometry(self._odometry, vehicle.navigation, u, v, stamp)
        fill_water_velocity(self._water, vehicle.passing_water if at_rest else vehicle.water_velocity, stamp)
        self._rudder.data = vehicle.rudder
        fill_current(self._true_current, vehicle.current, stamp)
        if self._truth is not None:
            fill_odometry(self._truth, *vehicle.truth, stamp)

    def publish(self, with_water_velocity: bool) -> None:
        """Publish the filled messages, the velocity through the water only where it was measured."""
        for publisher, message in self._outputs:
            if with_water_velocity or message is not self._water:
                publisher.publish(message)
