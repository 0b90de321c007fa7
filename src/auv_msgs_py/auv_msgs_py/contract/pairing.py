"""Pair the messages that belong to one step. ROS-free.

Why pairing cannot go wrong in lockstep
---------------------------------------
DDS keeps the order within a topic, not across topics, and a Float64 has no stamp. Pairing therefore counts
messages. Four rules make counting safe:

1. The simulator publishes the odometry of step k+1 only after *both* commands for step k have arrived.
2. A node publishes its outputs for step k only once it holds *all* of its inputs for step k, and it
   publishes each output exactly once.
3. A node publishes only after every reader of its topics is matched (`lockstep_gate`), and all readers are
   reliable, so nothing is lost and nothing comes twice.
4. The thrust (0 or not) says whether the mission runs, never the order in which `mission_state` and the
   other topics arrive.

Suppose every node has answered steps 0..k-1 (true for k = 0). After the odometry of step k no message of
step k+1 exists until both commands of step k were received (1). These were published after the autopilot
held all of its inputs of step k (2), those by guidance after it held its own (2), and so on. So when a
message of step k+1 is published every slot has been filled and emptied for step k: at most one message of
each topic is under way at any time, and the n-th message of a topic is the one of step n. A slot that is
filled twice, or two stamps that differ, proves that a rule was broken (by a foreign publisher on the topic,
for example): `put` raises, and the flight ends.
"""

from __future__ import annotations

from typing import Any

from auv_msgs_py.values.errors import LockstepBroken


class Pairing:
    """One slot per topic; complete when every slot is filled.

    Args:
        topics: the topics to wait for; the first is the trigger.
        strict: in lockstep a slot filled twice and unequal stamps raise. Otherwise the newest message counts.
    """

    def __init__(self, topics: tuple[str, ...], strict: bool) -> None:
        self.topics = topics
        self.strict = strict
        self._slots: dict[str, Any] = {}
        self._stamp: int | None = None

    def put(self, topic: str, value: Any, stamp: int | None = None) -> bool:
        """Fill a slot.

        Args:
            topic: one of the topics.
            value: what to keep.
            stamp: nanoseconds, for a message that has one.

        Returns:
            Whether every slot is filled; `take` returns the values.

        Raises:
            LockstepBroken: strict only: the slot is full, or the stamps differ.
        """
        if self.strict:
            if topic in self._slots:
                raise LockstepBroken(
                    f"{topic}: a second message within one step (is there a second publisher?)"
                )
            if stamp is not None:
                if self._stamp is not None and stamp != self._stamp:
                    raise LockstepBroken(f"{topic}: stamp {stamp} ns in the step of {self._stamp} ns")
                self._stamp = stamp
        self._slots[topic] = value
        return len(self._slots) == len(self.topics)

    def take(self) -> tuple[Any, ...]:
        """Return the values in the order of `topics`, None for an empty slot, and empty all slots."""
        values = tuple(self._slots.get(topic) for topic in self.topics)
        self.clear()
        return values

    def clear(self) -> None:
        """Empty all slots."""
        self._slots.clear()
        self._stamp = None

    @property
    def missing(self) -> tuple[str, ...]:
        """Topics that the current step lacks; none before its first message."""
        if not self._slots:
            return ()
        return tuple(topic for topic in self.topics if topic not in self._slots)

    def __contains__(self, topic: str) -> bool:
        return topic in self._slots
