"""A fleet waits: operators start, hold and set missions in the console until Ctrl-C."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from auv_msgs_py.node.run import StopRequest
from auv_sim.launch.fleet.fleet_plan import FleetPlan
from auv_sim.launch.fleet.fleet_progress import FleetProgress
from auv_sim.launch.operation import stand_by
from auv_sim.launch.outcome import Outcome


class FleetStandBy:
    """Stays with the nodes until Ctrl-C.

    Args:
        plan: of the fleet.
        monitors: vehicle -> the launcher's node in its namespace.
        progress: the display on the terminal.
        interrupt: of Ctrl-C.
        look: lets all monitors hear for some seconds; raises `MissionFailed` where a process has ended.
    """

    def __init__(
        self, plan: FleetPlan, monitors: Mapping[str, Any], progress: FleetProgress, interrupt: StopRequest,
        look: Callable[[float], None],
    ) -> None:  # fmt: skip
        self._plan, self._monitors, self._progress = plan, monitors, progress
        self._interrupt, self._look = interrupt, look

    def run(self) -> dict[str, Outcome]:
        """Wait for Ctrl-C; return the outcome of each vehicle's last mission."""
        if self._plan.lockstep:
            self._progress.say("the vehicles share one clock: it goes on once every mission has been started")
        self._progress.say("Ctrl-C ends the nodes")
        under_way = {}
        try:
            while not self._interrupt.requested:
                self._look(0.1)
                for label, monitor in self._monitors.items():
                    self._show(label, monitor)
            for label, monitor in self._monitors.items():
                under_way[label] = stand_by.stop(monitor)
        finally:
            for label, monitor in self._monitors.items():
                for mission in monitor.missions.flown:
                    self._progress.say(f"{label}: {mission.line}")
        return {
            label: stand_by.outcome_of(self._monitors[label].missions, is_under_way, self._digest(label))
            for label, is_under_way in under_way.items()
        }

    def _digest(self, label: str) -> str:
        return self._plan.members[label].mission.digest

    def _show(self, label: str, monitor: Any) -> None:
        last = monitor.missions.last
        if last is not None and last.digest != self._digest(label):
            self._progress.update_other(
                label, last.name, last.length, monitor.to_go, last.duration, monitor.state
            )
            return
        duration, wall = (last.duration, last.wall_time) if last is not None else (0.0, 0.0)
        self._progress.update(label, monitor.s, duration, wall, monitor.state)
