"""Missions: the file, routes and waypoint files, limits and the mission state. No ROS."""
