#!/usr/bin/env python3
"""Show a running mission in Foxglove, or write a layout for it. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment(extra=("foxglove",))

from auv_sim.cli.live_view import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
