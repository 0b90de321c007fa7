"""The recorder in this process: room on the disk, its default directory, what further files begin with."""

from __future__ import annotations

import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import rclpy
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.writing import disk_room
from auv_sim.nodes import recorder_node
from auv_sim.nodes.recorder_node import RecorderNode
from node_bench import Bench


class Disk:
    """What is free on it, MB."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, free: int) -> None:
        self.free = free
        usage = shutil.disk_usage("/")
        monkeypatch.setattr(
            disk_room.shutil, "disk_usage", lambda _: usage._replace(free=self.free * 1_000_000)
        )


def test_a_recording_is_closed_before_the_disk_is_full(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = Disk(monkeypatch, 201)
    node: Any = bench.start(RecorderNode, directory=str(tmp_path / "bag"))
    state = bench.node.create_publisher(String, "mission_state", qos.offered(topics.MISSION_STATE))
    bench.until(lambda: state.get_subscription_count() > 0)
    state.publish(String(data="running"))
    bench.until(lambda: node.writer.counts["/auv/mission_state"] == 1)
    disk.free = 199
    bench.until(lambda: node.writer.closed)
    node.health.publish()
    bench.until(lambda: bench.diagnosed("the recording was closed: 199 MB free"))
    assert not node.fault  # a vehicle flies on without its recorder
    bag = read_bag(tmp_path / "bag")
    assert bag.notes == []
    assert bag.topics["/auv/mission_state"].count == 1
    state.publish(String(data="complete"))
    bench.until(lambda: node.writer.given_up > 0)
    assert read_bag(tmp_path / "bag").notes == []


def test_in_lockstep_it_ends_the_mission(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = Disk(monkeypatch, 201)
    steps = topics.RECORDED_STEPS
    bench.node.create_subscription(qos.message_class(steps.type), steps.name, print, 1)
    node: Any = bench.start(RecorderNode, directory=str(tmp_path / "bag"), lockstep=True)
    disk.free = 100
    bench.until(lambda: bool(node.fault))
    assert "100 MB free" in node.fault
    assert "expected at least 200 MB" in node.fault


@pytest.mark.parametrize(("least", "refused"), [(200, True), (50, False), (0, False)])
def test_a_disk_without_room_is_refused_at_the_start(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, least: int, refused: bool
) -> None:
    Disk(monkeypatch, 100)
    settings = {"directory": str(tmp_path / "new" / "bag"), "min_free_space": least}
    if refused:
        with pytest.raises(ConfigurationError, match=r"found 100 MB free for .*, expected at least 200 MB"):
            bench.start(RecorderNode, **settings)
        assert not (tmp_path / "new").exists()
    else:
        bench.start(RecorderNode, **settings)


def test_the_default_directory_is_a_new_one_each_time(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bag").mkdir()
    node: Any = bench.start(RecorderNode)
    name = node.writer.directory.name
    assert name.startswith("bag-20")
    assert [path.name for path in tmp_path.iterdir() if path.name != "bag"] == [name]


def test_each_file_begins_with_what_is_latched(bench: Bench, tmp_path: Path) -> None:
    state = bench.node.create_publisher(String, "mission_state", qos.offered(topics.MISSION_STATE))
    state.publish(String(data="running"))  # already there: the first file may be over soon
    node: Any = bench.start(RecorderNode, directory=str(tmp_path / "bag"), max_duration=0.3, flush_period=0.1)
    bench.until(lambda: len(list((tmp_path / "bag").glob("*.mcap"))) > 2)
    node.writer.close()
    files = sorted((tmp_path / "bag").glob("*.mcap"))
    for file in files:
        topic = read_bag(file).topics[f"/auv/{topics.MISSION_STATE.name}"]
        assert [b"running" in (message or b"") for message in topic.messages] == [True]
    bag = read_bag(tmp_path / "bag")
    assert bag.topics[f"/auv/{topics.MISSION_STATE.name}"].count == 1
    assert bag.notes == []


def test_the_timer_rests_while_the_simulator_asks(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [100.0]
    monkeypatch.setattr(recorder_node, "time", SimpleNamespace(monotonic=lambda: now[0]))
    node: Any = bench.start(RecorderNode, directory=str(tmp_path / "bag"))
    fetched: list[float] = []
    node.selection.topics[0].take = lambda _: fetched.append(now[0])
    node._poll()
    node._poll_unless_asked()
    assert len(fetched) == 1
    now[0] += recorder_node._POLL
    node._poll_unless_asked()
    assert len(fetched) == 2


def test_flushes_in_quick_succession_look_at_the_disk_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [100.0]
    monkeypatch.setattr(disk_room, "time", SimpleNamespace(monotonic=lambda: now[0]))
    disk = Disk(monkeypatch, 201)
    watch = disk_room.RoomWatch(tmp_path)
    assert watch.lacking(200) is None
    disk.free = 100
    assert watch.lacking(200) is None
    now[0] += disk_room.PERIOD + 1e-6
    assert watch.lacking(200) == (f"100 MB free for {tmp_path}", "at least 200 MB")


def test_in_lockstep_it_fetches_on_request(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The timer is far away: what is reported was fetched because the simulator asked."""
    monkeypatch.setattr(recorder_node, "_POLL", 1000.0)
    told: list[int] = []
    steps = topics.RECORDED_STEPS
    kind = qos.message_class(steps.type)
    profile = qos.requested(steps, reliable=True)
    simulator = rclpy.create_node(topics.PLANT, namespace="/auv")
    bench.executor.add_node(simulator)
    simulator.create_subscription(kind, steps.name, lambda message: told.append(message.data), profile)
    ask = simulator.create_publisher(kind, topics.RECORD_REQUEST.name, qos.offered(topics.RECORD_REQUEST))
    per_step = {
        topic: bench.node.create_publisher(qos.message_class(topic.type), topic.name, qos.offered(topic))
        for topic in topics.PER_STEP
    }
    node: Any = bench.start(RecorderNode, directory=str(tmp_path / "bag"), lockstep=True)
    bench.until(lambda: all(p.get_subscription_count() for p in (ask, *per_step.values())))
    bench.until(lambda: not node.gate_waits_for())
    for _ in range(topics.RECORDING_REPORT):
        for topic, publisher in per_step.items():
            publisher.publish(qos.message_class(topic.type)())
        bench.spin(0.01)
    bench.spin(0.3)
    assert told == []
    ask.publish(kind(data=topics.RECORDING_REPORT))
    bench.until(lambda: told == [topics.RECORDING_REPORT])
    simulator.destroy_node()


@pytest.mark.parametrize(("lockstep", "depth"), [(False, qos.DEPTH), (True, topics.RECORDING_LEAD)])
def test_a_bag_states_the_depth_that_publishers_offer(
    bench: Bench, tmp_path: Path, lockstep: bool, depth: int
) -> None:
    """Discovery does not carry it, so it stays what the contract promises when a publisher is met."""
    profile = qos.offered(topics.RUDDER_CMD, lockstep)
    rudder = bench.node.create_publisher(Float64, topics.RUDDER_CMD.name, profile)
    steps = topics.RECORDED_STEPS
    bench.node.create_subscription(qos.message_class(steps.type), steps.name, print, 1)
    node: Any = bench.start(RecorderNode, directory=str(tmp_path / "bag"), lockstep=lockstep)
    followed = {topic.name: topic for topic in node.selection.topics}
    expected = {"/auv/rudder_cmd": depth, "/auv/path": 1, "/diagnostics": qos.DEPTH}
    for _ in range(2):
        assert {name: followed[name].channel.qos[0]["depth"] for name in expected} == expected
        bench.until(rudder.get_subscription_count)
        rudder.publish(Float64())
        bench.until(lambda: followed["/auv/rudder_cmd"].known)
