"""Repairs a damaged or unfinished recording: keeps what is readable, with an index and metadata.yaml."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from rosbags.interfaces import Qos
from rosbags.rosbag2.metadata import dump_qos_v9, parse_qos

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.definitions import Definition
from auv_sim.bags.metadata import METADATA_FILE, FileMetadata, TopicMetadata, information, write
from auv_sim.bags.reading.bag_files import NO_METADATA, companions
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.recording import Bag, RecordedTopic
from auv_sim.bags.reading.storage.mcap_scan import NOT_CLOSED, scan
from auv_sim.bags.texts import TEXTS
from auv_sim.bags.writing.bag_writer import BagWriter, Channel

#: Suffix of a file that was replaced.
KEPT = ".damaged"
#: Storage formats as rosbag2 names them, by the files' suffix.
_STORAGE = {".mcap": "mcap", ".db3": "sqlite3"}
#: Bytes that are gathered before they are written.
HELD = 4_000_000


@dataclass(frozen=True)
class Repaired:
    """The result of a repair.

    Attributes:
        directory: the repaired recording.
        messages: their number.
        notes: damage and losses, a line each; empty for a whole recording.
        kept: the damaged files, renamed; none when all of their content was saved.
    """

    directory: Path
    messages: int
    notes: list[str]
    kept: list[Path]


def repair(path: Path, out: Path | None = None, compression: str = "zstd") -> Repaired:
    """Write a recording anew from what is readable.

    Args:
        path: a recording (directory, run directory or storage file).
        out: directory of the repaired one; None replaces the damaged one.
        compression: of the new chunks.

    Raises:
        ConfigurationError: nothing is readable, or the place cannot be written; the recording is unchanged.
    """
    bag = read_bag(path)
    directory = bag.path if bag.path.is_dir() else bag.path.parent
    if out is None and not bag.notes and bag.path.is_dir():
        return Repaired(bag.path, bag.count, [], [])
    storage = {_STORAGE.get(file.suffix) for file in bag.files}
    if out is None and bag.notes == [NO_METADATA] and len(storage) == 1 and (name := storage.pop()):
        return _described(bag, name)
    if out is not None:
        return _written(bag, out, compression)
    if bag.path.is_file():
        # A bare file becomes a recording of its own beside it.
        target = bag.path.with_suffix("")
        if target.exists():
            raise ConfigurationError(str(target), "something with this name", "--out DIRECTORY")
        return _written(bag, target, compression)
    try:
        with tempfile.TemporaryDirectory(prefix=".repairing-", dir=directory) as draft:
            done = _written(bag, Path(draft) / "bag", compression, directory.resolve().name)
            kept = _replace(bag, directory, done)
    except OSError as error:
        raise ConfigurationError(str(directory), f"{error.strerror}", "a place to write to") from None
    return Repaired(directory, done.messages, done.notes, kept)


def _described(bag: Bag, storage: str) -> Repaired:
    """Write the metadata.yaml that whole files lack, and nothing else."""
    files, begin = [], 0
    for file, count in bag.files.items():
        times = [topic.log_ns[k] for topic, k in bag.order[begin : begin + count]]
        begin += count
        first, last = min(times, default=0), max(times, default=0)
        files.append(FileMetadata(file.name, first, last, count, file.stat().st_size))
    topics = [_facts(topic) for topic in bag.topics.values()]
    try:
        write(bag.path, information(topics, files, storage))
    except OSError as error:
        raise ConfigurationError(str(bag.path), f"{error.strerror}", "a place to write to") from None
    return Repaired(bag.path, bag.count, bag.notes, [])


def _facts(topic: RecordedTopic) -> TopicMetadata:
    encoding, type_hash = "cdr", ""
    if topic.original is not None:
        channel, _ = topic.original
        encoding, type_hash = channel.message_encoding, channel.metadata.get("topic_type_hash", "")
    qos = list(dump_qos_v9(_offered(topic)))
    return TopicMetadata(topic.name, topic.type, topic.count, qos, type_hash, encoding)


def _replace(bag: Bag, directory: Path, done: Repaired) -> list[Path]:
    """Replace the old files by the new ones; a crash in between leaves both.

    Only the recording's own files are renamed or deleted, and none is overwritten.
    """
    metadata = [directory / METADATA_FILE] if (directory / METADATA_FILE).exists() else []
    old_files, new_files = [*bag.files, *metadata], sorted(done.directory.iterdir())
    for new in new_files:
        place = directory / new.name
        if os.path.lexists(place) and place not in old_files:
            raise ConfigurationError(str(place), "something with this name", "--out DIRECTORY")
    kept = []
    for old in old_files:
        aside = _aside(old)
        kept.append(old.replace(aside))
        # Under the name that SQLite expects.
        kept += [path.replace(f"{aside}{suffix}") for path, suffix in companions(old)]
    for new in new_files:
        new.replace(directory / new.name)
    # Only a recording that merely lacks its end is complete in the new files.
    if all(note.endswith((NOT_CLOSED, NO_METADATA)) for note in done.notes):
        for old in kept:
            old.unlink()
        return []
    return kept


def _aside(old: Path) -> Path:
    """Return an unused name for the old file."""
    name, number = old.with_name(old.name + KEPT), 1
    while os.path.lexists(name):
        number += 1
        name = old.with_name(f"{old.name}{KEPT}-{number}")
    return name


def _written(bag: Bag, directory: Path, compression: str, name: str | None = None) -> Repaired:
    """Write the recording to a new directory, or none at all."""
    if compression not in ("none", "zstd"):
        raise ConfigurationError("compression", repr(compression), "none or zstd")
    known: dict[str, Definition] = {}
    writer = BagWriter(
        directory,
        compression,  # type: ignore[arg-type]
        texts=bag.texts,
        name=name,
        definitions=known,
        profile=bag.profile,
    )
    try:
        with writer:
            _copy(bag, writer, known)
            if not writer.close():
                raise _no_room(writer)
        lost = _lost(bag, directory)
    except BaseException:
        shutil.rmtree(directory, ignore_errors=True)
        raise
    return Repaired(directory, sum(writer.counts.values()), [*bag.notes, *lost], [])


def _copy(bag: Bag, writer: BagWriter, known: dict[str, Definition]) -> None:
    for record in bag.records:
        writer.copy(record)
    if not writer.flush():
        raise _no_room(writer)
    channels = {topic.name: _announced(topic, writer, known) for topic in bag.topics.values()}
    for topic, k in bag.order:
        data = topic.messages[k]
        assert data is not None  # everything was read
        writer.write(channels[topic.name], topic.log_ns[k], topic.publish_ns[k], data, topic.sequence[k])
        if writer.pending > HELD and not writer.flush():
            raise _no_room(writer)


def _announced(topic: RecordedTopic, writer: BagWriter, known: dict[str, Definition]) -> Channel:
    """Add the topic unchanged; one without a definition gets that of its type's name."""
    if topic.original is not None and (topic.definition or topic.encoding != "ros2msg"):
        return writer.copy_topic(*topic.original, _offered(topic))
    known.setdefault(topic.type, Definition(topic.definition, ""))
    return writer.add_topic(topic.name, topic.type, _offered(topic))


