"""Recordings: writing and reading rosbag2 directories, and what can be done with them."""
