"""Guidance along a path: virtual point, switching, approach, rejoining, line-of-sight laws. No ROS."""
