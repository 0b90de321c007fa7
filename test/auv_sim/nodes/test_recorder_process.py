"""The recorder as a process over real DDS: nothing lost, killed at any moment, a full disk, replay."""

from __future__ import annotations

import os
import random
import re
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from geometry_msgs.msg import Vector3Stamped
from mcap.reader import make_reader
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosbags.highlevel import AnyReader
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import qos, topics
from auv_sim.bags.bag_repair import repair
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.growing_bag import has_message

#: What a crash may lose at most, s.
BOUND = 1.0

_STARTED: list[subprocess.Popen[str]] = []


@pytest.fixture(autouse=True)
def nothing_left_running() -> Iterator[None]:
    """A test that failed half-way leaves no recorder behind."""
    yield
    while _STARTED:
        process = _STARTED.pop()
        process.kill()
        process.wait()
        if process.stdout is not None:
            process.stdout.close()


@pytest.fixture(scope="module")
def node() -> Iterator[Node]:
    context = Context()
    rclpy.init(context=context)
    made = rclpy.create_node("talker", namespace="/auv", context=context)
    yield made
    made.destroy_node()
    rclpy.try_shutdown(context=context)


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
    _STARTED.append(process)
    return process


def wait_for(publisher: Any, readers: int = 1) -> None:
    deadline = time.monotonic() + 20.0
    while publisher.get_subscription_count() != readers:
        assert time.monotonic() < deadline, "the recorder does not listen"
        time.sleep(0.02)


def talk(publisher: Any, until: Callable[[], bool]) -> float:
    """Publish every 5 ms.

    Returns:
        The longest pause between two messages, s: how long this machine keeps a process waiting.
    """
    began = last = time.monotonic()
    longest = 0.0
    while not until():
        publisher.publish(Vector3Stamped())
        time.sleep(0.005)
        now = time.monotonic()
        assert now < began + 20.0, "what was waited for did not come"
        longest, last = max(longest, now - last), now
    return longest


def stop(process: subprocess.Popen[str]) -> str:
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=180)
    return output


def test_counts_equal_those_published(tmp_path: Path, node: Node) -> None:
    """Contract topics, a latched word said before the recorder was there, others by name and by pattern."""
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    space = truth_topic(tmp_path).rsplit("/", 1)[0]
    state = node.create_publisher(String, f"{space}/mission_state", latched)
    state.publish(String(data="running"))
    truth = node.create_publisher(Vector3Stamped, truth_topic(tmp_path), 10)
    names = [f"{space}/{name}" for name in ("by_name", "pattern_1", "pattern_2", "not_this")]
    extra = [node.create_publisher(Float64, name, 10) for name in names]
    process = start(tmp_path / "bag", "topics:=by_name", "regex:=/pattern_", "max_duration:=0.5")
    wait_for(truth)
    for publisher in extra[:3]:
        wait_for(publisher)
    for k in range(300):
        truth.publish(Vector3Stamped())
        for publisher in extra:
            publisher.publish(Float64(data=float(k)))
        time.sleep(0.005)
    output = stop(process)
    assert "0 dropped" in output
    bag = read_bag(tmp_path / "bag")
    assert bag.notes == []
    assert len(bag.files) >= 2
    counts = {name: topic.count for name, topic in bag.topics.items() if topic.count}
    counts.pop("/diagnostics", None)
    counts.pop("/rosout", None)
    counts.pop("/parameter_events", None)
    expected = dict.fromkeys((truth_topic(tmp_path), *names[:3]), 300) | {f"{space}/mission_state": 1}
    assert counts == expected
    assert "transient_local" in bag.topics[f"{space}/mission_state"].qos
    for publisher in (state, truth, *extra):
        node.destroy_publisher(publisher)


@pytest.mark.parametrize("seed", range(3))
def test_killed_at_any_moment(tmp_path: Path, node: Node, seed: int) -> None:
    truth = node.create_publisher(Vector3Stamped, truth_topic(tmp_path), 10)
    process = start(tmp_path / "bag")
    wait_for(truth)
    # Its reader is matched before the recorder has come to its first flush; from then on the bound holds.
    talk(truth, until=lambda: has_message(tmp_path / "bag", truth_topic(tmp_path)))
    end = time.monotonic() + random.Random(seed).uniform(0.0, 1.5)
    longest = talk(truth, until=lambda: time.monotonic() > end)
    process.kill()
    killed = time.time()
    process.wait()
    found = read_bag(tmp_path / "bag").topics[truth_topic(tmp_path)]
    assert killed - max(found.publish_ns) * 1e-9 < BOUND + longest
    done = repair(tmp_path / "bag")
    with AnyReader([tmp_path / "bag"]) as reader:
        assert sum(1 for _ in reader.messages()) == done.messages
    with next((tmp_path / "bag").glob("*.mcap")).open("rb") as stream:
        assert sum(1 for _ in make_reader(stream, validate_crcs=True).iter_messages()) == done.messages
    node.destroy_publisher(truth)


