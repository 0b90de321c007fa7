"""The verbs of `scripts/bag.py`, one a file."""
