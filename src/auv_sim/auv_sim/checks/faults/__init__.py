"""Deliberate faults: the matrix of faults and the reaction to each."""
