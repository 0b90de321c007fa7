"""The console's half on the graph: what it hears, and what it calls."""
