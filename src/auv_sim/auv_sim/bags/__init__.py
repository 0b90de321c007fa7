"""`scripts/bag.py`: what can be done with a recording, one verb a module."""
