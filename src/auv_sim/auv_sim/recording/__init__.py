"""Recordings: writing a rosbag2 directory (MCAP) and reading one back as a `Run`."""