def _no_room(writer: BagWriter) -> ConfigurationError:
    return ConfigurationError(str(writer.directory), writer.trouble, "room for the whole recording")


def _lost(bag: Bag, directory: Path) -> list[str]:
    """Read the written files again, and return what was readable before and is missing in them."""
    found: Counter[str] = Counter()
    others = texts = 0
    for file in directory.glob("*.mcap"):
        numbers: Counter[int] = Counter()

        def count(channel: int, *_: object, numbers: Counter[int] = numbers) -> None:
            numbers[channel] += 1

        result = scan(file, count)
        for number, channel in result.channels.items():
            found[channel.topic] += numbers[number]
        others += len(result.attachments) + len(result.metadata) - 1  # one is metadata.yaml again
        texts += any(record.name == TEXTS for record in result.metadata)
    lost = [
        f"{topic.count - found[topic.name]} of {topic.count} messages on {topic.name} could not be kept"
        for topic in bag.topics.values()
        if topic.count > found[topic.name]
    ]
    missing = len(bag.records) - (others - texts)
    return [*lost, f"{missing} metadata records or attachments could not be kept"] if missing else lost


def _offered(topic: RecordedTopic) -> list[Qos]:
    try:
        return list(parse_qos(yaml_file.parse_text(topic.qos, topic.name)))
    except (ConfigurationError, ValueError, KeyError, TypeError, AttributeError):
        return []
