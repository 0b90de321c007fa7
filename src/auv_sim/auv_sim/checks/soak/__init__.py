"""Endurance: long flights, memory, lost messages."""
