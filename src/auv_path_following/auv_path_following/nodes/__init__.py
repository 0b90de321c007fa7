"""The thin ROS 2 nodes: convert, update, publish."""
