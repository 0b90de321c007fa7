"""Makes a damaged or unfinished recording whole: what is readable, with an index and metadata.yaml."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

import yaml
from rosbags.interfaces import Qos
from rosbags.rosbag2.metadata import parse_qos

from auv_msgs_py.errors import ConfigurationError
from auv_sim.recording.bag import Bag, RecordedTopic, read_bag
from auv_sim.recording.bag_writer import BagWriter
from auv_sim.recording.definitions import Definition

#: What is added to the name of a storage file that was replaced.
KEPT = ".damaged"


@dataclass(frozen=True)
class Repaired:
    """What was done.

    Attributes:
        directory: the recording that is whole now.
        messages: how many it has.
        notes: what was wrong, a line each; empty when nothing was.
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
        out: where the whole one goes; None replaces the damaged one.
        compression: of the new chunks.

    Raises:
        ConfigurationError: nothing is readable, or the place cannot be written.
    """
    bag = read_bag(path)
    directory = bag.path if bag.path.is_dir() else bag.path.parent
    if out is None and not bag.notes and bag.path.is_dir():
        return Repaired(bag.path, bag.count, [], [])
    if out is not None:
        _write(bag, out, compression)
        return Repaired(out, bag.count, bag.notes, [])
    if bag.path.is_file():
        # A bare file becomes a recording of its own beside it.
        target = bag.path.with_suffix("")
        if target.exists():
            raise ConfigurationError(str(target), "something with this name", "--out DIRECTORY")
        _write(bag, target, compression)
        return Repaired(target, bag.count, bag.notes, [])
    draft = directory.with_name(f"{directory.name}.repairing")
    shutil.rmtree(draft, ignore_errors=True)
    _write(bag, draft, compression, directory.name)
    return Repaired(directory, bag.count, bag.notes, _replace(bag, directory, draft))


def _replace(bag: Bag, directory: Path, draft: Path) -> list[Path]:
    """Put the new files in the place of the old ones; a crash in between leaves both."""
    unfinished_only = all("the end is missing" in note or "was not closed" in note for note in bag.notes)
    kept = []
    for old in bag.files:
        aside = old.with_name(old.name + KEPT)
        old.replace(aside)
        kept.append(aside)
    for new in sorted(draft.iterdir()):
        new.replace(directory / new.name)
    draft.rmdir()
    if unfinished_only:
        for aside in kept:
            aside.unlink()
        kept = []
    return kept


def _write(bag: Bag, directory: Path, compression: str, name: str | None = None) -> None:
    if compression not in ("none", "zstd"):
        raise ConfigurationError("compression", repr(compression), "none or zstd")
    known: dict[str, Definition] = {}
    with BagWriter(directory, compression, texts=bag.texts, name=name, definitions=known) as writer:  # type: ignore[arg-type]
        channels = {}
        for topic in bag.topics.values():
            if topic.type and topic.encoding in ("ros2msg", ""):
                known.setdefault(topic.type, Definition(topic.definition, ""))
                channels[topic.name] = writer.add_topic(topic.name, topic.type, _offered(topic))
        for topic, k in bag.order:
            data = topic.messages[k]
            if topic.name in channels and data is not None:
                writer.write(
                    channels[topic.name], topic.log_ns[k], topic.publish_ns[k], data, topic.sequence[k]
                )
                if writer.pending > 4_000_000:
                    writer.flush()
        if not writer.close():
            raise ConfigurationError(str(directory), writer.trouble, "room for the whole recording")


def _offered(topic: RecordedTopic) -> list[Qos]:
    try:
        return list(parse_qos(topic.qos)) if topic.qos else []
    except (ValueError, KeyError, TypeError, yaml.YAMLError, AttributeError):
        return []
