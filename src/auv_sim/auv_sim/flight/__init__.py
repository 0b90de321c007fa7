"""Flights without ROS, the record of a run, and its figures."""
