"""Before the water: whether a mission can be flown, how long it takes, and what it looks like."""
