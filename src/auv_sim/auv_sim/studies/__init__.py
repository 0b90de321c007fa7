"""Studies of many flights: campaigns, sea trials, noise, the gallery, the paper."""
