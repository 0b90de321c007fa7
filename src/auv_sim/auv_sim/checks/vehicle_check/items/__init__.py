"""The groups of checks on a vehicle, one a file."""
