#!/usr/bin/env python3
"""Whether a vehicle's driver keeps the contract. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.vehicles.check_vehicle import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
