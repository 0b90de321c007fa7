"""What every part of the suite speaks: types, frames, topics and the ROS plumbing. No laws live here."""
