"""Curves under one scalar: segments, the composite path, arc length, the closest point. No ROS."""
