"""Hulls in six degrees of freedom, one a file. No ROS."""
