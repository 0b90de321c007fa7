"""Reads rosbag2's SQLite storage, whole or damaged; the file and its companions are never changed."""

from __future__ import annotations

import contextlib
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mcap.records import Channel, Schema

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.bag_files import companions
from auv_sim.bags.reading.recording import Bag, RecordedTopic, TopicFilter
from auv_sim.bags.reading.storage.sqlite_pages import Row, rows_of

_SQLITE = "a rosbag2 SQLite file"
#: Errors of a damaged file, in which even names of columns may be no text.
_DAMAGE = (sqlite3.Error, UnicodeError)
_TABLES = ("topics", "messages")
#: Lengths of values are limited to the file's size, but at least to this, for the schema of a small file.
_LEAST_LENGTH = 100_000


@dataclass
class _Content:
    """Number of a topic -> topic; the rows seen, messages and others; the reason why reading ended early."""

    topics: dict[int, RecordedTopic] = field(default_factory=dict)
    seen: set[int] = field(default_factory=set)
    messages: int = 0
    strange: int = 0
    trouble: str = ""


def read_sqlite(bag: Bag, file: Path, keeps: TopicFilter) -> None:
    """Add a file to a recording.

    Raises:
        ConfigurationError: it holds no topics that can be read.
    """
    content = _Content()
    with _opened(file) as (connection, readable):
        try:
            for topic, number in _topics(connection):
                content.topics[number] = _joined(bag, file, topic)
        except _DAMAGE as error:
            raise ConfigurationError(
                str(file), f"a recording that cannot be read ({error})", _SQLITE
            ) from None
        try:
            query = "SELECT id, topic_id, timestamp, data FROM messages NOT INDEXED ORDER BY id"
            for row in connection.execute(query):
                _take(bag, content, row, keeps)
        except _DAMAGE as error:
            content.trouble = str(error)
        if content.trouble:
            before = content.messages
            for row in sorted(row for row in rows_of(readable) if row[1] in content.topics):
                _take(bag, content, row, keeps)
            further = content.messages - before
            content.trouble += f"; {before} messages are readable, {further} more page by page"
    bag.notes += [f"{file.name}: {note}" for note in _notes(file, content)]


def _notes(file: Path, content: _Content) -> Iterator[str]:
    if content.trouble:
        yield content.trouble
    if content.strange:
        yield f"{content.strange} rows are no messages: left out"
    for beside in _unmerged(file):
        yield f"{beside.name} lies beside it (the recording was not closed): read too"


def _unmerged(file: Path) -> list[Path]:
    """Return the companions of a file that was not closed; opening the file would merge them into it."""
    return [path for path, suffix in companions(file) if suffix != "-shm" and path.stat().st_size]


@contextlib.contextmanager
def _opened(file: Path) -> Iterator[tuple[sqlite3.Connection, Path]]:
    """Open the file, or a copy where companions must be merged first; yield connection and file."""
    beside = _unmerged(file)
    with contextlib.ExitStack() as stack:
        readable, mode = file, "mode=ro&immutable=1"
        try:
            if beside:
                directory = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="auv-bag-")))
                for path in (file, *beside):
                    shutil.copyfile(path, directory / path.name)
                readable, mode = directory / file.name, "mode=rw"
            connection = sqlite3.connect(f"{readable.absolute().as_uri()}?{mode}", uri=True)
        except OSError as error:
            raise ConfigurationError(str(file), f"{error.strerror}", "room for a copy of it") from None
        except _DAMAGE as error:
            raise ConfigurationError(str(file), str(error), _SQLITE) from None
        stack.callback(connection.close)
        connection.text_factory = lambda text: text.decode("utf-8", "replace")
        connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, max(file.stat().st_size, _LEAST_LENGTH))
        yield connection, readable


def _topics(connection: sqlite3.Connection) -> Iterator[tuple[RecordedTopic, int]]:
    """Yield each topic with its number.

    Raises:
        sqlite3.Error: no such tables, or they cannot be read.
    """
    connection.execute("PRAGMA trusted_schema = OFF")
    # A truncated file has fewer pages than its header states; with this the library reads those it has.
    connection.execute("PRAGMA writable_schema = ON")
    query = "SELECT name FROM sqlite_master WHERE type = 'table' AND sql LIKE 'CREATE TABLE%'"
    tables = {name for (name,) in connection.execute(query)}
    missing = [name for name in _TABLES if name not in tables]
    if missing:
        raise sqlite3.DatabaseError(f"no table {' and no table '.join(missing)}")
    definitions: dict[str, tuple[str, str]] = {}
    if "message_definitions" in tables:
        with contextlib.suppress(*_DAMAGE):  # rosbag2 has it since Iron; topics are readable without
            query = "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
            definitions = {
                str(name): (str(kind), str(text)) for name, kind, text in connection.execute(query)
            }
    cursor = connection.execute("SELECT * FROM topics ORDER BY id")
    names = [column[0] for column in cursor.description]
    for values in cursor:
        row: dict[str, Any] = dict(zip(names, values, strict=True))
        if isinstance(row.get("id"), int):
            yield _topic(row, definitions), row["id"]


def _topic(row: dict[str, Any], definitions: dict[str, tuple[str, str]]) -> RecordedTopic:
    """Return a topic from its row; a column that an older rosbag2 lacked is empty."""
    name, type_name, encoding, qos, type_hash = (
        str(row.get(column) or "")
        for column in (
            "name",
            "type",
            "serialization_format",
            "offered_qos_profiles",
            "type_description_hash",
        )
    )
    topic = RecordedTopic(name, type_name, qos=qos)
    if type_name in definitions:
        topic.encoding, topic.definition = definitions[type_name]
        described = {"offered_qos_profiles": qos, "topic_type_hash": type_hash}
        topic.original = (
            Channel(id=0, topic=name, message_encoding=encoding or "cdr", metadata=described, schema_id=1),
            Schema(id=1, data=topic.definition.encode(), encoding=topic.encoding, name=type_name),
        )
    return topic


def _joined(bag: Bag, file: Path, topic: RecordedTopic) -> RecordedTopic:
    """Return the recording's topic of this name; one of another type stays separate and is not read."""
    there = bag.topics.setdefault(topic.name, topic)
    if there.type != topic.type:
        bag.notes.append(f"{file.name}: messages of a second type {topic.type!r} on {topic.name} left out")
        return topic
    return there


def _take(bag: Bag, content: _Content, row: Row, keeps: TopicFilter) -> None:
    """Append a message, once; a row of other values than a message's is counted."""
    number, topic_number, log_ns, data = row
    if number in content.seen:
        return
    content.seen.add(number)
    topic = content.topics.get(topic_number) if isinstance(topic_number, int) else None
    if topic is None or not isinstance(log_ns, int) or log_ns < 0 or not isinstance(data, bytes):
        content.strange += 1
        return
    content.messages += 1
    if bag.topics.get(topic.name) is topic:
        bag.order.append((topic, topic.count))
        topic.put(0, log_ns, log_ns, data, keeps(topic.name, topic.type))
