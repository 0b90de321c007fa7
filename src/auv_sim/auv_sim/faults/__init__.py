"""Faults on purpose: a relay that spoils topics, and the matrix of what the suite does about it."""
