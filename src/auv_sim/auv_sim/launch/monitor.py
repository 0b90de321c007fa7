"""The launcher's node on the graph: it starts and aborts the mission and reads its progress."""

from __future__ import annotations

import contextlib
import math
import time
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Vector3Stamped
from nav_msgs.msg import Odometry
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.conversions import finite, stamp_of
from auv_msgs_py.contract.mission_word import PERIOD, MissionState, MissionWord
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.graph_look import GraphLook
from auv_msgs_py.node.private_rclpy import take_polled
from auv_msgs_py.node.run import start_ros
from auv_msgs_py.values.errors import MessageRefused
from auv_sim.launch.operation.flown_missions import FlownMissions

#: A path of which at most this much is left counts as flown to its end, m.
_ARRIVED = 1e-3
#: Wall time after which `complete` counts without the evidence for it, s.
_UNDISPUTED = 4.0 * PERIOD


class Monitor:
    """Polls the mission's topics; its queues hold one message, so a fast mission costs it nothing.

    Args:
        namespace: of the mission's nodes.
    """

    def __init__(self, namespace: str) -> None:
        if not rclpy.ok():  # another vehicle's monitor may have initialised it
            start_ros([])
        self.node = Node(topics.LAUNCHER, namespace=namespace, start_parameter_services=False)
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)
        self.s = 0.0
        self.ye = 0.0
        self.first_stamp: int | None = None
        self.stamp = 0
        #: Metres of path left; infinite before the first `distance_to_go`.
        self.to_go = math.inf
        self._word = MissionWord()
        self._completed_at: float | None = None
        self.odometry_seen = False
        self._start = self.node.create_client(Trigger, topics.START_SERVICE)
        self._abort = self.node.create_client(Trigger, topics.ABORT_SERVICE)
        self._odometry = self.node.create_subscription(
            Odometry, topics.ODOM.name, self._on_odometry, qos.requested(topics.ODOM, reliable=False, depth=1)
        )
        self._listen(topics.PATH_PARAMETER, Float64, self._on_parameter)
        self._listen(topics.DISTANCE_TO_GO, Float64, self._on_to_go)
        self._listen(topics.PATH_ERROR, Vector3Stamped, self._on_error)
        self._listen(topics.MISSION_STATE, String, self._on_state)
        self.missions = FlownMissions()
        # All of them: in lockstep a short mission is flown between two looks, and reported once a second.
        status, every = topics.MISSION_STATUS, qos.requested(topics.MISSION_STATUS, reliable=True, depth=1000)
        read = self.node.create_subscription(DiagnosticStatus, status.name, self._on_status, every)
        self._take_status = take_polled(self.node, read)

    def _listen(self, topic: Topic, kind: Any, callback: Any) -> None:
        depth = qos.DEPTH if topic.latched else 1
        self.node.create_subscription(
            kind, topic.name, callback, qos.requested(topic, reliable=False, depth=depth)
        )

    def _on_odometry(self, _: Odometry) -> None:
        self.odometry_seen = True
        # One odometry shows that there is a vehicle.
        self.node.destroy_subscription(self._odometry)

    def _on_parameter(self, message: Float64) -> None:
        if 0.0 <= message.data < math.inf:  # NaN fails this
            self.s = message.data

    def _on_to_go(self, message: Float64) -> None:
        self.to_go = message.data

    def _on_error(self, message: Vector3Stamped) -> None:
        with contextlib.suppress(MessageRefused):
            self.stamp = stamp_of(message.header.stamp, topics.PATH_ERROR.name)
            self.ye = finite(message.vector.y, topics.PATH_ERROR.name)
            if self.first_stamp is None:
                self.first_stamp = self.stamp

    def _on_state(self, message: String) -> None:
        now = time.monotonic()
        with contextlib.suppress(MessageRefused):
            self._word.hear(message.data, now)
            if message.data != MissionState.COMPLETE:
                self._completed_at = None
            elif self._completed_at is None:
                self._completed_at = now

    def _on_status(self, message: DiagnosticStatus) -> None:
        values = {pair.key: pair.value for pair in message.values}
        self.missions.hear(values, self.stamp * 1e-9, time.monotonic())

    @property
    def state(self) -> str:
        """The mission's state in force, see `MissionWord`; empty before the first message."""
        return self._word.at(time.monotonic())

    def completed(self, subpaths: int) -> bool:
        """Whether the mission has reached the end of its path.

        `complete` counts once path parameter and distance to go show the path's end. They are best effort,
        and the last ones may be lost: without them `complete` counts when no other state arrived for
        `_UNDISPUTED` s, in which guidance would have repeated it several times.

        Args:
            subpaths: of the path, which is the last path parameter.
        """
        if self._completed_at is None:
            return False
        if self.s >= subpaths and abs(self.to_go) <= _ARRIVED:
            return True
        return time.monotonic() - self._completed_at >= _UNDISPUTED

    @property
    def mission_time(self) -> float:
        """Seconds of mission time flown."""
        return 0.0 if self.first_stamp is None else (self.stamp - self.first_stamp) * 1e-9

    def look(self, seconds: float) -> None:
        """Process what has arrived; return after about this many seconds."""
        deadline = time.monotonic() + seconds
        for _ in range(8):
            self._executor.spin_once(timeout_sec=0.0)
        while (taken := self._take_status(DiagnosticStatus, False)) is not None:
            self._on_status(taken[0])
        time.sleep(max(0.0, deadline - time.monotonic()))

    def look_around(self, claim: Claim, length: float) -> GraphLook:
        """Begin to check for `length` s whether the graph has room for a mission; `look` feeds it."""
        return GraphLook(self.node, claim, length=length)

    def missing_nodes(self, names: set[str], recorded: bool) -> set[str]:
        """Return which of the named nodes do not yet subscribe to all their topics."""
        missing: set[str] = set()
        for topic in topics.CONTRACT:
            expected = {name for name in topic.subscribers if name in names}
            if recorded:
                expected.add(topics.RECORDER)
            missing |= expected - self._listeners(topic)
        if not self._start.service_is_ready():
            missing.add(topics.GUIDANCE)
        return missing

    def _listeners(self, topic: Topic) -> set[str]:
        full = self.node.resolve_topic_name(topic.name)
        return {info.node_name for info in self.node.get_subscriptions_info_by_topic(full)}

    def start(self, patience: float = 5.0) -> str:
        """Call the start service; return why it was refused, empty if it was accepted."""
        return self._call(self._start, patience)

    def abort(self, patience: float = 1.0) -> str:
        """Call the abort service."""
        return self._call(self._abort, patience)

    def _call(self, client: Any, patience: float) -> str:
        if not client.service_is_ready():
            return "guidance is not there"
        future = client.call_async(Trigger.Request())
        self._executor.spin_until_future_complete(future, timeout_sec=patience)
        if not future.done():
            return f"guidance did not answer within {patience:g} s"
        response = future.result()
        return "" if response.success else str(response.message)

    def leave(self) -> None:
        """Leave the graph; the monitors of other vehicles stay."""
        self._executor.shutdown()
        self.node.destroy_node()

    def close(self) -> None:
        """Leave the graph and end ROS."""
        self.leave()
        rclpy.try_shutdown()
