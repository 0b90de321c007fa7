"""The storage formats: MCAP, SQLite, ROS 1, and files compressed as a whole."""
