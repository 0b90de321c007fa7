"""The vehicle's topics of the contract, published by its driver in the order of their stamps."""

from __future__ import annotations

from collections import Counter
from typing import Any

from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import fill_odometry, fill_water_velocity, set_stamp
from auv_msgs_py.contract.frames import turn_pose_covariance, turn_twist_covariance
from auv_msgs_py.contract.spatial_conversions import fill_spatial_odometry, fill_spatial_water
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.types import SpatialNavigation, SpatialWater, WaterVelocity
from auv_sim.nodes.mavlink.navigation import Fused
from auv_sim.nodes.mavlink.soundings import Sounding

#: 6 x 6, row-major.
Covariance = tuple[float, ...]
#: Step of /clock, ns.
_CLOCK_PERIOD = 20_000_000


class VehicleTopics:
    """Publishes measurements; one whose stamp goes back is dropped and counted.

    Args:
        node: the driver; its parameters name the frames and whether it publishes /clock.
        dropped: messages that were left out, by reason; counted up.
        dives: whether the vehicle has stern planes, and so their angle and an altitude.
    """

    def __init__(self, node: SuiteNode, dropped: Counter[str], dives: bool) -> None:
        p = node.parameters
        self._dropped = dropped
        self._newest: dict[Topic, int] = {}
        self._odometry, self._water = Odometry(), TwistWithCovarianceStamped()
        self._odometry.header.frame_id, self._odometry.child_frame_id = p.world_frame, p.body_frame
        self._water.header.frame_id = p.body_frame
        offered = [topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_STATE]
        if dives:
            from sensor_msgs.msg import Range

            offered += [topics.STERNPLANE_STATE, topics.ALTITUDE]
            self._range: Any = Range(radiation_type=Range.ULTRASOUND)
            self._range.header.frame_id = p.body_frame
        self._publish = {topic: node.advertise(topic).publish for topic in offered}
        self._publish_clock = node.advertise(topics.CLOCK).publish if p.clock_speed else None
        self._clock, self._clock_at = Clock(), 0

    def odometry(self, fused: Fused, stamp: int, covariances: tuple[Covariance, Covariance]) -> None:
        """Publish an odometry.

        Args:
            fused: the odometry.
            stamp: ns.
            covariances: of pose (NED) and twist (FRD).
        """
        self._odometry.pose.covariance = turn_pose_covariance(covariances[0])
        self._odometry.twist.covariance = turn_twist_covariance(covariances[1])
        _, navigation, velocity, p = fused
        if isinstance(navigation, SpatialNavigation):
            u, v, w = velocity
            fill_spatial_odometry(self._odometry, navigation, (u, v, w), p, stamp)
        else:
            u, v = velocity
            fill_odometry(self._odometry, navigation, u, v, stamp)
        self._in_order(topics.ODOM, self._odometry, stamp)

    def water_velocity(
        self, velocity: WaterVelocity | SpatialWater, stamp: int, covariance: Covariance
    ) -> None:
        """Publish a velocity through the water and its covariance, m/s, FRD; stamp in ns."""
        self._water.twist.covariance = turn_twist_covariance(covariance)
        if isinstance(velocity, SpatialWater):
            fill_spatial_water(self._water, velocity, stamp)
        else:
            fill_water_velocity(self._water, velocity, stamp)
        self._in_order(topics.WATER_VELOCITY, self._water, stamp)

    def rudder(self, angle: float) -> None:
        """Publish a measured rudder angle, rad, positive to port."""
        self._publish[topics.RUDDER_STATE](Float64(data=angle))

    def sternplanes(self, angle: float) -> None:
        """Publish a measured angle of the stern planes, rad, positive bow down."""
        self._publish[topics.STERNPLANE_STATE](Float64(data=angle))

    def altitude(self, sounding: Sounding, stamp: int) -> None:
        """Publish a range to the bottom; stamp in ns."""
        self._range.range, self._range.min_range, self._range.max_range = sounding
        set_stamp(self._range.header.stamp, stamp)
        self._in_order(topics.ALTITUDE, self._range, stamp)

    def clock(self, now: int) -> None:
        """Publish /clock (ns) in steps of `_CLOCK_PERIOD`, where this driver publishes it."""
        if self._publish_clock is not None and now >= self._clock_at + _CLOCK_PERIOD:
            self._clock_at = now
            set_stamp(self._clock.clock, now)
            self._publish_clock(self._clock)

    def _in_order(self, topic: Topic, message: Any, stamp: int) -> None:
        if stamp <= self._newest.get(topic, 0):
            self._dropped[f"{topic.name} while time was corrected"] += 1
            return
        self._newest[topic] = stamp
        self._publish[topic](message)
