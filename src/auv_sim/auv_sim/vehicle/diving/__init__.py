"""The simulated vehicle in three dimensions: what it measures, and the sea around it. No ROS."""
