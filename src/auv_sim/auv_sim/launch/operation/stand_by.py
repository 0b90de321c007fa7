"""The launcher waits: an operator starts, holds and sets missions until Ctrl-C."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import UNDER_WAY, MissionState
from auv_msgs_py.node.run import StopRequest
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.operation.flown_missions import FlownMissions
from auv_sim.launch.outcome import Outcome
from auv_sim.launch.progress_display import ProgressDisplay

_INTERRUPTED = "stopped by a signal"
#: Looks of `_LOOK` s after an abort: those in which the zero commands reach the vehicle, as no propeller may
#: keep running; and at most for the report of how the mission ended, which DDS may send again after 3 s.
_FAREWELL, _REPORT, _LOOK = 15, 200, 0.02


def how_to_start(namespace: str, domain: str) -> str:
    """Return the command that starts the mission."""
    service = topics.full_name(namespace, topics.START_SERVICE)
    return f"ROS_DOMAIN_ID={domain} ros2 service call {service} std_srvs/srv/Trigger"


class StandBy:
    """Stays with the nodes until Ctrl-C, and shows the mission that is under way.

    Args:
        plan: what was set at the start.
        monitor: the launcher's node.
        progress: the display on the terminal.
        interrupt: of Ctrl-C.
        check: called at each look with whether time has to pass; raises `MissionFailed`.
    """

    def __init__(
        self, plan: Plan, monitor: Any, progress: ProgressDisplay, interrupt: StopRequest,
        check: Callable[[bool], None],
    ) -> None:  # fmt: skip
        self._plan, self._monitor, self._progress = plan, monitor, progress
        self._interrupt, self._check = interrupt, check
        self._digest = plan.mission.digest

    def run(self) -> Outcome:
        """Wait for Ctrl-C; return the outcome of the mission that was flown last."""
        command = how_to_start(self._plan.options.namespace, os.environ["ROS_DOMAIN_ID"])
        self._progress.say(f"start the mission: {command}\nCtrl-C ends the nodes")
        m = self._monitor
        try:
            while not self._interrupt.requested:
                self._check(m.state == MissionState.RUNNING)
                m.look(0.1)
                self._show()
            is_under_way = stop(m)
        finally:
            for mission in m.missions.flown:
                self._progress.say(mission.line)
        return outcome_of(m.missions, is_under_way, self._digest)

    def _show(self) -> None:
        m, last, state = self._monitor, self._monitor.missions.last, self._monitor.state
        if state == MissionState.HOLDING:
            self._progress.waiting_for("the service resume, or navigation: the mission holds")
        elif state != MissionState.RUNNING or last is None:
            before = f" ({last.name} is {state})" if last is not None else ""
            self._progress.waiting_for(f"the service {topics.START_SERVICE}{before}")
        else:
            if last.digest == self._digest:
                self._progress.update(m.s, m.ye, last.duration, last.wall_time)
            else:
                self._progress.update_other(last.name, last.length, m.to_go, m.ye, last.duration)


def stop(monitor: Any) -> bool:
    """Abort what is under way or could still begin; return whether a mission was under way.

    Args:
        monitor: the launcher's node in the vehicle's namespace.
    """
    missions: FlownMissions = monitor.missions
    number, last = len(missions.flown), missions.last
    was_under_way = monitor.state in UNDER_WAY if last is None else last.is_under_way
    monitor.abort()  # a complete mission refuses it
    for k in range(_REPORT):
        if k >= _FAREWELL and (missions.last is None or not missions.last.is_under_way):
            break
        monitor.look(_LOOK)
    last = missions.last
    if last is None or last.state == MissionState.COMPLETE:
        return was_under_way and last is None
    is_under_way = was_under_way or len(missions.flown) > number
    if is_under_way:
        missions.interrupt(_INTERRUPTED)
    return is_under_way


def outcome_of(missions: FlownMissions, is_under_way: bool, digest: str) -> Outcome:
    """Return the outcome of the mission that was flown last.

    Args:
        missions: that were flown.
        is_under_way: as `stop` returned it.
        digest: of the planned mission.
    """
    last = missions.last
    if last is None:
        found = ("interrupted", "stopped before the mission began") if is_under_way else ("idle", "")
        return Outcome(*found, 0.0, 0.0)
    other = "" if last.digest == digest else last.name
    reason = "" if last.state == MissionState.COMPLETE else last.reason
    return Outcome(last.state, reason, last.wall_time, last.duration, since=last.begun, other=other)
