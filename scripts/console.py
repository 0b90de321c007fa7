#!/usr/bin/env python3
"""Watch missions and steer them, in any browser. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment(extra=("console",))

from auv_sim.cli.console import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
