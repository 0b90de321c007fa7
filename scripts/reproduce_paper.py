#!/usr/bin/env python3
"""Fly the paper's cases, draw its figures, judge its claims. Sets itself up on first use."""

import _bootstrap

_bootstrap.ensure_environment(extra=("batch",))

from auv_sim.cli.reproduce_paper import main  # noqa: E402 - only there once the environment is

if __name__ == "__main__":
    raise SystemExit(main())
