"""The topics of the display node. What it publishes is for people: no node of the suite reads it."""

from __future__ import annotations

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import DISPLAY, Topic

MARKERS = Topic("markers", "visualization_msgs/msg/MarkerArray", DISPLAY, latched=True)
LIVE_MARKERS = Topic("markers_live", "visualization_msgs/msg/MarkerArray", DISPLAY)
ROBOT_DESCRIPTION = Topic("robot_description", "std_msgs/msg/String", DISPLAY, latched=True)
JOINT_STATES = Topic("joint_states", "sensor_msgs/msg/JointState", DISPLAY)
#: What the display hears of every vehicle.
HEARD = (
    topics.ODOM, topics.PATH, topics.MISSION_STATE, topics.VIRTUAL_POINT, topics.CURRENT_ESTIMATE,
    topics.PATH_ERROR, topics.RUDDER_STATE, topics.GEOFENCE,
)  # fmt: skip
