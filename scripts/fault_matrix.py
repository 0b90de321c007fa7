#!/usr/bin/env python3
"""Make everything fail that can, and check what the suite does about it. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.fault_matrix import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
