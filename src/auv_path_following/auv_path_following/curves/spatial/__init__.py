"""Curves in three dimensions: planar subpaths lifted to a depth profile. No ROS."""
