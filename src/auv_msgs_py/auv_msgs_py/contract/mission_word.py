"""The mission's state as its readers take it: no single message ends anything. ROS-free.

A subscription does not say which publisher a message came from. So a reader relies on how guidance publishes:
a new state `TIMES` times in a row, and any state again once every `PERIOD`. Guidance therefore contradicts a
single word of another publisher within that time.
"""

from __future__ import annotations

from collections.abc import Iterable

from auv_msgs_py.contract.topics import MISSION_STATE
from auv_msgs_py.values.errors import MessageRefused

RUNNING = "running"
#: How often guidance publishes a new state at once.
TIMES = 2
#: After this long guidance publishes its state again, s of wall time (in lockstep of mission time).
PERIOD = 1.0
#: A word that nothing contradicts for this long counts even if it was heard once, s of wall time.
ALONE = 1.5 * PERIOD


class MissionWord:
    """The state that counts.

    `running` counts at once: it moves nothing without a thrust. Any other word counts when it is heard twice
    in a row, or once and nothing else for `ALONE` s. The first word ever heard counts, too.

    Args:
        words: the states that there are.
    """

    def __init__(self, words: Iterable[str]) -> None:
        self._words = tuple(words)
        self._word = ""
        self._once: tuple[str, float] | None = None

    def hear(self, word: str, now: float) -> MessageRefused | None:
        """Take in a message.

        Args:
            word: the state.
            now: steady time, s.

        Returns:
            The refusal of an earlier word that was heard once and is contradicted by this one.

        Raises:
            MessageRefused: there is no such state.
        """
        if word not in self._words:
            raise MessageRefused(MISSION_STATE.name, f"'{word}'", ", ".join(self._words))
        self.at(now)
        once, self._once = self._once, None
        if word in (RUNNING, self._word) or not self._word or (once is not None and once[0] == word):
            self._word = word
        else:
            self._once = word, now
        if once is None or once[0] == word:
            return None
        return MessageRefused(
            MISSION_STATE.name, f"'{once[0]}' once among '{word}'", "a state that is repeated"
        )

    def at(self, now: float) -> str:
        """Return the state that counts at `now` (steady time, s); empty before the first word."""
        if self._once is not None and now - self._once[1] >= ALONE:
            self._word, self._once = self._once[0], None
        return self._word
