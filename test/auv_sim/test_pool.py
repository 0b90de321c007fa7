"""Shared work, and workers that do not outlive who started them."""

from __future__ import annotations

import math
import subprocess
import sys
import time
from pathlib import Path

from auv_sim.pool import each


def test_every_item_comes_with_its_place() -> None:
    done: list[None] = []
    found = dict(each(math.sqrt, [4.0, 9.0, 16.0], 2, lambda: done.append(None)))
    assert found == {0: 2.0, 1: 3.0, 2: 4.0} == dict(each(math.sqrt, [4.0, 9.0, 16.0], 1))
    assert len(done) == 3


def test_workers_go_with_a_parent_that_is_killed() -> None:
    code = (
        "import os, time\n"
        "from auv_sim.pool import worker_pool\n"
        "if __name__ == '__main__':\n"
        "    pool = worker_pool(1)\n"
        "    print(pool.submit(os.getpid).result(), flush=True)\n"
        "    time.sleep(60)\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert parent.stdout is not None
    worker = Path("/proc") / parent.stdout.readline().strip()
    assert worker.exists()
    parent.kill()
    parent.wait()
    parent.stdout.close()
    deadline = time.monotonic() + 20.0
    while worker.exists() and "Z" not in (worker / "stat").read_text().split()[2]:
        assert time.monotonic() < deadline, "the worker outlives its parent"
        time.sleep(0.05)
