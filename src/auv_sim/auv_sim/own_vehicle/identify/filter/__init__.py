"""Filters whose one-step prediction errors are minimised: covariances, surge, sway and yaw, the servo."""
