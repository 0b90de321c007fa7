"""Path segments, the composite path made of them, and the mission file that describes one."""
