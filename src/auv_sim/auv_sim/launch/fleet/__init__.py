"""Several simulated vehicles in one graph: the fleet's file, its flight, its results."""
