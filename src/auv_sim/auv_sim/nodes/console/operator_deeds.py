"""What an operator can do, and the line in /rosout that says which browser did it."""

from __future__ import annotations

import asyncio
import math
import time
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import MAP
from auv_msgs_py.contract.frames import quaternion_of_yaw
from auv_msgs_py.values.errors import printable
from auv_sim.nodes.console.parameter_desk import ParameterDesk
from auv_sim.nodes.console.vehicle_calls import CallFailed, ServiceCaller
from auv_sim.views.console import plan_apart
from auv_sim.views.console.mission_desk import MissionShelf
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.web.operator_desk import Answer, Deed, number_in, text_in

Request = Mapping[str, Any]
#: Most looks for a match of a new publisher, and their period, s.
_MATCHING, _MATCH = 25, 0.2


class OperatorDeeds:
    """The requests of the page, by name.

    Args:
        node: of the console; its log is the record of what was done.
        caller: of the services.
        shelf: of the missions.
        is_here: returns whether a browser, by its number, is still connected.
    """

    def __init__(
        self, node: Node, caller: ServiceCaller, shelf: MissionShelf, is_here: Callable[[int], bool]
    ) -> None:  # fmt: skip
        self._node, self._caller, self._shelf = node, caller, shelf
        self._is_here = is_here
        self._aborts: Counter[str] = Counter()
        self._is_checking = False
        self._desks: dict[str, ParameterDesk] = {}

    @property
    def looks(self) -> dict[str, Deed]:
        """Requests that change nothing."""
        return {
            "missions": self._missions, "mission_text": self._mission_text,
            "parameters": self._parameters, "parameter_file": self._parameter_file,
        }  # fmt: skip

    @property
    def commands(self) -> dict[str, Deed]:
        """Requests that reach the vehicle or what other browsers see, and the check, which takes time."""
        return {
            "start": self._start, "abort": self._abort,
            "hold": self._service(topics.HOLD_SERVICE), "resume": self._service(topics.RESUME_SERVICE),
            "load": self._load, "set": self._set, "goal": self._goal, "acknowledge": self._acknowledge,
            "check": self._check,
        }  # fmt: skip

    def desk(self, namespace: str) -> ParameterDesk:
        """Return the parameters of a vehicle."""
        if namespace not in self._desks:
            self._desks[namespace] = ParameterDesk(self._caller, namespace)
        return self._desks[namespace]

    def _log(self, record: VehicleRecord, viewer: int, what: str, failure: str = "") -> None:
        """Write what a browser did to /rosout and to the vehicle's events."""
        text = printable(f"browser {viewer}: {what}" + (f": refused: {failure}" if failure else ""))
        # Of the vehicle's namespace: a recording shows it beside the nodes' own lines.
        self._node.get_logger().info(f"{record.namespace}: {text}")
        level = "warning" if failure else "info"
        record.events.add(text, self._node.get_name(), level, record.progress.mission_time, time.time())

    def _may_send(self, record: VehicleRecord, viewer: int) -> Callable[[], bool]:
        """Return a check that a request made now still counts: no abort came, its browser is connected."""
        namespace, aborts = record.namespace, self._aborts[record.namespace]
        return lambda: self._aborts[namespace] == aborts and self._is_here(viewer)

    async def _abort(self, record: VehicleRecord, viewer: int, _: Request) -> Answer:
        """Abort, even if the browser leaves, and cancel what has not been sent to the vehicle yet."""
        self._aborts[record.namespace] += 1
        return await self._call(record, viewer, topics.ABORT_SERVICE, lambda: True)

    def _service(self, service: str) -> Deed:
        async def call(record: VehicleRecord, viewer: int, _: Request) -> Answer:
            return await self._call(record, viewer, service, self._may_send(record, viewer))

        return call

    async def _call(
        self, record: VehicleRecord, viewer: int, service: str, may_send: Callable[[], bool]
    ) -> Answer:  # fmt: skip
        try:
            done, message = await self._caller.trigger(record.namespace, service, may_send)
        except CallFailed as error:
            self._log(record, viewer, service, str(error))
            raise
        self._log(record, viewer, service, "" if done else message)
        return Answer(done, message)

    async def _start(self, record: VehicleRecord, viewer: int, request: Request) -> Answer:
        reason = record.start_refusal(request.get("digest"), time.monotonic())
        if reason:
            self._log(record, viewer, topics.START_SERVICE, reason)
            return Answer(False, reason)
        return await self._service(topics.START_SERVICE)(record, viewer, request)

    async def _missions(self, _: VehicleRecord, __: int, ___: Request) -> Answer:
        return Answer(True, more={"missions": await asyncio.to_thread(self._shelf.listed)})

    async def _mission_text(self, _: VehicleRecord, __: int, request: Request) -> Answer:
        return Answer(True, more={"text": self._shelf.text_of(text_in(request, "name"))})

    async def _check(self, record: VehicleRecord, _: int, request: Request) -> Answer:
        """Check a mission's text; one at a time, as each has a process."""
        if self._is_checking:
            return Answer(False, "a check is running")
        self._is_checking = True
        try:
            (hull,) = await self.desk(record.namespace).value(topics.GUIDANCE, "vehicle")
            found = await plan_apart.checked_text(text_in(request, "text"), hull)
        finally:
            self._is_checking = False
        return Answer(found.pop("ok"), next(iter(found["lines"]), ""), found)

    async def _load(self, record: VehicleRecord, viewer: int, request: Request) -> Answer:
        values = {"mission_text": text_in(request, "text")}
        if "start_at" in request:
            values["start_at"] = text_in(request, "start_at")
        reason = await self.desk(record.namespace).set(
            topics.GUIDANCE, values, self._may_send(record, viewer)
        )
        self._log(record, viewer, "load a mission", reason)
        return Answer(not reason, reason or "the mission is set")

    async def _parameters(self, record: VehicleRecord, _: int, __: Request) -> Answer:
        return Answer(True, more={"nodes": await self.desk(record.namespace).form()})

    async def _parameter_file(self, record: VehicleRecord, _: int, __: Request) -> Answer:
        return Answer(True, more={"text": await self.desk(record.namespace).file()})

    async def _set(self, record: VehicleRecord, viewer: int, request: Request) -> Answer:
        node, name, value = text_in(request, "node"), text_in(request, "name"), request.get("value")
        reason = await self.desk(record.namespace).set(node, {name: value}, self._may_send(record, viewer))
        self._log(record, viewer, f"set {node} {name} {value!r}"[:300], reason)
        return Answer(not reason, reason)

    async def _goal(self, record: VehicleRecord, viewer: int, request: Request) -> Answer:
        x, y, z, yaw = (number_in(request, name) for name in ("x", "y", "z", "yaw"))
        (accepts,) = await self.desk(record.namespace).value(topics.GUIDANCE, "accept_goal")
        what = f"goal east {x:.1f} m, north {y:.1f} m, up {z:.1f} m, yaw {math.degrees(yaw):.0f} deg"
        if not accepts:
            reason = "guidance takes no goals: its parameter accept_goal is false"
            self._log(record, viewer, what, reason)
            return Answer(False, reason)
        message = PoseStamped()
        message.header.frame_id = MAP
        position, q = message.pose.position, message.pose.orientation
        position.x, position.y, position.z = x, y, z
        q.z, q.w = quaternion_of_yaw(yaw)
        if not await self._published(record.namespace, message):
            self._log(record, viewer, what, "guidance does not receive it")
            return Answer(False, "guidance does not receive goal_pose")
        self._log(record, viewer, what)
        return Answer(True, "the goal is sent; guidance checks it, and its events have the result")

    async def _published(self, namespace: str, goal: PoseStamped) -> bool:
        """Publish a goal; return whether guidance listens.

        The publisher exists for this goal alone: guidance warns where several nodes could send one.
        """
        name = topics.full_name(namespace, topics.GOAL_POSE.name)
        publisher = self._node.create_publisher(PoseStamped, name, qos.offered(topics.GOAL_POSE))
        try:
            for _ in range(_MATCHING):
                if publisher.get_subscription_count():
                    publisher.publish(goal)
                    await asyncio.sleep(_MATCH)  # until it has left
                    return True
                await asyncio.sleep(_MATCH)
            return False
        finally:
            self._node.destroy_publisher(publisher)

    def prepare(self, namespace: str) -> None:
        """Create the endpoints for a vehicle's requests early: a new endpoint is not discovered yet."""
        self._caller.prepare(namespace)
        self.desk(namespace).prepare()

    async def _acknowledge(self, record: VehicleRecord, viewer: int, request: Request) -> Answer:
        number = int(number_in(request, "alarm"))
        if not record.acknowledge(number):
            return Answer(False, f"no alarm {number}")
        self._log(record, viewer, f"acknowledge alarm {number}")
        return Answer(True)
