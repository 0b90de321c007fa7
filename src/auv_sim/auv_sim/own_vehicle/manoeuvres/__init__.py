"""Manoeuvres that show how a vehicle responds: programs, their laws, and their flight without ROS."""
