"""How fast the suite is, measured as ratios in one run on one machine."""
