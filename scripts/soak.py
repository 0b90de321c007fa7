#!/usr/bin/env python3
"""Fly for an hour of mission time and see whether anything grows or is lost. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.soak import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
