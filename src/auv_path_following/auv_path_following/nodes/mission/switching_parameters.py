"""The circles of acceptance of a mission as parameters, where they can be seen and changed."""

from __future__ import annotations

from rclpy.parameter import Parameter

from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.missions.mission_file import Mission


class SwitchingParameters:
    """Set `guidance.switching` to what a mission asks for, and back for one that leaves it to the parameters.

    Args:
        node: ailos_guidance, with the parameters that it was started with.
    """

    def __init__(self, node: SuiteNode) -> None:
        self._node = node
        self._own: SwitchingConfig = node.parameters.guidance.switching
        self._set: SwitchingConfig | None = None

    def take(self, mission: Mission) -> None:
        """Take a mission. Values that were changed since the last one are the operator's, and stay."""
        now = self._node.parameters.guidance.switching
        if self._set is not None and now != self._set:
            self._own = now
        self._set = None
        parameters = self._node.parameters.with_switching(self._own)
        asked: SwitchingConfig = parameters.with_mission_overrides(mission).guidance.switching
        if asked != now:
            mode = Parameter("guidance.switching.mode", value=asked.mode)
            radius = Parameter("guidance.switching.radius", value=asked.radius)
            self._node.set_parameters([mode, radius])
        if asked != self._own:
            self._set = asked
