"""Shared work, and workers that do not outlive who started them."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from auv_sim.studies.pool import WorkerDied, each


def test_every_item_comes_with_its_place() -> None:
    done: list[None] = []
    found = dict(each(math.sqrt, [4.0, 9.0, 16.0], 2, lambda: done.append(None)))
    assert found == {0: 2.0, 1: 3.0, 2: 4.0} == dict(each(math.sqrt, [4.0, 9.0, 16.0], 1))
    assert len(done) == 3


def test_a_worker_that_dies_is_told() -> None:
    with pytest.raises(WorkerDied, match="a worker process died"):
        list(each(os._exit, [1, 1, 1], 2))


def test_workers_go_with_a_parent_that_is_killed() -> None:
    code = (
        "import os, time\n"
        "from auv_sim.studies.pool import worker_pool\n"
        "if __name__ == '__main__':\n"
        "    pool = worker_pool(1)\n"
        "    print(pool.submit(os.getpid).result(), flush=True)\n"
        "    time.sleep(600)\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert parent.stdout is not None
    worker = Path("/proc") / parent.stdout.readline().strip()
    assert worker.exists()
    parent.kill()
    parent.wait()
    parent.stdout.close()
    deadline = time.monotonic() + 180.0
    while worker.exists() and "Z" not in (worker / "stat").read_text().split()[2]:
        assert time.monotonic() < deadline, "the worker outlives its parent"
        time.sleep(0.05)


def slow(file: Path) -> None:
    """Says that it has begun, then takes its time."""
    file.touch()
    time.sleep(600.0)


@pytest.mark.parametrize("begun", [0, 2], ids=["while the workers load", "at work"])
def test_ctrl_c_in_a_terminal_ends_all_of_them_with_one_line(begun: int, tmp_path: Path) -> None:
    """A terminal sends it to the whole group, the workers too."""
    code = (
        "import pathlib, sys\n"
        "from auv_sim.command_line import command\n"
        "from auv_sim.studies.pool import each\n"
        "from test_pool import slow\n"
        "@command('it')\n"
        "def main():\n"
        "    files = [pathlib.Path(sys.argv[1]) / name for name in 'abc']\n"
        "    print('begun', flush=True)\n"
        "    return len(list(each(slow, files, 2)))\n"
        "raise SystemExit(main())\n"
    )
    place = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    parent = subprocess.Popen(
        [sys.executable, "-c", code, str(tmp_path)], env=place, start_new_session=True, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    try:
        assert parent.stdout is not None
        assert parent.stdout.readline() == "begun\n"
        while begun and len(list(tmp_path.iterdir())) < begun:
            time.sleep(0.05)
        time.sleep(0.2)
        os.killpg(parent.pid, signal.SIGINT)
        _, err = parent.communicate(timeout=180)
    finally:
        parent.kill()
        parent.wait()
    assert (parent.returncode, err) == (130, "interrupted\n")
