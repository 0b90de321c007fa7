"""Speed of the suite, measured as ratios in one run on one machine."""
