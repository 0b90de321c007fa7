"""Reads a bag while it is being written."""

from __future__ import annotations

from pathlib import Path

from auv_sim.bags.reading.bag_reader import read_bag


def has_message(directory: Path, topic: str) -> bool:
    """Return whether a bag already has a message of a topic (full name); a new file has none."""
    if not any(file.stat().st_size for file in directory.glob("*.mcap")):
        return False
    found = read_bag(directory).topics.get(topic)
    return found is not None and found.count > 0
