"""The recorder as a process over real DDS: nothing lost, killed at any moment, a full disk, replay."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from operator import attrgetter
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
from rclpy.serialization import deserialize_message
from rosbags.highlevel import AnyReader
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import qos, topics
from auv_sim.bags.bag_repair import repair
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.growing_bag import has_message
from recorder_bench import PATIENCE, STARTED, recorded, start, stop, talk, truth_topic, wait, wait_for

#: What a crash may lose at most, s.
BOUND = 1.0
#: Messages of each topic that are counted: those of all topics fit into the recorder's transport queue of
#: 512, however long it gets no processor time.
COUNTED = 80
#: Attempts at a measurement that a pause of one of the processes spoils.
ATTEMPTS = 5


@pytest.fixture(autouse=True)
def nothing_left_running() -> Iterator[None]:
    """A test that failed half-way leaves no recorder behind."""
    yield
    while STARTED:
        process = STARTED.pop()
        process.kill()
        process.wait()
        if process.stdout is not None:
            process.stdout.close()


@pytest.fixture(scope="module")
def node(module_domain: int) -> Iterator[Node]:
    context = Context()
    rclpy.init(context=context, domain_id=module_domain)
    made = rclpy.create_node("talker", namespace="/auv", context=context)
    yield made
    made.destroy_node()
    rclpy.try_shutdown(context=context)


def test_counts_equal_those_published(tmp_path: Path, node: Node) -> None:
    """Contract topics, a latched word said before the recorder was there, others by name and by pattern."""
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    space = truth_topic(tmp_path).rsplit("/", 1)[0]
    state = node.create_publisher(String, f"{space}/mission_state", latched)
    state.publish(String(data="running"))
    truth = node.create_publisher(Vector3Stamped, truth_topic(tmp_path), 10)
    names = [f"{space}/{name}" for name in ("by_name", "pattern_1", "pattern_2", "not_this")]
    extra = [node.create_publisher(Float64, name, 10) for name in names]
    settings = "topics:=by_name", "regex:=/pattern_", "max_duration:=0.5", "flush_period:=0.1"
    process = start(tmp_path / "bag", *settings)
    chosen = [truth_topic(tmp_path), *names[:3]]

    def publish(value: float) -> None:
        message = Vector3Stamped()
        message.vector.x = value
        truth.publish(message)
        for publisher in extra:
            publisher.publish(Float64(data=value))
        time.sleep(0.02)

    for publisher in (truth, *extra[:3]):
        wait_for(publisher)

    def are_all_heard() -> bool:
        publish(-1.0)
        return all(recorded(tmp_path / "bag", name) for name in chosen)

    wait(are_all_heard)
    for k in range(COUNTED):
        publish(float(k))
    output = stop(process)
    assert "0 dropped" in output
    bag = read_bag(tmp_path / "bag")
    assert bag.notes == []
    assert len(bag.files) >= 2
    counts = {name: topic.count for name, topic in bag.topics.items() if topic.count}
    counts.pop("/diagnostics", None)
    counts.pop("/rosout", None)
    counts.pop("/parameter_events", None)
    assert counts.keys() == {*chosen, f"{space}/mission_state"}
    assert counts[f"{space}/mission_state"] == 1
    for name in chosen:
        kind, value = (Vector3Stamped, "vector.x") if name == chosen[0] else (Float64, "data")
        found = [attrgetter(value)(deserialize_message(m, kind)) for m in bag.topics[name].messages]
        assert [number for number in found if number >= 0.0] == list(range(COUNTED))
    assert "transient_local" in bag.topics[f"{space}/mission_state"].qos
    for publisher in (state, truth, *extra):
        node.destroy_publisher(publisher)


def lost_by_kill(directory: Path, node: Node, after: float) -> float:
    """Kill a recorder `after` s after its first message is on the disk, and repair its bag.

    Returns:
        Time before the kill of which nothing was recorded, s, without the pauses of this process.
    """
    topic = truth_topic(directory.parent)
    truth = node.create_publisher(Vector3Stamped, topic, 10)
    process = start(directory)
    wait_for(truth)
    # Its reader is matched before the recorder has come to its first flush; from then on the bound holds.
    talk(truth, until=lambda: has_message(directory, topic))
    end = time.monotonic() + after
    longest = talk(truth, until=lambda: time.monotonic() > end)
    process.kill()
    killed = time.time()
    process.wait()
    node.destroy_publisher(truth)
    newest = max(read_bag(directory).topics[topic].publish_ns) * 1e-9
    done = repair(directory)
    with AnyReader([directory]) as reader:
        assert sum(1 for _ in reader.messages()) == done.messages
    with next(directory.glob("*.mcap")).open("rb") as stream:
        assert sum(1 for _ in make_reader(stream, validate_crcs=True).iter_messages()) == done.messages
    return killed - newest - longest


@pytest.mark.parametrize("seed", range(3))
def test_killed_at_any_moment(tmp_path: Path, node: Node, seed: int) -> None:
    """A recorder that gets no processor time just before it is killed loses more; then it is killed again."""
    after = random.Random(seed).uniform(0.0, 1.5)
    lost = [lost_by_kill(tmp_path / "bag0", node, after)]
    while lost[-1] >= BOUND and len(lost) < ATTEMPTS:
        lost.append(lost_by_kill(tmp_path / f"bag{len(lost)}", node, after))
    assert lost[-1] < BOUND


def test_a_full_disk_is_reported_and_what_is_there_stays_readable(tmp_path: Path, node: Node) -> None:
    truth = node.create_publisher(Vector3Stamped, truth_topic(tmp_path), 10)
    process = start(tmp_path / "bag", "compression:=none", limit=20_000)
    wait_for(truth)
    # Slowly: the first flush may be late, and has to fit on the disk.
    talk(truth, until=lambda: has_message(tmp_path / "bag", truth_topic(tmp_path)), period=0.02)
    before = len(recorded(tmp_path / "bag", truth_topic(tmp_path)))
    for _ in range(400):
        truth.publish(Vector3Stamped())
        time.sleep(0.005)
    output = stop(process)
    assert "cannot write bag_0.mcap: File too large" in output
    assert "bag.py repair" in output
    bag = read_bag(tmp_path / "bag")
    assert bag.topics[truth_topic(tmp_path)].count >= before > 0
    assert repair(tmp_path / "bag").messages == bag.count
    node.destroy_publisher(truth)


def replayed(directory: Path, first: Path, node: Node) -> Any:
    """Replay a bag at twice its pace into a recorder; what that one has recorded of the topic."""
    process = start(directory)
    ready = node.create_publisher(Vector3Stamped, truth_topic(directory.parent), 10)
    wait_for(ready)
    node.destroy_publisher(ready)
    code = "import sys; from auv_sim.cli.bag import main; sys.exit(main(sys.argv[1:]))"
    replay = [sys.executable, "-c", code, "replay", str(first), "--topics", "true_current"]
    done = subprocess.run(
        [*replay, "--rate", "2", "--delay", "1.5"], env=dict(os.environ), timeout=PATIENCE, check=False
    )
    assert done.returncode == 0
    time.sleep(0.2)
    stop(process)
    return read_bag(directory).topics[truth_topic(directory.parent)]


def test_replay_repeats_messages_and_qos(tmp_path: Path, node: Node) -> None:
    """Replayed again where a pause of the replay or of its recorder spoils the pace."""
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
    first = read_bag(tmp_path / "first").topics[truth_topic(tmp_path)]
    half = pytest.approx((max(first.log_ns) - min(first.log_ns)) / 2, rel=0.2)
    for attempt in range(ATTEMPTS):
        second = replayed(tmp_path / f"again{attempt}", tmp_path / "first", node)
        span = max(second.log_ns, default=0) - min(second.log_ns, default=0)
        if second.messages == first.messages and span == half:
            break
    assert second.messages == first.messages
    assert span == half


def test_in_lockstep_a_simulator_that_is_discovered_late_is_told_the_newest_count(
    node: Node, tmp_path: Path
) -> None:
    """On a busy machine its reader may be found only when several reports are due."""
    namespace = truth_topic(tmp_path).rsplit("/", 1)[0]
    recorder = start(tmp_path / "bag", "lockstep:=true", "flush_period:=0.1")
    publishers = {
        topic: node.create_publisher(
            qos.message_class(topic.type), f"{namespace}/{topic.name}", qos.offered(topic)
        )
        for topic in topics.PER_STEP
    }
    for publisher in publishers.values():
        wait_for(publisher)
    for k in range(1, 4):
        for _ in range(topics.RECORDING_REPORT):  # fewer than a publisher keeps
            for topic, publisher in publishers.items():
                publisher.publish(qos.message_class(topic.type)())
        steps = k * topics.RECORDING_REPORT  # counted before they are on the disk
        names = [f"{namespace}/{topic.name}" for topic in publishers]
        wait(lambda names=names, n=steps: all(len(recorded(tmp_path / "bag", s)) == n for s in names))  # type: ignore[misc]
    assert recorder.poll() is None
    reported: list[int] = []
    executor = SingleThreadedExecutor(context=node.context)
    simulator = rclpy.create_node(topics.PLANT, namespace=namespace, context=node.context)
    executor.add_node(simulator)
    topic = topics.RECORDED_STEPS
    simulator.create_subscription(
        qos.message_class(topic.type),
        topic.name,
        lambda m: reported.append(m.data),
        qos.requested(topic, True),
    )

    def has_reported() -> bool:
        assert recorder.poll() is None, recorder.stdout.read() if recorder.stdout else ""
        executor.spin_once(timeout_sec=0.05)
        return bool(reported)

    wait(has_reported)
    simulator.destroy_node()
    recorder.send_signal(signal.SIGINT)
    assert recorder.wait(PATIENCE) == 0
    assert reported[0] > 2 * topics.RECORDING_REPORT
