"""Processes that another process has started are found, watched and stopped."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from auv_sim.launch.processes.launched import Launched
from auv_sim.launch.processes.process_group import UNKNOWN_CODE, Children

SLEEPS = "import time; time.sleep(600)"


@pytest.fixture
def process(tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    command = [sys.executable, "-S", "-c", SLEEPS, "recorder", str(tmp_path / "params.yaml")]
    with subprocess.Popen(command) as running:
        while b"recorder" not in Path(f"/proc/{running.pid}/cmdline").read_bytes():
            pass  # Popen returns a moment before the system has the new command line
        yield running
        running.kill()


def test_it_is_found_by_its_command_line_and_ends(tmp_path: Path, process: subprocess.Popen[bytes]) -> None:
    mark = str(tmp_path / "params.yaml")
    found, other = Launched("recorder", mark), Launched("ailos_guidance", mark)
    assert found.poll() is None and found.pid == process.pid
    assert other.poll() is None and other.pid == 0
    with pytest.raises(subprocess.TimeoutExpired):
        found.wait(0.01)
    found.send_signal(signal.SIGTERM)
    assert found.wait(180.0) == UNKNOWN_CODE == found.poll()
    assert process.wait(180.0) == -signal.SIGTERM
    found.kill()  # it has ended: nothing happens, also to another process with its number


def test_one_that_never_was_delays_nothing(tmp_path: Path) -> None:
    process = Launched("recorder", str(tmp_path / "other.yaml"))
    process.send_signal(signal.SIGINT)
    assert process.poll() is None
    assert process.wait(180.0) == UNKNOWN_CODE


def test_the_end_of_one_is_reported_with_the_last_lines_of_its_own_log(
    tmp_path: Path, process: subprocess.Popen[bytes]
) -> None:
    class Starter:
        def fork(self, environment, nodes):  # type: ignore[no-untyped-def]
            return {"recorder": Launched("recorder", str(tmp_path / "params.yaml"))}

    children = Children(tmp_path / "log", {})
    children.fork(Starter(), {"recorder": ("module", [])})  # type: ignore[arg-type]
    assert children.dead() is None and children.ids == {"recorder": process.pid}
    (tmp_path / "log" / "ros").mkdir()
    (tmp_path / "log" / "ros" / f"python3_{process.pid}_1.log").write_text("first\nthe disk is full\n")
    process.kill()
    process.wait()
    dead = children.dead()
    assert dead is not None
    assert dead.obituary().startswith("recorder ended; ") and "the disk is full" in dead.obituary()
