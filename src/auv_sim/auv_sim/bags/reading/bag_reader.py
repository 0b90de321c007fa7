"""Reads any recording: a rosbag2 directory or a bare storage file, closed or not, of any writer."""

from __future__ import annotations

import tempfile
from pathlib import Path

from zstandard import ZstdError

from auv_msgs_py.values.errors import ConfigurationError, printable
from auv_sim.bags.metadata import METADATA_FILE
from auv_sim.bags.reading.bag_files import A_BAG, files_of, information_of, storage_of
from auv_sim.bags.reading.recording import Bag, TopicFilter
from auv_sim.bags.reading.storage.mcap_bag import read_mcap
from auv_sim.bags.reading.storage.packed import SUFFIX as PACKED
from auv_sim.bags.reading.storage.packed import unpack, unpack_message


def everything(_: str, __: str) -> bool:
    """Keep every message."""
    return True


def read_bag(path: Path, keeps: TopicFilter = everything, odometry: str | None = None) -> Bag:
    """Read a recording; of a damaged one, all that is readable.

    Args:
        path: a rosbag2 directory, a run directory with one in it, or a storage file.
        keeps: which topics' messages to keep.
        odometry: full name of the vehicle's odometry topic.

    Raises:
        ConfigurationError: there is no recording, or nothing of it can be read.
    """
    path = storage_of(path)
    bag = Bag(path, odometry=odometry)
    information = information_of(path, bag.notes) if path.is_dir() else {}
    files = files_of(path, information, bag.notes)
    if not files:
        found = f"no {METADATA_FILE}" if path.is_dir() and not information else "no storage files"
        raise ConfigurationError(str(path), found, A_BAG)
    troubles: list[ConfigurationError] = []
    for file in files:
        try:
            _read_any(bag, file, keeps)
        except ConfigurationError as error:
            troubles.append(error)
            bag.notes.append(f"{file.name}: found {error.found}")
        bag.files[file] = len(bag.order) - sum(bag.files.values())
        bag.size += file.stat().st_size
    if len(troubles) == len(files):
        raise troubles[0]
    if str(information.get("compression_mode")).lower() == "message":
        _unpack_messages(bag)
    expected = information.get("message_count")
    if isinstance(expected, int) and expected > bag.count + bag.repeated:
        readable = bag.count + bag.repeated
        bag.notes.append(f"{METADATA_FILE} lists {expected} messages, {readable} are readable")
    bag.notes = [printable(note) for note in bag.notes]
    return bag


def _read_any(bag: Bag, file: Path, keeps: TopicFilter) -> None:
    """Add one storage file of any kind."""
    # The other kinds are imported when met: few recordings are of them, and `rosbags` loads slowly.
    if file.suffix == PACKED:
        with tempfile.TemporaryDirectory(prefix="auv-bag-") as directory:
            _read_any(bag, unpack(file, Path(directory)), keeps)
    elif file.suffix == ".db3":
        from auv_sim.bags.reading.storage.sqlite_bag import read_sqlite

        read_sqlite(bag, file, keeps)
    elif file.suffix == ".bag":
        from auv_sim.bags.reading.storage.ros1_bag import read_ros1

        read_ros1(bag, file, keeps)
    else:
        read_mcap(bag, file, keeps)


def _unpack_messages(bag: Bag) -> None:
    """Replace every packed message by its content; count the unreadable ones in a note."""
    unreadable = 0
    for topic in bag.topics.values():
        for k, data in enumerate(topic.messages):
            if data is not None:
                try:
                    content = unpack_message(data)
                except ZstdError:
                    unreadable += 1
                    continue
                topic.messages[k], topic.sizes[k] = content, len(content)
    if unreadable:
        bag.notes.append(f"{unreadable} messages are not packed, though {METADATA_FILE} says so")
