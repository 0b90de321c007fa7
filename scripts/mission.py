#!/usr/bin/env python3
"""Fly a mission over ROS 2, record it, draw it. Sets itself up on first use."""

import sys

import _bootstrap

_bootstrap.ensure_environment(extra=("console",) if "--console" in sys.argv[1:] else ())

from auv_sim.cli.mission import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
