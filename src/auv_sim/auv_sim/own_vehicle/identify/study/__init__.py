"""How well simulated vehicles of known hulls are identified: the figures of docs/identification.md."""
