"""The checks on a vehicle that dives, one group a file."""
