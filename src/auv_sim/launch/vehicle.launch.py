"""Start the nodes for a vehicle: `ros2 launch auv_sim vehicle.launch.py mission:=FILE`.

The mission begins when the service `start` is called. See `--show-args`, and docs/launch.md.
"""

from auv_sim.launch.ros_launch import description


def generate_launch_description():
    """Return the description, for `ros2 launch`."""
    return description.vehicle()
