"""How many steps are recorded in full: one message of every topic that has one per step."""

from __future__ import annotations


class CompleteSteps:
    """Counts the messages of several topics; the least of the counts is the number of complete steps.

    Args:
        topics: how many topics have one message a step.
    """

    def __init__(self, topics: int) -> None:
        self._counts = [0] * topics
        self._ahead = 0
        self.steps = 0

    def add(self, topic: int) -> bool:
        """Count a message of topic number `topic` (from 0); whether it completed a step."""
        counts = self._counts
        counts[topic] += 1
        if counts[topic] == self.steps + 1:
            self._ahead += 1
            if self._ahead == len(counts):
                self.steps += 1
                self._ahead = sum(count > self.steps for count in counts)
                return True
        return False
