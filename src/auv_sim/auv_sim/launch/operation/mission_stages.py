"""The stages of one mission: the graph is free, all nodes listen, the vehicle is there, it flies."""

from __future__ import annotations

import math
import time
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.node.run import StopRequest
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.operation import console_child
from auv_sim.launch.operation.stand_by import StandBy
from auv_sim.launch.outcome import MissionFailed, Outcome
from auv_sim.launch.processes.placement import Processor
from auv_sim.launch.processes.process_group import Children, Starter
from auv_sim.launch.progress_display import ProgressDisplay

#: Longest wall time for all nodes to discover each other, s.
DISCOVERY_BOUND = 60.0
#: Longest wall time until a foreign vehicle's first odometry, s.
_VEHICLE_BOUND = 120.0
#: Wall time without a step of the simulator after which the mission has failed, s. The simulator reports a
#: node that does not answer well before; this bound covers what it cannot detect.
STALL_BOUND = 60.0


class MissionStages:
    """Takes one mission through its stages, and checks its processes all the while.

    Args:
        plan: what to fly.
        children: the processes.
        loader: of the nodes.
        monitor: the launcher's node.
        progress: the display on the terminal.
        interrupt: of Ctrl-C.
        processor: where lockstep places the processes.
    """

    def __init__(
        self, plan: Plan, children: Children, loader: Starter, monitor: Any, progress: ProgressDisplay,
        interrupt: StopRequest, processor: Processor,
    ) -> None:  # fmt: skip
        self._plan, self._children, self._loader = plan, children, loader
        self._monitor, self._progress = monitor, progress
        self._interrupt, self._processor = interrupt, processor
        #: The newest stamp, and since when it has been that, by wall time.
        self._moved = -1, math.inf

    def run(self, look: float) -> Outcome:
        """Fly, after observing the graph for at least `look` s."""
        begin = time.monotonic()
        if not self._graph_free(look) or not self._all_listening() or not self._vehicle_there():
            return Outcome("interrupted", "stopped before the mission began", time.monotonic() - begin, 0.0)
        self._processor.place(self._children.ids)
        self._look.check()
        if self._plan.options.waits:
            if self._plan.options.console:
                lines = console_child.addresses(self._children, self._monitor.look)
                self._progress.say(lines, needed=True)
            m = self._monitor
            return StandBy(self._plan, m, self._progress, self._interrupt, self._check_progress).run()
        refused = self._monitor.start()
        if refused:
            raise MissionFailed(f"the mission could not be started: {refused}")
        if not self._plan.lockstep:
            self._monitor.first_stamp = None  # rows before the start are not part of the mission
        begin = time.monotonic()
        state = self._until_over(begin)
        wall = time.monotonic() - begin
        self._monitor.look(0.05)
        self._progress.update(self._monitor.s, self._monitor.ye, self._monitor.mission_time, wall)
        reason = ""
        if state == "interrupted":
            reason = "stopped by a signal"
            self._stop_vehicle()
        elif state == "aborted":
            reason = self._why_aborted()
        return Outcome(state, reason, wall, self._monitor.mission_time)

    def _graph_free(self, look: float) -> bool:
        """Observe the graph for `look` s and until all nodes have loaded; they enter it after that.

        A busy machine discovers late and loads late: waiting for the loaded nodes allows for both.

        Returns:
            False when interrupted.

        Raises:
            GraphTaken: another process holds what this mission claims.
        """
        self._look = self._monitor.look_around(self._plan.claim(), look)
        while not self._look.ended(self._loader.at_gate()):
            if self._interrupt.requested:
                return False
            self._check_children()
            self._monitor.look(0.02)
        self._loader.open_gate()
        return True

    def _all_listening(self) -> bool:
        """Wait until every node subscribes to its topics; False when interrupted."""
        names = set(self._plan.parameters)
        deadline = time.monotonic() + DISCOVERY_BOUND
        while not self._interrupt.requested:
            self._check_children()
            self._look.check()
            missing = self._monitor.missing_nodes(names, topics.RECORDER in names)
            if not missing:
                return True
            self._progress.waiting_for(", ".join(sorted(missing)))
            if time.monotonic() > deadline:
                raise MissionFailed(f"no sign of {', '.join(sorted(missing))} within {DISCOVERY_BOUND:g} s")
            self._monitor.look(0.05)
        return False

    def _vehicle_there(self) -> bool:
        """Without the simulator, wait for a vehicle's odometry; False when interrupted."""
        deadline = time.monotonic() + _VEHICLE_BOUND
        topic = topics.full_name(self._plan.options.namespace, topics.ODOM.name)
        while not self._plan.options.simulator and not self._monitor.odometry_seen:
            if self._interrupt.requested:
                return False
            self._check_children()
            self._progress.waiting_for(f"a vehicle's {topic}")
            if time.monotonic() > deadline:
                raise MissionFailed(
                    f"no odometry on {topic} within {_VEHICLE_BOUND:g} s: is the vehicle's driver running?"
                )
            self._monitor.look(0.1)
        return True

    def _until_over(self, begin: float) -> str:
        m = self._monitor
        while not self._interrupt.requested:
            self._check_progress(m.state != MissionState.HOLDING)
            m.look(0.1)
            self._progress.update(m.s, m.ye, m.mission_time, time.monotonic() - begin)
            if m.completed(self._plan.mission.path.n):
                return "complete"
            if m.state == "aborted":
                return "aborted"
        return "interrupted"

    def _check_progress(self, has_to_pass: bool) -> None:
        """Check the processes, and the simulator's time where it has to pass: in a hold it may stand still.

        Raises:
            MissionFailed: a process ended, or time stood still for `STALL_BOUND` s.
        """
        self._check_children()
        stamp, now = self._monitor.stamp, time.monotonic()
        if stamp != self._moved[0] or not has_to_pass:
            self._moved = stamp, now
        elif self._plan.options.simulator and now - self._moved[1] > STALL_BOUND:
            at = self._monitor.mission_time
            raise MissionFailed(f"time stood still at {at:.2f} s of the mission for {STALL_BOUND:g} s")

    def _stop_vehicle(self) -> None:
        """Abort, and allow time for the zero commands to reach the vehicle: no propeller may keep running."""
        self._monitor.abort()
        self._monitor.look(0.3)

    def _why_aborted(self) -> str:
        for child in self._children:
            for line in reversed(child.last_lines(20)):
                if "aborted: " in line:
                    return str(line.split("aborted: ", 1)[1])
        return "the mission was aborted"

    def _check_children(self) -> None:
        dead = self._children.dead()
        if dead is not None:
            raise MissionFailed(dead.obituary())
