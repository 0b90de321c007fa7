"""The life of a mission: idle, running, holding, complete, aborted. No ROS, no clock of its own."""

from __future__ import annotations

import enum

from auv_msgs_py.settings import setting, settings


class State(enum.StrEnum):
    """The words on the wire."""

    IDLE = "idle"
    RUNNING = "running"
    HOLDING = "holding"
    COMPLETE = "complete"
    ABORTED = "aborted"


@settings
class HoldingConfig:
    """How long a running mission bears missing navigation, in ROS time."""

    hold_after: float = setting(
        1.0,
        "without navigation for this long the mission holds: thrust 0",
        unit="s",
        ge=0.1,
        le=60.0,
        live=True,
    )
    abort_after: float = setting(
        30.0, "holding for this long ends the mission", unit="s", ge=0.1, le=3600.0, live=True
    )


class MissionState:
    """The only place where the state changes; every change has a reason for people."""

    def __init__(self, config: HoldingConfig | None = None) -> None:
        self.config = config or HoldingConfig()
        self.state = State.IDLE
        self.reason = "waiting for the start service"
        self._since: float | None = None

    @property
    def running(self) -> bool:
        """Whether the vehicle may be driven."""
        return self.state is State.RUNNING

    @property
    def under_way(self) -> bool:
        """Whether a mission was started and has not ended."""
        return self.state in (State.RUNNING, State.HOLDING)

    def start(self) -> bool:
        """Begin (anew) from idle, complete or aborted; False when a mission is under way already."""
        if self.under_way:
            return False
        self._to(State.RUNNING, "started")
        return True

    def abort(self, reason: str) -> None:
        """End the mission, begun or not; the first reason stays, and a completed one stays complete."""
        if self.state not in (State.COMPLETE, State.ABORTED):
            self._to(State.ABORTED, reason)

    def complete(self) -> None:
        """The end of the path was reached."""
        if self.state is State.RUNNING:
            self._to(State.COMPLETE, "the end of the path was reached")

    def navigation_lost(self, reason: str, now: float) -> None:
        """Nothing usable came for `hold_after` seconds; `now` is ROS time, s."""
        if self.state is State.RUNNING:
            self._to(State.HOLDING, reason)
            self._since = now

    def navigation_back(self) -> None:
        """Usable navigation came: go on from where the mission held."""
        if self.state is State.HOLDING:
            self._to(State.RUNNING, "navigation is back")

    def tick(self, now: float) -> None:
        """Let time pass; `now` is ROS time, s. Holding for too long aborts."""
        if self.state is not State.HOLDING or self._since is None:
            return
        if now < self._since:  # the clock went back
            self._since = now
        elif now - self._since > self.config.abort_after:
            self.abort(f"held for more than {self.config.abort_after:g} s: {self.reason}")

    def _to(self, state: State, reason: str) -> None:
        self.state, self.reason = state, reason
        self._since = None
