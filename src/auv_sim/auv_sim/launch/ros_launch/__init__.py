"""Missions and vehicles under `ros2 launch`."""
