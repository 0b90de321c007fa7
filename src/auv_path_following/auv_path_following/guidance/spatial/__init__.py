"""Guidance in three dimensions: errors, laws in both planes, vertical modes and limits of pitch. No ROS."""
