"""What every node shares: its loop, parameters, diagnostics, clocks and lockstep."""
