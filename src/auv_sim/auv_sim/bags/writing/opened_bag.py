"""The bag of a recorder: its parameters checked, its directory made."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.bags.writing.disk_room import room_lacking
from auv_sim.command_line import to_type
from auv_sim.sim_parameters import RecorderParameters


def _check_patterns(parameters: RecorderParameters, node: str) -> None:
    """Check the patterns for topics.

    Raises:
        ConfigurationError: one is no regular expression; it names the node.
    """
    for name in ("regex", "exclude"):
        try:
            re.compile(getattr(parameters, name))
        except re.error as error:
            where = f"{node}: parameter {name}"
            raise ConfigurationError(where, str(error), "a regular expression") from None


def open_bag(
    parameters: RecorderParameters, directory: Path, texts: Mapping[str, str], node: str
) -> BagWriter:
    """Return the writer of a new bag.

    Args:
        parameters: of the recorder.
        directory: the bag's.
        texts: the flown configuration by file name.
        node: name of the recorder, for messages.

    Raises:
        ConfigurationError: a pattern is none, the directory exists, or the disk has too little room.
    """
    p = parameters
    _check_patterns(p, node)
    if os.path.lexists(directory):
        raise ConfigurationError(f"{node}: parameter directory", f"{directory}, which exists", "a new one")
    if short := room_lacking(directory, p.min_free_space):
        raise ConfigurationError(f"{node}: parameter min_free_space", *short)
    size, duration = p.max_size * 1_000_000, round(p.max_duration * 1e9)
    return BagWriter(directory, p.compression, max_size=size, max_duration_ns=duration, texts=texts)


def closed(writer: BagWriter, lost: Mapping[str, int]) -> list[str]:
    """Close a bag; return what there is to say about it, a line each.

    Args:
        writer: of the bag.
        lost: messages that never came, by topic.
    """
    whole, place, counts = writer.close(), writer.directory, writer.counts
    missing = sum(lost.values()) + writer.given_up
    lines = [f"{place}: {sum(counts.values())} messages of {len(counts)} topics, {missing} dropped"]
    lines += [f"{place}: {number} messages of {name} never came" for name, number in lost.items()]
    if not whole:
        advice = f"{to_type('bag.py', 'repair', place)} makes it whole"
        lines.append(f"{place}: left unfinished ({writer.trouble}); {advice}")
    return lines
