"""Self-describing settings, and the YAML and parameter files that carry them. No ROS."""
