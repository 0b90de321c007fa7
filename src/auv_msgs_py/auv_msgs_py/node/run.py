"""The loop that runs nodes until a signal, a fault or their end."""

from __future__ import annotations

import contextlib
import gc
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

from auv_msgs_py.node.graph_look import GraphLook
from auv_msgs_py.node.log_directory import ensure_log_directory
from auv_msgs_py.node.ros_arguments import check_parameter_files
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.node.start_gate import is_gated, pass_gate
from auv_msgs_py.values.errors import SuiteError, printable
from auv_msgs_py.values.ros_domain import domain_of_environment

try:
    from rclpy.experimental import EventsExecutor
except ImportError:  # an rclpy without it: slower, otherwise the same
    EventsExecutor = SingleThreadedExecutor

#: Exit code for input that cannot be used; 1 is for everything else that went wrong.
EXIT_BAD_INPUT = 2
#: Longest time that nodes may continue after a stop was requested, s of wall time.
_GRACE = 5.0


def start_ros(args: Sequence[str] | None = None) -> None:
    """Initialise rclpy for its default context, without its signal handlers.

    Args:
        args: words with arguments for ROS; those of the process if None.

    Raises:
        ConfigurationError: ROS_DOMAIN_ID is not a domain.
        RuntimeError: arguments that ROS does not understand.
    """
    domain_of_environment()  # on one that is none, rclpy raises an error or ends the process
    rclpy.init(args=args if args is None else list(args), signal_handler_options=SignalHandlerOptions.NO)


class StopRequest:
    """SIGINT, SIGTERM and SIGHUP set a flag; ROS stays up, so that work under way can be finished.

    SIGHUP comes when the terminal is lost, over ssh for example; `nohup` has it ignored, and it stays so.
    """

    def __init__(self) -> None:
        self.requested = False
        signals = [signal.SIGINT, signal.SIGTERM]
        if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
            signals.append(signal.SIGHUP)
        self._before = {number: signal.signal(number, self._request) for number in signals}

    def withdraw(self) -> None:
        """Restore the previous signal handlers."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _request(self, *_: object) -> None:
        self.requested = True


def spin(nodes: Sequence[SuiteNode], stop: StopRequest) -> int:
    """Run nodes in this thread until a signal, a fault, or until one has finished; return the exit code."""
    executor = EventsExecutor()
    for node in nodes:
        executor.add_node(node)
    gc.collect()
    gc.freeze()  # what is there now stays: searching it for garbage again and again takes milliseconds
    while not stop.requested and not any(node.fault or node.finished for node in nodes):
        _spin_some(executor, nodes)
    deadline = time.monotonic() + _GRACE
    # Not `any`, which asks until the first that is: a node may end its work in `busy`.
    while sum(node.busy() for node in nodes) and time.monotonic() < deadline:
        executor.spin_once(timeout_sec=0.02)
    for node in nodes:
        if node.fault:
            print(f"{node.get_fully_qualified_name()}: {node.fault}", file=sys.stderr)
    return 1 if any(node.fault for node in nodes) else 0


def _spin_some(executor: Any, nodes: Sequence[SuiteNode]) -> None:
    """Handle everything that comes within 0.1 s, or until a node interrupts.

    EventsExecutor.spin() and spin_once(None) deliver nothing in rclpy 7.1. spin_once() with a time returns
    after every message, which costs as much again as handling it; waiting for a future with a time stays in
    C++ and lets Python handle a signal within 0.1 s.
    """
    attention = Future()

    def interrupt() -> None:
        if not attention.done():
            attention.set_result(None)

    for node in nodes:
        node.interrupt_spinning = interrupt
    executor.spin_until_future_complete(attention, timeout_sec=0.1)


def _look_around(nodes: Sequence[SuiteNode], stop: StopRequest) -> Iterator[Node]:
    """Look at the graph on behalf of simulators started by hand, before anything is published.

    Yields:
        The nodes that hold their claims.

    Raises:
        GraphTaken: there is another simulator.
    """
    for node in nodes:
        claim = node.claim()
        if claim is None or is_gated():
            continue
        name = node.get_fully_qualified_name()
        watcher = rclpy.create_node("_graph_look", use_global_arguments=False, start_parameter_services=False)
        yield watcher
        executor = SingleThreadedExecutor()
        executor.add_node(watcher)
        look = GraphLook(watcher, claim, (name,))
        while not (look.ended() or stop.requested):
            executor.spin_once(timeout_sec=0.02)
        executor.remove_node(watcher)


def run_nodes(factories: Sequence[Callable[[], SuiteNode]], args: Sequence[str] | None = None) -> int:
    """Make nodes, run them and clean up: the body of every executable.

    Returns:
        0 after a signal or when a node has finished, 1 after a fault, 2 for input that cannot be used.
    """
    ensure_log_directory()
    try:
        check_parameter_files(sys.argv if args is None else args)
        start_ros(args)
    except (SuiteError, RuntimeError) as error:  # RuntimeError: arguments that ROS does not understand
        print(printable(str(error)), file=sys.stderr)
        return EXIT_BAD_INPUT
    stop = StopRequest()
    nodes: list[SuiteNode] = []
    watchers: list[Node] = []
    try:
        if not pass_gate(lambda: stop.requested):
            return 0
        for factory in factories:
            nodes.append(factory())
        watchers.extend(_look_around(nodes, stop))
        return spin(nodes, stop)
    except SuiteError as error:
        print(error, file=sys.stderr)
        return EXIT_BAD_INPUT
    finally:
        _clean_up(nodes, watchers)


def _clean_up(nodes: Sequence[SuiteNode], watchers: Sequence[Node]) -> None:
    """Close the nodes in their order, and shut ROS down; an error in one does not keep the next from it."""
    with contextlib.ExitStack() as last_first:
        last_first.callback(rclpy.try_shutdown)
        for watcher in watchers:
            last_first.callback(watcher.destroy_node)
        for node in reversed(nodes):
            last_first.callback(node.destroy_node)
            last_first.callback(node.close)
