#!/usr/bin/env python3
"""Check a mission and draw it before the vehicle is in the water. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.plan import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
