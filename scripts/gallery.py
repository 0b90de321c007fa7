#!/usr/bin/env python3
"""Fly Table 1's five kinds of path over the same waypoints and renew their table and pictures in docs/."""

import _bootstrap

_bootstrap.ensure_environment()

from auv_sim.cli.gallery import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
