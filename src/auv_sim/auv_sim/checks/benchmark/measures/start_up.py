"""How long a mission takes from the launcher's call to its first rudder command."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from functools import cache
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_sim.bags.reading.growing_bag import has_message
from auv_sim.checks.benchmark.measures.children import BenchmarkFailed, interruptible
from auv_sim.checks.benchmark.measures.rig import NAMESPACE
from auv_sim.checks.patience import PATIENCE

#: The launcher's module, by today's name and by its former one.
_LAUNCHERS = ("auv_sim.cli.mission", "auv_sim.mission")
_TOPIC = topics.full_name(NAMESPACE, topics.RUDDER_CMD.name)


def environment() -> dict[str, str]:
    """Return this process' environment variables for the interpreter of another checkout.

    The wheels of ROS 2 note in them where their libraries are, which holds for this checkout only.
    """
    kept = dict(os.environ)
    if kept.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None):
        kept.pop("LD_LIBRARY_PATH", None)
    for name in ("PYTHONDONTWRITEBYTECODE", "FASTRTPS_DEFAULT_PROFILES_FILE"):
        kept.pop(name, None)
    return kept | {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


@cache
def launcher_of(python: str) -> str:
    """Return the launcher's module in the checkout of an interpreter.

    Raises:
        BenchmarkFailed: it has none.
    """
    for name in _LAUNCHERS:
        shown = subprocess.run(  # noqa: S603 - an interpreter of the suite, our own module
            [python, "-m", name, "--help"], env=environment(), capture_output=True, check=False
        )
        if shown.returncode == 0:
            return name
    raise BenchmarkFailed(f"{python} has no launcher: {' or '.join(_LAUNCHERS)}")


def first_command(python: str = sys.executable, composed: bool = False) -> float:
    """Fly until the recording has a rudder command, s; nothing else is in the mission's ROS domain.

    Args:
        python: the interpreter of a checkout.
        composed: all nodes in one process.

    Raises:
        BenchmarkFailed: no mission came up.
    """
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name, interruptible() as stop:
        run = Path(name) / "run"
        command = [python, "-m", launcher_of(python), "--quiet", "--out", str(run)]
        begin = time.monotonic()
        launcher = subprocess.Popen(  # noqa: S603 - an interpreter of the suite, our own module
            [*command, *["--composed"] * composed],
            env=environment(),
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # Ctrl-C is passed on, once
        )
        try:
            while not has_message(run / "bag", _TOPIC):
                if launcher.poll() is not None or time.monotonic() - begin > PATIENCE:
                    raise BenchmarkFailed("the launcher did not bring up a mission")
                if stop.requested:
                    raise KeyboardInterrupt
                time.sleep(0.02)
            return time.monotonic() - begin
        finally:
            launcher.send_signal(signal.SIGINT)
            try:
                launcher.wait(30.0)
            except subprocess.TimeoutExpired:
                launcher.kill()
                launcher.wait()