def test_a_full_disk_is_told_and_what_is_there_stays_readable(tmp_path: Path, node: Node) -> None:
    truth = node.create_publisher(Vector3Stamped, truth_topic(tmp_path), 10)
    process = start(tmp_path / "bag", "compression:=none", limit=20_000)
    wait_for(truth)
    for _ in range(400):
        truth.publish(Vector3Stamped())
        time.sleep(0.005)
    output = stop(process)
    assert "cannot write bag_0.mcap: File too large" in output
    assert "bag.py repair" in output
    bag = read_bag(tmp_path / "bag")
    assert bag.topics[truth_topic(tmp_path)].count > 50
    assert repair(tmp_path / "bag").messages == bag.count
    node.destroy_publisher(truth)


def test_replay_repeats_messages_and_qos(tmp_path: Path, node: Node) -> None:
    truth = node.create_publisher(Vector3Stamped, truth_topic(tmp_path), 10)
    process = start(tmp_path / "first")
    wait_for(truth)
    for k in range(100):
        message = Vector3Stamped()
        message.vector.x = float(k)
        truth.publish(message)
        time.sleep(0.01)
    stop(process)
    node.destroy_publisher(truth)
    process = start(tmp_path / "second")
    code = "import sys; from auv_sim.cli.bag import main; sys.exit(main(sys.argv[1:]))"
    replay = [sys.executable, "-c", code, "replay", str(tmp_path / "first"), "--topics", "true_current"]
    done = subprocess.run(
        [*replay, "--rate", "2", "--delay", "3"], env=dict(os.environ), timeout=180, check=False
    )
    assert done.returncode == 0
    time.sleep(0.2)
    stop(process)
    first, second = (read_bag(tmp_path / name).topics[truth_topic(tmp_path)] for name in ("first", "second"))
    assert second.messages == first.messages
    span = [max(topic.log_ns) - min(topic.log_ns) for topic in (first, second)]
    assert span[1] == pytest.approx(span[0] / 2, rel=0.2)


def test_in_lockstep_a_simulator_that_is_discovered_late_is_told_the_newest_count(
    node: Node, tmp_path: Path
) -> None:
    """On a busy machine its reader may be found only when several reports are due."""
    namespace = truth_topic(tmp_path).rsplit("/", 1)[0]
    recorder = start(tmp_path / "bag", "lockstep:=true")
    publishers = {
        topic: node.create_publisher(
            qos.message_class(topic.type), f"{namespace}/{topic.name}", qos.offered(topic)
        )
        for topic in topics.PER_STEP
    }
    for publisher in publishers.values():
        wait_for(publisher)
    steps = 3 * topics.RECORDING_REPORT
    for _ in range(steps):
        for topic, publisher in publishers.items():
            publisher.publish(qos.message_class(topic.type)())
        time.sleep(0.005)
    time.sleep(0.3)
    assert recorder.poll() is None
    told: list[int] = []
    executor = SingleThreadedExecutor(context=node.context)
    simulator = rclpy.create_node(topics.PLANT, namespace=namespace, context=node.context)
    executor.add_node(simulator)
    topic = topics.RECORDED_STEPS
    simulator.create_subscription(
        qos.message_class(topic.type), topic.name, lambda m: told.append(m.data), qos.requested(topic, True)
    )
    deadline = time.monotonic() + 20.0
    while not told:
        assert recorder.poll() is None, recorder.stdout.read() if recorder.stdout else ""
        assert time.monotonic() < deadline, "nothing was told"
        executor.spin_once(timeout_sec=0.05)
    simulator.destroy_node()
    recorder.send_signal(signal.SIGINT)
    assert recorder.wait(20.0) == 0
    assert told[0] > 2 * topics.RECORDING_REPORT
