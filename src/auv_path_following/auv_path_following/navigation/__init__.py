"""Judging what navigation reports, and estimating the current. No ROS."""
