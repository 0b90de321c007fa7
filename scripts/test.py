#!/usr/bin/env python3
"""Everything that has to hold: lint, format, types and tests. Arguments go to pytest, which then runs alone.

For one test: scripts/test.py -k fermat -x

Where no more than three tests fail, they run once more without the others. That result counts, and the last
lines name them.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

from _bootstrap import REPOSITORY, ensure_environment

CODE = ("src", "scripts", "test", "examples")
CHECKS = {
    "lint": ("ruff", "check", *CODE),
    "format": ("ruff", "format", "--check", *CODE),
    "types": ("mypy",),
    # Whole missions wait for a quarter of their time: three share two cores. A file's tests stay together, as
    # its fixtures do, and files keep the order that conftest.py gives them.
    "tests": (
        *("pytest", "--cache-clear", "-p", "xdist", "--numprocesses", "3"),
        *("--dist", "loadfile", "--no-loadscope-reorder"),
    ),
}
#: So few failed tests run again without the others: what is broken fails, what met a busy machine passes.
FEW = 3
SOME_FAILED = 1  # pytest's exit code


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
    results: dict[str, int] = {}
    repeated: list[str] = []
    for name, command in checks.items():
        results[name] = call(name, command, environment)
    if not arguments and results["tests"] == SOME_FAILED and (repeated := few_failed()):
        results["tests"] = call("failed tests", ("pytest", *repeated), environment)
    verdicts = ", ".join("{} {}".format(name, "FAILED" if code else "ok") for name, code in results.items())
    print(f"== {verdicts} ({time.monotonic() - began:.0f} s)", flush=True)
    for test in repeated:
        print(f"== failed among the others, run again without them: {test}", flush=True)
    return int(any(results.values()))


def call(name: str, command: tuple[str, ...], environment: dict[str, str]) -> int:
    """Run a module in the repository; return its exit code."""
    print(f"== {name}:", " ".join(command), flush=True)
    done = subprocess.run([sys.executable, "-m", *command], cwd=REPOSITORY, env=environment, check=False)
    return done.returncode


def few_failed() -> list[str]:
    """Return the tests that failed in the last run of pytest; none if they are more than FEW."""
    names = Path(REPOSITORY, ".pytest_cache/v/cache/lastfailed")
    failed = list(json.loads(names.read_text(encoding="utf-8"))) if names.is_file() else []
    return failed if len(failed) <= FEW else []


if __name__ == "__main__":
    ensure_environment(extra=("batch", "cluster", "console", "vehicle", "dev", "docs"))
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
