#!/usr/bin/env python3
"""Measure how fast the suite is on this machine. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment(extra=("batch", "console"))

from auv_sim.cli.benchmark import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
