"""The console's ROS side: its subscriptions and service calls."""
