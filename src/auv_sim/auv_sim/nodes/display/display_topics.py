"""The topics of the display node. They are for people: no node of the suite reads them."""

from __future__ import annotations

from auv_msgs_py.contract.topics import DISPLAY, Topic

MARKERS = Topic("markers", "visualization_msgs/msg/MarkerArray", DISPLAY, latched=True)
LIVE_MARKERS = Topic("markers_live", "visualization_msgs/msg/MarkerArray", DISPLAY)
ROBOT_DESCRIPTION = Topic("robot_description", "std_msgs/msg/String", DISPLAY, latched=True)
JOINT_STATES = Topic("joint_states", "sensor_msgs/msg/JointState", DISPLAY)
