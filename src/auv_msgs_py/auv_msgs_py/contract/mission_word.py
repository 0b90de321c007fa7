"""The words of `mission_state`, and how a reader takes them: no single message ends a mission. ROS-free.

A subscription does not say which publisher a message came from. So a reader relies on how guidance publishes:
a new state `TIMES` times in a row, and any state again once every `PERIOD`. Guidance therefore contradicts a
single word of another publisher within that time.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping

from auv_msgs_py.contract.topics import MISSION_STATE
from auv_msgs_py.values.errors import MessageRefused

#: Number of messages with which guidance publishes a new state.
TIMES = 2
#: Period at which guidance repeats its state, s of wall time (in lockstep of mission time).
PERIOD = 1.0
#: A word that was heard once counts if nothing contradicts it for this long, s of wall time.
ALONE = 1.5 * PERIOD


class MissionState(enum.StrEnum):
    """Every state of a mission, as the word on the wire. Pure steps use its index in this order."""

    IDLE = "idle"
    RUNNING = "running"
    HOLDING = "holding"
    COMPLETE = "complete"
    ABORTED = "aborted"


#: States in which a mission has begun and has not ended.
UNDER_WAY = (MissionState.RUNNING, MissionState.HOLDING)
_WORDS = tuple(state.value for state in MissionState)


class MissionWord:
    """The state that counts.

    `running` counts at once: it moves nothing without a thrust. Any other word counts when it is heard twice
    in a row, or once and nothing else for `ALONE` s. The first word ever heard counts, too.
    """

    def __init__(self) -> None:
        self._word = ""
        self._once: tuple[str, float] | None = None

    def hear(self, word: str, now: float) -> MessageRefused | None:
        """Take a message.

        Args:
            word: what the message holds.
            now: steady time, s.

        Returns:
            The refusal of an earlier word that was heard once and is contradicted by this one.

        Raises:
            MessageRefused: `word` is no `MissionState`.
        """
        if word not in _WORDS:
            raise MessageRefused(MISSION_STATE.name, f"'{word}'", ", ".join(_WORDS))
        self.at(now)
        once, self._once = self._once, None
        is_second = once is not None and once[0] == word
        if is_second or not self._word or word in (MissionState.RUNNING, self._word):
            self._word = word
        else:
            self._once = word, now
        if once is None or is_second:
            return None
        return MessageRefused(
            MISSION_STATE.name, f"'{once[0]}' once among '{word}'", "a state that is repeated"
        )

    def at(self, now: float) -> str:
        """Return the state that counts at `now` (steady time, s); empty before the first word."""
        if self._once is not None and now - self._once[1] >= ALONE:
            self._word, self._once = self._once[0], None
        return self._word


def number_in(status: Mapping[str, str], key: str) -> float:
    """Return a finite number of a `mission_status`; NaN where there is none."""
    try:
        value = float(status.get(key, ""))
    except ValueError:
        return math.nan
    return value if math.isfinite(value) else math.nan
