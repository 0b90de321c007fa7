"""How well simulated vehicles are identified, whose hulls are known: the figures of docs/identification.md."""
