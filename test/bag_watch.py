"""Looking into a bag while it is being written."""

from __future__ import annotations

from pathlib import Path

from auv_sim.recording.bag import read_bag


def recorded(directory: Path, topic: str) -> bool:
    """Whether the bag has a message of a topic (its full name) by now."""
    if not any(directory.glob("*.mcap")):
        return False
    found = read_bag(directory).topics.get(topic)
    return found is not None and found.count > 0
