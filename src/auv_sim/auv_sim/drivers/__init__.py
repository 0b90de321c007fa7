"""Real vehicles: a driver for MAVLink, a vehicle to try it on, and the check of anybody's driver."""
