#!/usr/bin/env python3
"""Describe, identify, tune and prove a vehicle of your own. Sets itself up on first use."""

import os
import sys

import _bootstrap

#: Verbs that fly or fit thousands of times: compiled, and with an optimiser.
_HEAVY = {"identify", "tune", "prove"}
_bootstrap.ensure_environment(extra=("vehicle",) if _HEAVY.intersection(sys.argv[1:2]) else ())

from auv_sim.cli.vehicles.vehicle_command import main  # noqa: E402 - only there once the environment is
from auv_sim.command_line import EXIT_INTERRUPTED  # noqa: E402

if __name__ == "__main__":
    code = main()
    if code == EXIT_INTERRUPTED:  # leave at once: Python would wait for a thread that compiles
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    raise SystemExit(code)
