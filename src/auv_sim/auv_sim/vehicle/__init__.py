"""The simulated vehicle: hull, actuators, sensors, navigator and the sea around it. No ROS."""
