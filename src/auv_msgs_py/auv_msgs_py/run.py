"""The loop that runs nodes until a signal, a fault or their end."""

from __future__ import annotations

import gc
import signal
import sys
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

from auv_msgs_py.errors import SuiteError

try:
    from rclpy.experimental import EventsExecutor
except ImportError:  # an rclpy without it: slower, otherwise the same
    EventsExecutor = SingleThreadedExecutor

if TYPE_CHECKING:
    from auv_msgs_py.runtime import SuiteNode

#: Exit code for input that cannot be used; 1 is for everything else that went wrong.
EXIT_BAD_INPUT = 2
#: How long nodes may go on after a stop was requested, s of wall time.
_GRACE = 5.0


class StopRequest:
    """SIGINT and SIGTERM set a flag; ROS stays up, so that what is under way can be finished."""

    def __init__(self) -> None:
        self.requested = False
        self._before = {
            number: signal.signal(number, self._request) for number in (signal.SIGINT, signal.SIGTERM)
        }

    def withdraw(self) -> None:
        """Give the signals back to who had them."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _request(self, *_: object) -> None:
        self.requested = True


def spin(nodes: Sequence[SuiteNode], stop: StopRequest) -> int:
    """Run nodes in this thread until a signal, a fault, or until one has finished; returns the exit code."""
    executor = EventsExecutor()
    for node in nodes:
        executor.add_node(node)
    gc.collect()
    gc.freeze()  # what is there now stays: searching it for garbage again and again takes milliseconds
    while not stop.requested and not any(node.fault or node.finished for node in nodes):
        _spin_some(executor, nodes)
    deadline = time.monotonic() + _GRACE
    while any(node.busy() for node in nodes) and time.monotonic() < deadline:
        executor.spin_once(timeout_sec=0.02)
    for node in nodes:
        if node.fault:
            print(f"{node.get_fully_qualified_name()}: {node.fault}", file=sys.stderr)
    return 1 if any(node.fault for node in nodes) else 0


def _spin_some(executor: Any, nodes: Sequence[SuiteNode]) -> None:
    """Handle everything that comes within a tenth of a second, or until a node asks for attention.

    EventsExecutor.spin() and spin_once(None) deliver nothing in rclpy 7.1. spin_once() with a time returns
    after every single message, which costs as much again as handling it; waiting for a future with a time
    stays in C++ and lets Python see a signal soon enough.
    """
    attention = Future()

    def interrupt() -> None:
        if not attention.done():
            attention.set_result(None)

    for node in nodes:
        node.interrupt_spinning = interrupt
    executor.spin_until_future_complete(attention, timeout_sec=0.1)


def run_nodes(factories: Sequence[Callable[[], SuiteNode]], args: Sequence[str] | None = None) -> int:
    """The body of every executable: make the nodes, run them, leave nothing behind.

    Returns:
        0 after a signal or when a node has finished, 1 after a fault, 2 for input that cannot be used.
    """
    rclpy.init(args=list(args) if args is not None else None, signal_handler_options=SignalHandlerOptions.NO)
    stop = StopRequest()
    nodes: list[SuiteNode] = []
    try:
        for factory in factories:
            nodes.append(factory())
        return spin(nodes, stop)
    except SuiteError as error:
        print(error, file=sys.stderr)
        return EXIT_BAD_INPUT
    finally:
        for node in nodes:
            node.close()
            node.destroy_node()
        rclpy.try_shutdown()
