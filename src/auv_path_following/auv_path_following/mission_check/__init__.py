"""Whether a mission can be flown: turns, crossings, circles of acceptance, depths and slopes."""
