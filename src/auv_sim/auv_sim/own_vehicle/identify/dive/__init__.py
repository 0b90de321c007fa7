"""Heave and pitch by the same method: stern planes, righting moment, buoyancy."""
