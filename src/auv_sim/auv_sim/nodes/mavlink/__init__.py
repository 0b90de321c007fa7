"""The driver for vehicles that speak MAVLink, and an emulated vehicle to try it on."""
