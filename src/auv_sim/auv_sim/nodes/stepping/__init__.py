"""How the simulator takes its steps: in lockstep with the suite and its recorder, or free running."""
