"""The console as a process: one loop polls the topics, serves the browsers and awaits the services.

The topics are looked at every 50 ms with queues of one message, so the console costs the same at any speed of
a mission. No node waits for it, and it is no watchdog: without it a mission goes on.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import rclpy
from aiohttp import web

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import StopRequest, start_ros
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.ros_domain import domain_of_environment
from auv_sim.command_line import EXIT_DONE, say
from auv_sim.launch.processes import discovery
from auv_sim.nodes.console.graph_feed import GraphFeed
from auv_sim.nodes.console.operator_deeds import OperatorDeeds
from auv_sim.nodes.console.vehicle_calls import CallFailed, ServiceCaller
from auv_sim.nodes.console.vehicle_feed import VehicleFeed
from auv_sim.views.console import plan_apart
from auv_sim.views.console.listening import LOOPBACK, PORT
from auv_sim.views.console.mission_desk import MissionFacts, MissionShelf
from auv_sim.views.console.plan_apart import CheckFailed
from auv_sim.views.console.record.fault_log import FaultLog
from auv_sim.views.console.record.readiness import PlanLines
from auv_sim.views.console.record.track_file import remove_stale
from auv_sim.views.console.web.operator_desk import OperatorDesk
from auv_sim.views.console.web.page_files import page_files
from auv_sim.views.console.web.page_guard import PageGuard, Tokens, new_tokens
from auv_sim.views.console.web.page_server import PageServer
from auv_sim.views.console.web.page_sessions import PageSessions

#: Between two looks at the topics, s.
_POLL = 0.05
#: Between two attempts to read what a mission's file holds, s.
_RETRY = 1.0


@dataclass(frozen=True, kw_only=True)
class ConsoleOptions:
    """Options of the command line.

    Attributes:
        namespaces: of the vehicles; empty for all that are discovered.
        domain: ROS domain; None for the environment's.
        address, port: to listen on; port 0 for a free one, None for `PORT` or else a free one.
        view_only: whether no browser may command.
        missions: folder of further missions.
        keep: whether tracks and cookies are kept for a restart.
    """

    namespaces: tuple[str, ...] = ()
    domain: int | None = None
    address: str = LOOPBACK
    port: int | None = None
    view_only: bool = False
    missions: Path | None = None
    keep: bool = True


class ConsoleSession:
    """Joins the graph and the browsers.

    Args:
        options: of the command line.
        node: of the console.
        shelf: of the missions.
        tokens: of this start.
        port: that is listened on.
        cache: directory of tracks and cookies; None keeps none.
    """

    def __init__(
        self,
        options: ConsoleOptions,
        node: Any,
        shelf: MissionShelf,
        tokens: Tokens,
        port: int,
        cache: Path | None,
    ) -> None:
        self._caller = ServiceCaller(node)
        self._faults = FaultLog(node.get_logger().error, time.monotonic)
        self._deeds = OperatorDeeds(node, self._caller, shelf, self._is_here)
        self._feeds: list[VehicleFeed] = []
        self._server: PageServer | None = None
        domain = domain_of_environment()
        self._graph = GraphFeed(
            node, options.namespaces, cache, domain, self._discovered, self._publish, self._faults
        )
        sessions = PageSessions(cache / f"cookies-{port}.json" if cache is not None else None, time.time)
        guard = PageGuard(tokens, _names(options.address), sessions)
        records = self._graph.records
        desk = OperatorDesk(records, self._deeds.looks, self._deeds.commands)
        self._server = PageServer(records, desk, guard, page_files(), self._faults)

    def _publish(self, messages: list[str | bytes]) -> None:
        if self._server is not None:
            self._server.publish(messages)

    def _is_here(self, browser: int) -> bool:
        return self._server is not None and self._server.has_viewer(browser)

    def _discovered(self, feed: VehicleFeed) -> None:
        self._feeds.append(feed)
        self._deeds.prepare(feed.record.namespace)
        if self._server is not None:
            self._server.greet_again()

    async def run(self, listening: socket.socket, stop: StopRequest) -> None:
        """Serve until a signal."""
        assert self._server is not None
        runner = web.AppRunner(self._server.application(), access_log=None, shutdown_timeout=1.0)
        await runner.setup()
        await web.SockSite(runner, listening).start()
        facts = asyncio.create_task(self._read_missions())
        try:
            while not stop.requested:
                begin = time.monotonic()
                with self._faults.guard("the look at the topics"):
                    self._graph.poll()
                await asyncio.sleep(max(0.0, begin + _POLL - time.monotonic()))
        finally:
            facts.cancel()
            await asyncio.gather(facts, return_exceptions=True)
            await runner.cleanup()
            self._caller.close()

    async def _read_missions(self) -> None:
        """Read the file of each mission that guidance reports: joints, and the check of its plan."""
        while True:
            for feed in tuple(self._feeds):
                with self._faults.guard(f"{feed.record.namespace} mission"):
                    if feed.course.needs_facts():
                        await self._read_mission(feed)
            await asyncio.sleep(_RETRY)

    async def _read_mission(self, feed: VehicleFeed) -> None:
        with contextlib.suppress(CallFailed):  # guidance is gone: the next round tries again
            feed.course.take_facts(await self._facts(feed))

    async def _facts(self, feed: VehicleFeed) -> MissionFacts:
        desk, digest = self._deeds.desk(feed.record.namespace), feed.course.digest
        values = await desk.value(topics.GUIDANCE, "mission", "mission_text", "vehicle")
        try:
            return await plan_apart.facts_of(digest, *values)
        except CheckFailed as error:
            return MissionFacts(digest, [], False, PlanLines(False, (str(error),)))


def serve(options: ConsoleOptions) -> int:
    """Serve until a signal; return the exit code.

    Raises:
        ConfigurationError: the ROS domain, the address or the folder of missions cannot be used.
    """
    if options.domain is not None:
        os.environ["ROS_DOMAIN_ID"] = str(options.domain)
    os.environ.update(discovery.variables())
    domain_of_environment()  # a wrong one is refused before anything is opened
    shelf = MissionShelf(options.missions)
    listening = _listen(options)
    port = listening.getsockname()[1]
    cache = _cache() if options.keep else None
    tokens = new_tokens(options.view_only)
    stop = StopRequest()
    start_ros([])
    node = rclpy.create_node(topics.CONSOLE, start_parameter_services=False)
    try:
        session = ConsoleSession(options, node, shelf, tokens, port, cache)
        for line in announcement(options, tokens, port):
            say(line)
        asyncio.run(session.run(listening, stop))
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
        listening.close()
        stop.withdraw()
    return EXIT_DONE


def announcement(options: ConsoleOptions, tokens: Tokens, port: int) -> Iterator[str]:
    """Yield the lines with the addresses."""
    host = options.address if options.address not in ("0.0.0.0", "::") else socket.gethostname()  # noqa: S104
    host = f"[{host}]" if ":" in host else host
    if options.address != LOOPBACK:
        yield f"warning --address {options.address}: unencrypted, and open to every machine of that network"
    if tokens.control:
        yield f"console: http://{host}:{port}/?token={tokens.control}"
    yield f"to look only: http://{host}:{port}/?token={tokens.view}"


def _listen(options: ConsoleOptions) -> socket.socket:
    family = socket.AF_INET6 if ":" in options.address else socket.AF_INET
    made = socket.socket(family, socket.SOCK_STREAM)
    made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        _bind(made, options)
        made.listen(64)
    except (OSError, OverflowError) as error:
        made.close()
        found = f"{options.address} port {options.port} ({error})"
        raise ConfigurationError("--port", found, "a free port; --port 0 takes any") from None
    return made


def _bind(made: socket.socket, options: ConsoleOptions) -> None:
    if options.port is not None:
        made.bind((options.address, options.port))
        return
    try:
        made.bind((options.address, PORT))
    except OSError:
        made.bind((options.address, 0))


def _names(address: str) -> tuple[str, ...]:
    """Return the names under which this console may be called, beside those of the loopback."""
    if address == LOOPBACK:
        return ()
    return (f"[{address}]" if ":" in address else address, socket.gethostname(), socket.getfqdn())


def _cache() -> Path | None:
    """Return the directory of tracks and cookies, for its owner alone; None where there can be none."""
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    directory = base / "auv_sim" / "console"
    try:
        directory.mkdir(parents=True, exist_ok=True, mode=0o700)
        directory.chmod(0o700)
    except (OSError, RuntimeError):
        return None
    remove_stale(directory, time.time())
    return directory
