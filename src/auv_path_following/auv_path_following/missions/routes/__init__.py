"""Generators of segments from waypoints, areas and ready-made shapes."""
