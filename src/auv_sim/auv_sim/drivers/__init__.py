"""Real vehicles: a driver for MAVLink, a vehicle to try it on, and the check of any driver."""
