"""The thin ROS 2 nodes of the simulator and the recorder."""
