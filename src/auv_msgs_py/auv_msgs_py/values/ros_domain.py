"""Numbers of ROS domains. ROS-free."""

from __future__ import annotations

import os

from auv_msgs_py.values.errors import ConfigurationError

_VARIABLE = "ROS_DOMAIN_ID"
#: Highest ROS domain whose UDP ports exist (DDSI-RTPS 2.2, 9.6.1).
_LAST = 232
EXPECTED = f"a ROS domain from 0 to {_LAST}"


def is_ros_domain(text: str) -> bool:
    """Return whether a text is the number of a ROS domain."""
    return text.isdecimal() and int(text) <= _LAST


def domain_of_environment() -> int:
    """Return the ROS domain of the environment; as in ROS, an empty or missing variable means 0.

    Raises:
        ConfigurationError: ROS_DOMAIN_ID is not a domain.
    """
    named = os.environ.get(_VARIABLE) or "0"
    if not is_ros_domain(named):
        raise ConfigurationError(_VARIABLE, repr(named), EXPECTED)
    return int(named)
