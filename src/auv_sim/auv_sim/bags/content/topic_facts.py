"""Quality of a recorded topic: rate, gaps, jitter, order, losses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from auv_sim.bags.reading.recording import Bag, RecordedTopic
from auv_sim.bags.sequence_watch import SequenceWatch

#: An interval this many times the usual one is a gap.
_GAP = 3.0
#: Fewest intervals for a rate.
_FEW = 3


@dataclass(frozen=True)
class TopicFacts:
    """One topic; None where it has too few messages, or no stamps.

    Attributes:
        name, type, count, bytes: of the topic and its messages.
        rate: messages per second between the first and the last one.
        gaps: intervals longer than three times the usual (median) one.
        longest_gap: the longest interval, s.
        jitter: standard deviation of the intervals, gaps left out, ms.
        out_of_order: header stamps older than an earlier one.
        lost: messages that were published and not received, by the sequence numbers.
    """

    name: str
    type: str
    count: int
    bytes: int
    rate: float | None
    gaps: int | None
    longest_gap: float | None
    jitter: float | None
    out_of_order: int | None
    lost: int | None


def facts_of(bag: Bag) -> list[TopicFacts]:
    """Return every topic of a bag, by name."""
    return [_facts(topic) for topic in sorted(bag.topics.values(), key=lambda topic: topic.name)]


def _facts(topic: RecordedTopic) -> TopicFacts:
    log = np.sort(np.array(topic.log_ns, np.int64))
    intervals = np.diff(log) * 1e-9
    rate = gaps = longest = jitter = None
    if intervals.size:
        longest = float(intervals.max())
        span = float(intervals.sum())
        rate = intervals.size / span if span > 0.0 else None
    if intervals.size >= _FEW:
        long = intervals > _GAP * max(float(np.median(intervals)), 1e-9)
        # Latched topics and events have no period, hence no gaps.
        if long.mean() < 0.2:
            gaps, jitter = int(long.sum()), float(intervals[~long].std() * 1e3)
    return TopicFacts(
        topic.name, topic.type, topic.count, sum(topic.sizes), rate, gaps, longest, jitter,
        _out_of_order(topic), _lost(topic),
    )  # fmt: skip


def _lost(topic: RecordedTopic) -> int | None:
    publishers = topic.qos.count("reliability:")
    if publishers != 1 or not any(topic.sequence):
        return None
    watch = SequenceWatch()
    for number in topic.sequence:
        watch.note(number, 1)
    return watch.lost


def _out_of_order(topic: RecordedTopic) -> int | None:
    stamps = header_stamps(topic)
    if stamps is None or not stamps.size:
        return None
    return int((stamps[1:] < np.maximum.accumulate(stamps)[:-1]).sum())


def header_stamps(topic: RecordedTopic) -> NDArray[np.int64] | None:
    """Return the stamps of a type that begins with a header, ns, shape (n,); None for any other."""
    if not topic.definition.lstrip().startswith(("std_msgs/Header header", "std_msgs/msg/Header header")):
        return None
    heads = [message[:12] for message in topic.messages if message is not None and len(message) >= 12]
    if not heads or heads[0][:2] != b"\0\1":
        return None
    words = np.frombuffer(b"".join(heads), "<u4").reshape(-1, 3)
    return words[:, 1].astype(np.int64) * 1_000_000_000 + words[:, 2].astype(np.int64)
