"""The verbs of `scripts/vehicle.py`: each module adds its options and runs."""
