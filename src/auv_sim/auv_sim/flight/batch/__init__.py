"""Many flights at once: the pilot and the plant compiled where Numba is installed."""
