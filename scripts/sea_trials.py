#!/usr/bin/env python3
"""Fly a mission in a sea with many seeds and judge it by the true track. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.sea_trials import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
