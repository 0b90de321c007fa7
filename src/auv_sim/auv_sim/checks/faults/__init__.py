"""Faults on purpose: the matrix of faults and what the suite does about each."""
