"""Many missions at once: the laws of the suite over plain numbers, compiled where Numba is installed."""
