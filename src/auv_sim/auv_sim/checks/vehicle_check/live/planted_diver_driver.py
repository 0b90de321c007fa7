"""A planted vehicle that dives on the wire: the topics of `planted_driver`, and those of stern planes."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import Range
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import set_stamp
from auv_msgs_py.values.types import SpatialCommand
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.live.listener import DIVING_COMMANDS
from auv_sim.checks.vehicle_check.live.planted_driver import odometry_of, water_of
from auv_sim.checks.vehicle_check.planted_divers import PlantedDiver
from auv_sim.checks.vehicle_check.planted_diving_vehicle import PlantedDivingVehicle
from auv_sim.checks.vehicle_check.samples import RangeSample

_DEPTH = 100


class PlantedDiverDriver:
    """A planted vehicle that dives on ROS topics of its own namespace; for arguments see `PlantedDriver`."""

    def __init__(self, node: Node, planted: PlantedDiver, hull: Vehicle, begin: float) -> None:
        self.planted = planted
        self.namespace = f"/{planted.name.replace('-', '_')}"
        self.vehicle = PlantedDivingVehicle(planted, hull, begin)
        self.sent = 0
        self.heard = 0
        self._commands = dict.fromkeys(DIVING_COMMANDS, 0.0)

        def advertise(topic: topics.Topic) -> Any:
            kind = qos.message_class(topic.type)
            return node.create_publisher(kind, f"{self.namespace}/{topic.name}", _DEPTH)

        self._odometry, self._water = advertise(topics.ODOM), advertise(topics.WATER_VELOCITY)
        self._rudder = advertise(topics.RUDDER_STATE)
        self._planes = None if planted.bare else advertise(topics.STERNPLANE_STATE)
        self._altitude = None if planted.altitude is None else advertise(topics.ALTITUDE)
        for topic in DIVING_COMMANDS:
            name = f"{self.namespace}/{topic.name}"
            node.create_subscription(Float64, name, self._on_command(topic), _DEPTH)

    def _on_command(self, topic: topics.Topic) -> Any:
        def take(message: Float64) -> None:
            self._commands[topic] = message.data
            if topic is topics.THRUST_CMD:  # the last of one set
                self.heard += 1
                self.vehicle.order(SpatialCommand(*self._commands.values()))

        return take

    def is_ready(self) -> bool:
        """Whether its topics are matched."""
        publishers = (self._odometry, self._rudder, self._planes, self._altitude)
        return all(each.get_subscription_count() for each in publishers if each is not None)

    def live(self, until: float) -> None:
        """Let time pass until `until` (s) and publish what is measured meanwhile."""
        for samples in self.vehicle.live(until):
            self._odometry.publish(odometry_of(samples.odom))
            self._water.publish(water_of(qos.message_class(topics.WATER_VELOCITY.type), samples.water))
            self._rudder.publish(Float64(data=samples.rudder))
            if self._planes is not None and samples.planes is not None:
                self._planes.publish(Float64(data=samples.planes))
            if self._altitude is not None and samples.altitude is not None:
                self._altitude.publish(_range(samples.altitude))
            self.sent += 1


def _range(sample: RangeSample) -> Range:
    message = Range(radiation_type=Range.ULTRASOUND)
    set_stamp(message.header.stamp, round(sample.stamp * 1e9))
    message.header.frame_id = "base_link"
    message.range, message.min_range, message.max_range = sample.range, sample.nearest, sample.farthest
    return message
