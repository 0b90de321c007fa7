"""Writing a rosbag2 directory with MCAP storage."""
