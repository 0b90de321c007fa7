"""Several simulated vehicles in one graph: their common clock."""
