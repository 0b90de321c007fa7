"""Watch message rates, the clock and foreign publishers, without looking into a message. ROS-free."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from auv_msgs_py.contract import topics


class RateWatch:
    """Find topics on which messages come faster than any vehicle sends them.

    Args:
        highest: largest plausible rate, Hz of ROS time.
    """

    #: Shortest time over which rates are taken, s.
    window = 0.2

    def __init__(self, highest: float) -> None:
        self.highest = highest
        self.counts: Counter[str] = Counter()
        self._at: float | None = None
        self._warning = ""

    def floods(self, now: float) -> dict[str, float] | None:
        """Return the rates that are too high (Hz) by topic; None until `window` has passed."""
        if self._at is not None and 0.0 <= now - self._at < self.window:
            return None
        before, self._at = self._at, now
        counts, self.counts = self.counts, Counter()
        if before is None or now < before:
            return {}
        rates = {topic: count / (now - before) for topic, count in counts.items()}
        return {topic: rate for topic, rate in rates.items() if rate > self.highest}

    def warning(self, now: float) -> str:
        """Return the rates that are too high as a text; empty when none is."""
        rates = self.floods(now)
        if rates is not None:
            text = ", ".join(f"{name} comes at {rate:.0f} Hz" for name, rate in rates.items())
            self._warning = f"{text}: more than {self.highest:g} Hz" if text else ""
        return self._warning


class ClockWatch:
    """Find that simulated time stands still, by a steady clock.

    Args:
        bound: longest standstill that is not reported, s.
    """

    def __init__(self, bound: float = 2.0) -> None:
        self.bound = bound
        self._now = 0.0
        self._since: float | None = None

    def stands_still(self, now: float, steady: float) -> bool:
        """Take ROS time and steady time, s; a clock that was never set does not stand still."""
        if now != self._now or self._since is None:
            self._now, self._since = now, steady
        return self._now > 0.0 and steady - self._since > self.bound


def second_publishers(node: Any, names: Sequence[str], of_one_name: bool = False) -> str:
    """Return which of these topics several nodes publish, as a text: the contract has one publisher for each.

    Args:
        node: rclpy's, for its view of the graph.
        names: of the topics, relative.
        of_one_name: whether several publishers of one node name count as well.
    """
    found = []
    for name in names:
        if node.count_publishers(name) > 1:
            infos = node.get_publishers_info_by_topic(node.resolve_topic_name(name))
            nodes = Counter(topics.full_name(info.node_namespace, info.node_name) for info in infos)
            if len(nodes) > 1 or (of_one_name and len(infos) > 1):
                texts = [f"{n} ({count} times)" if count > 1 else n for n, count in sorted(nodes.items())]
                found.append(f"{name} is published by {', '.join(texts)}")
    return "; ".join(found)
