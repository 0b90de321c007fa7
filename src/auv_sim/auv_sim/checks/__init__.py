"""Checks of missions, vehicles, faults, endurance and speed."""
