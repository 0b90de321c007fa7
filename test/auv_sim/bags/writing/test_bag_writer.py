from __future__ import annotations

import io
import shutil
from pathlib import Path

import pytest
import yaml
from mcap.exceptions import McapError
from mcap.reader import NonSeekingReader, make_reader
from mcap.records import ChunkIndex
from mcap.stream_reader import StreamReader
from rosbags.highlevel import AnyReader
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.writing.bag_writer import BagWriter, typestore

INFINITE = QosTime(9223372036, 854775807)
RELIABLE = Qos(
    QosHistory.KEEP_LAST, 10, QosReliability.RELIABLE, QosDurability.VOLATILE,
    INFINITE, INFINITE, QosLiveliness.AUTOMATIC, INFINITE, False,
)  # fmt: skip
FLOAT, STRING = "std_msgs/msg/Float64", "std_msgs/msg/String"


def number(value: float) -> bytes:
    store = typestore()
    return bytes(store.serialize_cdr(store.types[FLOAT](value), FLOAT))


def text(value: str) -> bytes:
    store = typestore()
    return bytes(store.serialize_cdr(store.types[STRING](value), STRING))


def write_bag(directory: Path, compression: str = "none", chunk_size: int = 1024 * 1024) -> None:
    with BagWriter(directory, compression, chunk_size) as writer:  # type: ignore[arg-type]
        rudder = writer.add_topic("/auv/rudder_cmd", FLOAT, [RELIABLE])
        state = writer.add_topic("/auv/mission_state", STRING, [RELIABLE, RELIABLE])
        writer.add_topic("/auv/thrust_cmd", FLOAT, [])
        for k in range(100):
            writer.write(rudder, 1_000 + 10 * k, 900 + 10 * k, number(0.5 * k))
            if k % 10 == 0:
                writer.write(state, 1_005 + 10 * k, 905 + 10 * k, text(f"state {k}"))
        assert writer.counts == {"/auv/rudder_cmd": 100, "/auv/mission_state": 10, "/auv/thrust_cmd": 0}


@pytest.mark.parametrize(("compression", "chunk_size"), [("none", 1024 * 1024), ("none", 500), ("zstd", 500)])
def test_both_readers_find_what_was_written(tmp_path: Path, compression: str, chunk_size: int) -> None:
    write_bag(tmp_path / "bag", compression, chunk_size)
    with AnyReader([tmp_path / "bag"]) as reader:
        assert {c.topic: (c.msgtype, c.msgcount) for c in reader.connections} == {
            "/auv/rudder_cmd": (FLOAT, 100),
            "/auv/mission_state": (STRING, 10),
            "/auv/thrust_cmd": (FLOAT, 0),
        }
        # AnyReader decodes with the definitions in the file, so this tests them as well.
        seen = [(c.topic, t, reader.deserialize(raw, c.msgtype).data) for c, t, raw in reader.messages()]
    numbers = [(t, value) for topic, t, value in seen if topic == "/auv/rudder_cmd"]
    assert numbers == [(1_000 + 10 * k, 0.5 * k) for k in range(100)]
    texts = [(t, value) for topic, t, value in seen if topic == "/auv/mission_state"]
    assert texts == [(1_005 + 100 * k, f"state {10 * k}") for k in range(10)]

    with (tmp_path / "bag" / "bag_0.mcap").open("rb") as stream:
        raw = make_reader(stream, validate_crcs=True)
        assert raw.get_header().profile == "ros2"
        found = [(c.topic, m.log_time, m.publish_time, m.data) for _, c, m in raw.iter_messages()]
        summary = raw.get_summary()
    assert ("/auv/rudder_cmd", 1_010, 910, number(0.5)) in found
    assert len(found) == 110
    assert summary is not None and summary.statistics is not None
    assert summary.statistics.message_count == 110
    assert (summary.statistics.chunk_count > 3) == (chunk_size == 500)
    assert {chunk.compression for chunk in summary.chunk_indexes} == {"zstd" if compression == "zstd" else ""}


