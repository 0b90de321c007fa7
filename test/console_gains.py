"""The parameters that the fake console's one node has, as in the protocol."""

from __future__ import annotations

GAINS = [
    {
        "name": "autopilot.nism.k1", "type": "double", "value": 0.45, "default": 0.45, "minimum": 0.0,
        "maximum": 10.0, "unit": "-", "doc": "Gain of the first sliding surface", "read_only": False,
        "safety": False,
    },
    {
        "name": "autopilot.nism.k3", "type": "double", "value": 1.4, "default": 1.2, "minimum": 0.0,
        "maximum": 10.0, "unit": "-", "doc": "Gain of the second sliding surface", "read_only": False,
        "safety": False,
    },
    {
        "name": "odometry_timeout", "type": "double", "value": 1.0, "default": 1.0, "minimum": 0.1,
        "maximum": 10.0, "unit": "s", "doc": "Age of the odometry at which the fins are stopped",
        "read_only": False, "safety": True,
    },
]  # fmt: skip
