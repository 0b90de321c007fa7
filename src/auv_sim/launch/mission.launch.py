"""Fly one mission: `ros2 launch auv_sim mission.launch.py mission:=figure_of_eight`.

The arguments are the options of `scripts/mission.py`: see `--show-args`, and docs/launch.md.
"""

from auv_sim.launch.ros_launch import description


def generate_launch_description():
    """Return the description, for `ros2 launch`."""
    return description.mission()
