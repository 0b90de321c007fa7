"""Checks a mission before the vehicle is in the water: whether it can be flown, its duration, a picture."""
