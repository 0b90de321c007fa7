"""Mutated files for every reader of the suite: `python3 -m mutation --help`, in the folder `test`."""
