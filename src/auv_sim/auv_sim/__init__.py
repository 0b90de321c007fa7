"""The simulated vehicle and what is done with it: launching, recording, analysing."""
