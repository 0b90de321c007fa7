"""Where the processes of a lockstep mission run."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from auv_msgs_py.contract import topics
from auv_sim.launch.processes.placement import Processor

#: Numbers that no machine has: claims of missions that fly meanwhile do not matter.
NUMBERS = (100_001, 100_002)


def test_two_missions_never_share_and_a_third_has_none() -> None:
    with ExitStack() as stack:
        processors = [Processor(NUMBERS) for _ in range(3)]
        for processor in processors:
            stack.callback(processor.release)
        assert {processor.number for processor in processors[:2]} == set(NUMBERS)
        assert processors[2].number is None
        released = processors[0].number
        processors[0].release()
        again = Processor(NUMBERS)
        stack.callback(again.release)
        assert again.number == released


def test_a_claim_goes_with_its_process_however_that_ends() -> None:
    code = (
        "import os, signal; from auv_sim.launch.processes.placement import Processor\n"
        f"processor = Processor({NUMBERS})\n"
        "print(processor.number, flush=True); os.kill(os.getpid(), signal.SIGKILL)"
    )
    held = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (held.returncode, int(held.stdout) in NUMBERS) == (-9, True)
    both = [Processor(NUMBERS), Processor(NUMBERS)]
    assert {processor.number for processor in both} == set(NUMBERS)
    for processor in both:
        processor.release()


def test_on_a_machine_with_one_processor_the_system_decides() -> None:
    assert Processor([0]).number is None


def test_a_node_that_has_died_meanwhile_is_left_to_who_watches_it() -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    processor = Processor(NUMBERS)
    processor.place({topics.GUIDANCE: ended.pid})
    processor.release()


@pytest.fixture
def sleepers() -> Iterator[dict[str, int]]:
    """A recorder and a guidance with two threads each, as processes."""
    code = (
        "import threading, time\nthreading.Thread(target=time.sleep, args=[99]).start(); print(1, flush=True)"
    )
    names = (topics.RECORDER, topics.GUIDANCE)
    processes = {
        name: subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) for name in names
    }
    try:
        for process in processes.values():
            assert process.stdout is not None
            process.stdout.readline()
        yield {name: process.pid for name, process in processes.items()}
    finally:
        for process in processes.values():
            process.kill()
            process.communicate()


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="one processor only")
def test_the_recorder_runs_beside_the_nodes(sleepers: dict[str, int]) -> None:
    processor = Processor()
    number = processor.number
    try:
        if number is None:  # missions that fly meanwhile have them all: nothing may change
            processor.place(sleepers)
            assert os.sched_getaffinity(sleepers[topics.GUIDANCE]) == os.sched_getaffinity(0)
            return
        processor.place(sleepers)
        for name, pid in sleepers.items():
            for task in (int(path.name) for path in Path(f"/proc/{pid}/task").iterdir()):
                placed = os.sched_getaffinity(task)
                assert placed == ({number} if name == topics.GUIDANCE else os.sched_getaffinity(0) - {number})
                assert os.sched_getscheduler(task) == os.SCHED_BATCH
    finally:
        processor.release()
