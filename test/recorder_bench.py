"""Recorders as processes, the talker that they record, and what they have recorded so far."""

from __future__ import annotations

import re
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from geometry_msgs.msg import Vector3Stamped

from auv_sim.bags.reading.bag_reader import read_bag

#: Time that a process may take to do what it was started for, s of wall time.
PATIENCE = 180.0

#: Recorders that were started and may still run.
STARTED: list[subprocess.Popen[str]] = []


def truth_topic(directory: Path) -> str:
    """Each test has a namespace of its own: a reader that was killed stays in the graph for a while."""
    return f"/{re.sub(r'[^a-z0-9]', '_', directory.name.lower())}/true_current"


def start(directory: Path, *settings: str, limit: int | None = None) -> subprocess.Popen[str]:
    """A recorder of `directory`'s parent's namespace."""
    namespace = truth_topic(directory.parent).rsplit("/", 1)[0]
    arguments = [part for setting in (f"directory:={directory}", *settings) for part in ("-p", setting)]
    command = [
        sys.executable,
        "-m",
        "auv_sim.nodes.recorder_node",
        "--ros-args",
        "-r",
        f"__ns:={namespace}",
        *arguments,
    ]

    def smaller_disk() -> None:
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, preexec_fn=smaller_disk
    )
    STARTED.append(process)
    return process


def wait(until: Callable[[], Any]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not until():
        assert time.monotonic() < deadline, "what was waited for did not come"
        time.sleep(0.02)


def wait_for(publisher: Any) -> None:
    """Wait until a reader of the recorder is known here; the recorder may not know this publisher yet.

    There are two while the recorder subscribes again, with the QoS that the publisher offers.
    """
    wait(lambda: publisher.get_subscription_count() >= 1)


def recorded(directory: Path, topic: str) -> list[bytes | None]:
    """The messages of a topic in the files so far."""
    if not any(file.stat().st_size for file in directory.glob("*.mcap")):
        return []
    found = read_bag(directory).topics.get(topic)
    return [] if found is None else found.messages


def talk(publisher: Any, until: Callable[[], bool], period: float = 0.005) -> float:
    """Publish every `period` s.

    Returns:
        The longest pause between two messages, s: how long this machine keeps a process waiting.
    """
    began = last = time.monotonic()
    longest = 0.0
    while not until():
        publisher.publish(Vector3Stamped())
        time.sleep(period)
        now = time.monotonic()
        assert now < began + PATIENCE, "what was waited for did not come"
        longest, last = max(longest, now - last), now
    return longest


def stop(process: subprocess.Popen[str]) -> str:
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=PATIENCE)
    return output
