#!/usr/bin/env python3
"""Look into recordings of missions and work with them. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.bag import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
