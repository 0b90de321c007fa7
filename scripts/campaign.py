#!/usr/bin/env python3
"""Fly a study: many missions, their parameters drawn or on grids. Sets itself up on first use."""

import sys

import _bootstrap

_CLUSTER = any(argument == "--dask" or argument.startswith("--dask=") for argument in sys.argv[1:])
_bootstrap.ensure_environment(extra=("batch", "cluster") if _CLUSTER else ("batch",))

from auv_sim.cli.campaign import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