def test_metadata_as_rosbag2_writes_it(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag")
    content = yaml.safe_load((tmp_path / "bag" / "metadata.yaml").read_text())
    information = content["rosbag2_bagfile_information"]
    assert list(information) == [
        "version", "storage_identifier", "duration", "starting_time", "message_count",
        "topics_with_message_count", "compression_format", "compression_mode", "relative_file_paths",
        "files", "custom_data", "ros_distro",
    ]  # fmt: skip
    assert information["version"] == 9
    assert information["storage_identifier"] == "mcap"
    assert information["ros_distro"] == "jazzy"
    assert information["relative_file_paths"] == ["bag_0.mcap"]
    assert information["message_count"] == 110
    assert information["starting_time"] == {"nanoseconds_since_epoch": 1_000}
    assert information["duration"] == {"nanoseconds": 990}
    topic = information["topics_with_message_count"][0]
    assert topic["message_count"] == 100
    assert topic["topic_metadata"] == {
        "name": "/auv/rudder_cmd",
        "type": FLOAT,
        "serialization_format": "cdr",
        "offered_qos_profiles": [
            {
                "history": "keep_last",
                "depth": 10,
                "reliability": "reliable",
                "durability": "volatile",
                "deadline": {"sec": 9223372036, "nsec": 854775807},
                "lifespan": {"sec": 9223372036, "nsec": 854775807},
                "liveliness": "automatic",
                "liveliness_lease_duration": {"sec": 9223372036, "nsec": 854775807},
                "avoid_ros_namespace_conventions": False,
            }
        ],
        # The hash that ROS 2 Jazzy's own std_msgs carries for Float64.
        "type_description_hash": "RIHS01_705ba9c3d1a09df43737eb67095534de36fd426c0587779bda2bc51fe790182a",
    }
    assert not list((tmp_path / "bag").glob("*.tmp"))


def test_the_storage_file_tells_the_same_as_metadata(tmp_path: Path) -> None:
    write_bag(tmp_path / "bag")
    information = yaml.safe_load((tmp_path / "bag" / "metadata.yaml").read_text())[
        "rosbag2_bagfile_information"
    ]
    with (tmp_path / "bag" / "bag_0.mcap").open("rb") as stream:
        reader = make_reader(stream)
        (record,) = list(reader.iter_metadata())
        summary = reader.get_summary()
    assert record.name == "rosbag2"
    assert yaml.safe_load(record.metadata["serialized_metadata"]) == information
    assert summary is not None
    topics = {
        t["topic_metadata"]["name"]: t["topic_metadata"] for t in information["topics_with_message_count"]
    }
    assert len(summary.channels) == len(topics) == 3
    for channel in summary.channels.values():
        topic = topics[channel.topic]
        assert set(channel.metadata) == {"offered_qos_profiles", "topic_type_hash"}
        assert channel.metadata["topic_type_hash"] == topic["type_description_hash"]
        assert yaml.safe_load(channel.metadata["offered_qos_profiles"]) == topic["offered_qos_profiles"]
        schema = summary.schemas[channel.schema_id]
        assert (channel.message_encoding, schema.name, schema.encoding) == ("cdr", topic["type"], "ros2msg")
    assert {s.name for s in summary.schemas.values()} == {FLOAT, STRING}


def test_flush_bounds_what_a_kill_can_lose(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "bag")
    rudder = writer.add_topic("/rudder_cmd", FLOAT, [RELIABLE])
    for k in range(50):
        writer.write(rudder, k, k, number(k))
    assert readable(writer.file, tmp_path) == []
    writer.flush()
    for k in range(50, 60):
        writer.write(rudder, k, k, number(k))
    assert readable(writer.file, tmp_path) == [number(k) for k in range(50)]
    late = writer.add_topic("/late", FLOAT, [RELIABLE])
    writer.write(late, 60, 60, number(-1.0))
    writer.flush()
    assert readable(writer.file, tmp_path) == [number(k) for k in range(60)] + [number(-1.0)]
    writer.flush()
    writer.close()
    assert len(readable(writer.file, tmp_path)) == 61
    records = StreamReader(io.BytesIO(writer.file.read_bytes())).records
    assert sum(isinstance(record, ChunkIndex) for record in records) == 2, "a flush without messages is free"


def readable(file: Path, tmp_path: Path) -> list[bytes]:
    """What a reader gets from a copy of the file as it is on disk now."""
    copy = shutil.copy(file, tmp_path / "copy.mcap")
    reader = NonSeekingReader(io.BytesIO(Path(copy).read_bytes()))
    found = []
    try:
        for _, _, message in reader.iter_messages(log_time_order=False):
            found.append(message.data)
    except (McapError, OSError):
        pass  # the file ends in mid-air, as it does after a kill
    return found


def test_an_empty_recording_is_a_recording(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/rudder_cmd", FLOAT, [RELIABLE])
    with AnyReader([tmp_path / "bag"]) as reader:
        assert [c.topic for c in reader.connections] == ["/rudder_cmd"]
        assert reader.message_count == 0


def test_what_is_refused(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/rudder_cmd", FLOAT, [])
        with pytest.raises(ConfigurationError, match=r"/rudder_cmd: found a topic that is recorded already"):
            writer.add_topic("/rudder_cmd", FLOAT, [])
        with pytest.raises(ConfigurationError, match=r"/odd: found the type odd_msgs/msg/Odd"):
            writer.add_topic("/odd", "odd_msgs/msg/Odd", [])
    before = (tmp_path / "bag" / "metadata.yaml").read_bytes()
    with pytest.raises(ConfigurationError, match="expected a new directory"):
        BagWriter(tmp_path / "bag")
    with pytest.raises(ConfigurationError, match="expected none or zstd"):
        BagWriter(tmp_path / "other", "lz4")  # type: ignore[arg-type]
    assert not (tmp_path / "other").exists()
    writer.close()
    assert (tmp_path / "bag" / "metadata.yaml").read_bytes() == before


def test_further_files_begin_with_what_is_latched(tmp_path: Path) -> None:
    """A state per publisher, under its own number and time; readers of all files get it once."""
    with BagWriter(tmp_path / "bag", max_duration_ns=100) as writer:
        rudder = writer.add_topic("/rudder_cmd", FLOAT, [RELIABLE])
        latched = RELIABLE._replace(durability=QosDurability.TRANSIENT_LOCAL)
        state = writer.add_topic("/mission_state", STRING, [latched, latched])
        state.latched = 2
        for k in range(3):
            writer.write(state, 1_000 + k, 900 + k, text(f"state {k}"), k + 1)
        for k in range(100):
            writer.write(rudder, 1_010 + 10 * k, 910 + 10 * k, number(0.5 * k), k + 1)
            writer.flush()
    files = sorted((tmp_path / "bag").glob("*.mcap"), key=lambda file: int(file.stem.rsplit("_", 1)[1]))
    assert len(files) > 3
    counted = 0
    for file in files:
        with file.open("rb") as stream:
            reader = make_reader(stream)
            found = [(c.topic, m.sequence, m.publish_time, m.data) for _, c, m in reader.iter_messages()]
            summary = reader.get_summary()
        assert summary is not None and summary.statistics is not None
        counted += summary.statistics.message_count
        newest = [("/mission_state", k + 1, 900 + k, text(f"state {k}")) for k in (1, 2)]
        assert [entry for entry in found if entry[0] == "/mission_state"][-2:] == newest
    bag = read_bag(tmp_path / "bag")
    assert {name: topic.count for name, topic in bag.topics.items()} == {
        "/rudder_cmd": 100,
        "/mission_state": 3,
    }
    assert len(bag.order) == 103
    assert bag.notes == []
    information = yaml.safe_load((tmp_path / "bag" / "metadata.yaml").read_text())
    information = information["rosbag2_bagfile_information"]
    assert information["message_count"] == counted == 103 + 2 * (len(files) - 1)
    assert sum(topic["message_count"] for topic in information["topics_with_message_count"]) == counted
