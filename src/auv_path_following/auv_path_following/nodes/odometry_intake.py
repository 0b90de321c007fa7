"""The intake of odometry in every node: converted, in order, on time and plausible."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import stamp_of
from auv_msgs_py.contract.frames import FrameTable
from auv_msgs_py.contract.stamps import Punctuality, StampGuard, StampTiming, StampVerdict
from auv_msgs_py.contract.wire import Odometry
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import MessageRefused
from auv_path_following import vehicle
from auv_path_following.navigation.depth_gate import gate_of
from auv_path_following.navigation.navigation_gate import Passed
from auv_path_following.nodes.readings import readings_of


class AcceptedOdometry(NamedTuple):
    """One accepted odometry.

    Attributes:
        navigation: pose and rates, NED: `Navigation`, or `SpatialNavigation` of a vehicle that dives.
        dt: seconds since the last accepted one.
        stamp: ns.
        restarted: whether the stamps went back before it.
        moved: whether it does not continue the last one, in place or in time.
    """

    navigation: Any
    dt: float
    stamp: int
    restarted: bool
    moved: bool


class OdometryIntake:
    """Convert and judge odometry: frames and numbers, its stamp against clock and order, plausibility.

    In lockstep no message is late and a refusal would block the step, so only frames, numbers and order are
    judged.

    Args:
        node: the node; its parameters are `NavigationParameters`.
        consequence: what the node does without odometry, for the diagnostics.
    """

    def __init__(self, node: SuiteNode, consequence: str = "") -> None:
        p = node.parameters
        self._node = node
        self._consequence = f": {consequence}" if consequence else ""
        self._free = not p.lockstep
        self._frames = FrameTable(p.frames)
        self._guard = StampGuard(ordered=p.lockstep)
        self._punctuality = Punctuality(p.lateness)
        hull = vehicle.load(p.vehicle)
        self._readings = readings_of(hull)
        self._gate = gate_of(p.gate, p.depth_gate, hull)
        self._refused_for = 0.0
        self._accepted_at: float | None = None
        self._silent = False
        #: Set by the node: whether the vehicle moves, so that an unchanged pose is an error.
        self.under_way = False
        self._heard = False
        node.health.expect("odometry", f"no {topics.ODOM.name} yet")
        if self._free:
            node.every(0.1, self._watch)

    def configure(self) -> None:
        """Take the node's parameters after a change in flight."""
        p = self._node.parameters
        self._gate.configure(p.gate, p.depth_gate)

    def reset_gate(self) -> None:
        """Accept the next pose as a first one, even an unchanged pose: a mission was started by request."""
        self._gate.reset()
        self._refused_for = 0.0

    @property
    def silent(self) -> bool:
        """Whether, free running, no odometry was accepted for longer than `odometry_timeout`."""
        return self._silent

    def _watch(self) -> None:
        now = self._node.now()
        if self._accepted_at is None or now < self._accepted_at:
            self._accepted_at = None if self._accepted_at is None else now
            return
        bound = self._node.parameters.odometry_timeout
        self._silent = now - self._accepted_at > bound
        if self._silent:
            text = f"no usable {topics.ODOM.name} for {bound:g} s{self._consequence}"
            self._node.health.error("odometry", text)

    def take(self, message: Odometry) -> AcceptedOdometry:
        """Judge one message.

        Raises:
            MessageRefused: it cannot be used.
        """
        stamp = stamp_of(message.header.stamp, topics.ODOM.name)
        navigation = self._readings.navigation(message, self._frames, topics.ODOM.name)
        # For a stamp that goes back the order decides: an old message, or a clock that was set.
        stepped = self._free and not self._guard.is_old(stamp) and self._stepped(stamp)
        verdict, dt = self._guard.judge(stamp)
        if verdict is StampVerdict.REFUSE:
            raise MessageRefused(topics.ODOM.name, "a stamp that is not newer than the last", "rising stamps")
        restarted = verdict is StampVerdict.RESTART
        if not self._heard:
            self._heard = True
            self._node.health.error("odometry", "")
        if not self._free:
            return AcceptedOdometry(navigation, dt, stamp, restarted, restarted)
        if restarted or stepped:
            self._gate.reset()
            self._punctuality.reset()
            dt = self._refused_for = 0.0
        passed, found, expected = self._gate.judge(navigation, dt, self.under_way)
        if passed is Passed.REFUSED:
            self._refused_for += dt
            raise MessageRefused(topics.ODOM.name, found, expected)
        dt, self._refused_for = dt + self._refused_for, 0.0
        moved = passed is Passed.MOVED
        if moved:
            self._node.get_logger().warning(f"a new place is accepted: {found}")
        self._accepted_at = self._node.now()
        if self._silent:
            self._silent = False
            self._node.health.error("odometry", "")
        return AcceptedOdometry(
            navigation, 0.0 if moved else dt, stamp, restarted, restarted or stepped or moved
        )

    def _stepped(self, stamp: int) -> bool:
        timing = self._punctuality.judge(self._node.now(), stamp)
        if timing is StampTiming.LATE or timing is StampTiming.EARLY:
            kind = "older" if timing is StampTiming.LATE else "newer"
            found = f"a stamp more than {self._punctuality.bound:g} s {kind} than it used to be"
            raise MessageRefused(topics.ODOM.name, found, "stamps that keep up with the clock")
        return timing is StampTiming.STEPPED
