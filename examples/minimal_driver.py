"""The smallest driver: a kinematic vehicle in real time. Start it with --ros-args -r __ns:=/auv."""

import math
import time

import rclpy
from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Float64


class MinimalDriver(Node):
    """Publish ENU odometry at 20 Hz, turn and move as commanded, stop if either command is silent for 1 s."""

    def __init__(self) -> None:
        super().__init__("minimal_driver")
        self.x = self.y = self.yaw = 0.0
        self.rudder = self.thrust = 0.0, 0.0  # value, time of arrival
        self.odom = self.create_publisher(Odometry, "odom", 10)
        self.water = self.create_publisher(TwistWithCovarianceStamped, "velocity_through_water", 10)
        for name in ("rudder", "thrust"):
            self.create_subscription(Float64, f"{name}_cmd", lambda m, n=name: self.on_command(n, m.data), 10)
        self.create_timer(0.05, self.step)

    def on_command(self, name: str, value: float) -> None:
        setattr(self, name, (value, time.monotonic()))

    def step(self) -> None:
        moving = self.thrust[0] > 0.0 and time.monotonic() - min(self.rudder[1], self.thrust[1]) < 1.0
        u, r = (1.8, 0.8 * self.rudder[0]) if moving else (0.0, 0.0)  # m/s, rad/s
        self.yaw += r * 0.05
        self.x, self.y = self.x + u * math.cos(self.yaw) * 0.05, self.y + u * math.sin(self.yaw) * 0.05
        water, odom = TwistWithCovarianceStamped(), Odometry()
        water.header.stamp = odom.header.stamp = self.get_clock().now().to_msg()
        water.header.frame_id, odom.header.frame_id, odom.child_frame_id = "base_link", "odom", "base_link"
        place, q, twist = odom.pose.pose.position, odom.pose.pose.orientation, odom.twist.twist
        place.x, place.y, q.z, q.w = self.x, self.y, math.sin(self.yaw / 2), math.cos(self.yaw / 2)
        twist.linear.x, twist.angular.z, water.twist.twist.linear.x = u, r, u
        self.water.publish(water)  # first: the odometry triggers the suite
        self.odom.publish(odom)


rclpy.init()
try:
    rclpy.spin(MinimalDriver())
except (KeyboardInterrupt, Exception):
    if rclpy.ok():  # neither Ctrl-C nor SIGTERM
        raise
