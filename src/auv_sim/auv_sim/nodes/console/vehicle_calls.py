"""The console's calls to a vehicle's services, awaited without a thread."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import SuiteError

#: How often an answer is looked for, s: a command must not wait for the next look at the topics.
_EAGER = 0.004
#: Longest time for the match with a service and its answer together, s: shorter than the page waits.
PATIENCE = 4.0
#: Longest time for a service that the graph does not have, s.
_DISCOVERY = 1.0


class CallFailed(SuiteError):
    """A service is not offered or does not answer, or its call was cancelled."""


def _always() -> bool:
    return True


def _require(may_send: Callable[[], bool], name: str) -> None:
    if not may_send():
        raise CallFailed(f"{name} was not called: an abort came first, or the browser left")


class ServiceCaller:
    """Calls services; the executor runs only while an answer is awaited.

    Args:
        node: of the console; all of its subscriptions are polled, so the executor has only clients.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)
        self._clients: dict[str, Any] = {}

    def client(self, kind: Any, name: str) -> Any:
        """Return the client of a service by its full name."""
        if name not in self._clients:
            self._clients[name] = self._node.create_client(kind, name)
        return self._clients[name]

    async def call(
        self, kind: Any, name: str, request: Any, may_send: Callable[[], bool] = _always
    ) -> Any:  # fmt: skip
        """Return the response of a service.

        Args:
            kind: class of the service.
            name: its full name.
            request: to send.
            may_send: returns whether the request still counts; it is asked until the request is sent.

        Raises:
            CallFailed: no node offers it, it does not answer within `PATIENCE`, or it may not be sent.
        """
        client, loop = self.client(kind, name), asyncio.get_running_loop()
        begin = loop.time()
        while not client.service_is_ready():
            _require(may_send, name)
            passed = loop.time() - begin
            if passed > PATIENCE or (passed > _DISCOVERY and not self._is_offered(name)):
                raise CallFailed(f"no node offers {name}")
            await asyncio.sleep(_EAGER)
        _require(may_send, name)
        future = client.call_async(request)
        while not future.done():
            self._executor.spin_once(timeout_sec=0.0)
            if loop.time() - begin > PATIENCE:
                client.remove_pending_request(future)
                raise CallFailed(f"{name} did not answer within {PATIENCE:g} s")
            await asyncio.sleep(_EAGER * (not future.done()))
        return future.result()

    def _is_offered(self, name: str) -> bool:
        """Return whether the graph has a service, whether or not its node has been matched yet."""
        return any(found == name for found, _ in self._node.get_service_names_and_types())

    async def trigger(
        self, namespace: str, service: str, may_send: Callable[[], bool] = _always
    ) -> tuple[bool, str]:
        """Call a service of guidance; return whether it was done, and its message.

        Raises:
            CallFailed: as `call`.
        """
        name = topics.full_name(namespace, service)
        response = await self.call(Trigger, name, Trigger.Request(), may_send)
        return bool(response.success), str(response.message)

    def prepare(self, namespace: str) -> None:
        """Make the clients of a vehicle early: a new client has to be discovered first."""
        for service in (
            topics.START_SERVICE, topics.ABORT_SERVICE, topics.HOLD_SERVICE, topics.RESUME_SERVICE,
        ):  # fmt: skip
            self.client(Trigger, topics.full_name(namespace, service))

    def close(self) -> None:
        """End the executor."""
        self._executor.shutdown()
