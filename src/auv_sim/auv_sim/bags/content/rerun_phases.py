"""The phases of recorded missions: at which odometry one began, was held, resumed or ended."""

from __future__ import annotations

from itertools import groupby
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_path_following.missions import mission_state as states
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import Bag


class Phase(NamedTuple):
    """Whether the mission runs at an odometry, and whether it began or resumed after a hold there."""

    runs: bool
    begins: bool
    resumes: bool


def phases_of(bag: Bag, namespace: str | None, thrust: NDArray[np.float64]) -> list[Phase]:
    """Return the mission's phase at each odometry.

    Guidance's desired thrust shows exactly from which odometry on a mission ran. Where it falls to 0
    because the path's end was reached, that odometry was still guided; after an abort it was not.
    """
    topic = bag.find(topics.MISSION_STATE.name, namespace)
    recorded = [str(message.data) for _, message in messages_of(topic)] if topic is not None else []
    words = [word for word, _ in groupby(recorded)]  # the state is repeated once a second
    place, ran, rows = 0, False, []
    for value in thrust:
        runs = bool(value > 0.0)
        begins = resumes = guided = False
        if runs and not ran:
            before = words[place - 1] if 0 < place <= len(words) else ""
            while place < len(words) and words[place] != MissionState.RUNNING:
                before = words[place]
                place += 1
            resumes = before == MissionState.HOLDING
            begins = not resumes
            place += 1
        elif ran and not runs:
            guided = place >= len(words) or words[place] == MissionState.COMPLETE
        rows.append(Phase(runs or guided, begins, resumes))
        ran = runs
    return rows


def in_phase(mission: states.MissionStatus, phase: Phase) -> states.MissionStatus:
    """Return the recorded state; a mission that holds or is complete changes only through its own law."""
    if phase.resumes:
        return states.MissionStatus(states.HOLDING)
    if phase.runs:
        changes = mission.state in (states.HOLDING, states.COMPLETE) or states.is_surfacing(mission)
        return mission if changes else states.MissionStatus(states.RUNNING)
    return mission if mission.state == states.COMPLETE else states.MissionStatus()
