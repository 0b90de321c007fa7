"""Checks over ROS 2: the listener, the small test, the check of a vehicle and of the check itself."""
