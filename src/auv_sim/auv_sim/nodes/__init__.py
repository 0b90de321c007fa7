"""The ROS 2 nodes of the simulator, the recorder and the fault relay."""
