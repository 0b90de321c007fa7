"""A goal from people and their tools: it becomes the parameter `mission_text`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from rclpy.parameter import Parameter

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import MAP
from auv_msgs_py.contract.frames import flip_yaw, swap_axes, yaw_of_quaternion
from auv_msgs_py.contract.wire import PoseStamped
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import MessageRefused
from auv_path_following.course import PlanarCourse
from auv_path_following.curves.dubins import PlanarPose
from auv_path_following.guidance.approach import agility_of, turn_radius
from auv_path_following.missions.orders.goal_mission import goal_text

#: Oldest position of the vehicle from which a goal is planned, s.
_OLDEST = 1.0


class GoalInput:
    """Take `goal_pose` for a mission: it is checked, posted and recorded as any other `mission_text`.

    Args:
        node: ailos_guidance.
        course: returns the course that is flown.
        service: returns the name of the service that begins a mission now, for the log.
    """

    def __init__(
        self, node: SuiteNode, course: Callable[[], PlanarCourse], service: Callable[[], str]
    ) -> None:
        self._node, self._course, self._service = node, course, service
        self._here: Any | None = None
        self._seen_at = -math.inf
        node.listen(topics.GOAL_POSE, self._on_goal)

    def is_at(self, navigation: Any) -> None:
        """Take the position of the vehicle, NED."""
        self._here, self._seen_at = navigation, self._node.now()

    def _on_goal(self, message: PoseStamped) -> None:
        node, name = self._node, topics.GOAL_POSE.name
        if not node.parameters.accept_goal:
            raise MessageRefused(name, "a goal", "none: the parameter accept_goal is false")
        there, depth = goal_from(message, name)
        if self._here is None or abs(node.now() - self._seen_at) > _OLDEST:
            raise MessageRefused(name, "a goal without fresh navigation", "an odometry of the vehicle")
        course, here = self._course(), self._here
        thrust, guidance = course.mission.thrust, node.parameters.guidance
        radius = turn_radius(guidance.approach, agility_of(course.vehicle, thrust), guidance.lookahead)
        dives = course.vehicle.dives
        depths = (max(here.z, course.vehicle.shallowest), depth) if dives else None
        text = goal_text(PlanarPose(here.x, here.y, here.psi), there, radius, thrust, depths)
        if not text:
            raise MessageRefused(name, "the vehicle's own pose", "another place")
        (result,) = node.set_parameters([Parameter("mission_text", value=text)])
        if not result.successful:
            raise MessageRefused(name, "a goal", result.reason)
        node.get_logger().info(
            f"goal taken: north {there.x:.1f} m, east {there.y:.1f} m; {self._service()} begins it"
        )


def goal_from(message: PoseStamped, topic: str) -> tuple[PlanarPose, float]:
    """Return the pose of a goal, NED, and its depth, m.

    Raises:
        MessageRefused: it is not in `map`, or a value is not finite.
    """
    frame, pose = message.header.frame_id, message.pose
    if frame.rsplit("/", 1)[-1] != MAP:
        raise MessageRefused(topic, f"frame_id '{frame}'", MAP)
    p, q = pose.position, pose.orientation
    if not math.isfinite(p.x + p.y + p.z + q.x + q.y + q.z + q.w):
        raise MessageRefused(topic, "a value that is not finite", "finite numbers")
    norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w
    if not abs(norm - 1.0) < 0.02:
        raise MessageRefused(topic, f"a quaternion of norm {math.sqrt(abs(norm)):.3f}", "a unit quaternion")
    north, east = swap_axes(p.x, p.y)
    return PlanarPose(north, east, flip_yaw(yaw_of_quaternion(q.x, q.y, q.z, q.w))), -p.z
