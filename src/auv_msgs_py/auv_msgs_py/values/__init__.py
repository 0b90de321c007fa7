"""Immutable values, angles, errors and the form of pure laws. No ROS."""
