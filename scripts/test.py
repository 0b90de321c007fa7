#!/usr/bin/env python3
"""Everything that has to hold: lint, format, types and tests. Arguments go to pytest, which then runs alone.

For one test: scripts/test.py -k fermat -x
"""

from __future__ import annotations

import os
import subprocess
import sys
import time

from _bootstrap import REPOSITORY, ensure_environment

CODE = ("src", "scripts", "test", "examples")
CHECKS = {
    "lint": ("ruff", "check", *CODE),
    "format": ("ruff", "format", "--check", *CODE),
    "types": ("mypy",),
    # Whole missions wait for a quarter of their time: three share two cores. A file's tests stay together, as
    # its fixtures do, and files keep the order that conftest.py gives them.
    "tests": ("pytest", "-p", "xdist", "--numprocesses", "3", "--dist", "loadfile", "--no-loadscope-reorder"),
}


def main(arguments: list[str]) -> int:
    from auv_sim.launch.processes.domains import free_domain  # not before there is an environment

    with free_domain() as domain:
        return run(arguments, domain)


def run(arguments: list[str], domain: int) -> int:
    """Run all checks, or pytest alone with arguments, in a ROS domain; return the exit code."""
    checks = {"tests": ("pytest", *arguments)} if arguments else CHECKS
    environment = {
        **os.environ,
        # Nothing of a test leaves this machine, nor meets another run on it.
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": str(domain),
        # A sourced ROS brings plug-ins for another pytest.
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
    }
    # A hundred processes import the same modules: without their compiled form each would compile them anew.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    began = time.monotonic()
    results = {}
    for name, command in checks.items():
        print("==", name + ":", " ".join(command), flush=True)
        done = subprocess.run([sys.executable, "-m", *command], cwd=REPOSITORY, env=environment, check=False)
        results[name] = done.returncode
    verdicts = ", ".join("{} {}".format(name, "FAILED" if code else "ok") for name, code in results.items())
    print(f"== {verdicts} ({time.monotonic() - began:.0f} s)", flush=True)
    return int(any(results.values()))


if __name__ == "__main__":
    ensure_environment(extra=("batch", "cluster", "console", "vehicle", "dev", "docs"))
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
