"""Publishes recorded messages unchanged, at their recorded pace."""

from __future__ import annotations

import time
from types import TracebackType
from typing import Any, NamedTuple

import rclpy
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rich.console import Console
from rosbags.interfaces import QosDurability, QosReliability
from rosbags.rosbag2.metadata import parse_qos
from rosgraph_msgs.msg import Clock as ClockMessage

from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.conversions import set_stamp
from auv_msgs_py.contract.qos import message_class
from auv_msgs_py.contract.topics import CLOCK
from auv_msgs_py.node.graph_look import GraphLook, GraphTaken
from auv_msgs_py.node.run import start_ros
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.playing.keyboard import Keyboard
from auv_sim.bags.playing.play_bar import PlayBar
from auv_sim.bags.reading.recording import Bag, RecordedTopic

#: Topics about the recorded nodes, which are absent when they are played.
_NOT_REPEATED = ("/rosout", "/parameter_events")
_DEPTH = 1000
_INTERRUPTED = 130
#: Longest period of /clock while nothing is published, s of wall time.
_CLOCK_PERIOD = 0.025


class Selected(NamedTuple):
    """What to play: published name -> topic; (log time ns, name, data) by time; length, s; first time, ns."""

    topics: dict[str, RecordedTopic]
    messages: list[tuple[int, str, bytes]]
    length: float
    first_ns: int


def select(
    bag: Bag,
    names: list[str] | None,
    exclude: list[str],
    remaps: dict[str, str],
    start: float,
    duration: float | None,
    own_clock: bool,
) -> Selected:
    """Choose topics and time.

    Raises:
        ConfigurationError: no topic has a name, or nothing is left.
    """

    _check_names(bag, [*(names or []), *exclude, *remaps])
    chosen: dict[str, RecordedTopic] = {}
    for name, topic in bag.topics.items():
        if names is not None and not any(_matches(name, pattern) for pattern in names):
            continue
        if any(_matches(name, pattern) for pattern in exclude) or (names is None and name in _NOT_REPEATED):
            continue
        if own_clock and name == CLOCK.name:
            continue
        new = next((new for old, new in remaps.items() if _matches(name, old)), name)
        chosen[new if new.startswith("/") else f"{name.rsplit('/', 1)[0]}/{new}"] = topic
    begin = bag.span_ns[0] + round(start * 1e9)
    end = begin + round(duration * 1e9) if duration is not None else bag.span_ns[1]
    messages = _messages(bag, chosen, begin, end)
    if not messages:
        raise ConfigurationError(str(bag.path), "nothing to play", "messages on these topics in this time")
    return Selected(chosen, messages, (min(end, bag.span_ns[1]) - begin) * 1e-9, begin)


def _matches(topic: str, name: str) -> bool:
    return topic == name or topic.rsplit("/", 1)[-1] == name


def _check_names(bag: Bag, names: list[str]) -> None:
    for name in names:
        if not any(_matches(topic, name) for topic in bag.topics):
            known = ", ".join(sorted(bag.topics))
            raise ConfigurationError(str(bag.path), f"no topic {name}", f"one of {known}")


def _messages(
    bag: Bag, chosen: dict[str, RecordedTopic], begin: int, end: int
) -> list[tuple[int, str, bytes]]:
    """Return the messages of a time, ns, after the latched ones that are in force at its begin."""
    by_topic = {id(topic): name for name, topic in chosen.items()}
    messages, before = [], {}
    for topic, k in bag.in_order():
        public, data = by_topic.get(id(topic)), topic.messages[k]
        if public is None or data is None:
            continue
        if topic.log_ns[k] < begin:
            before[public] = data
        elif topic.log_ns[k] <= end:
            messages.append((topic.log_ns[k], public, data))
    latched = DurabilityPolicy.TRANSIENT_LOCAL
    kept = [(begin, n, data) for n, data in before.items() if profile_of(chosen[n]).durability == latched]
    return kept + messages


def profile_of(topic: RecordedTopic) -> QoSProfile:
    """Return the QoS that all recorded publishers of a topic offered."""
    try:
        offers = parse_qos(topic.qos) if topic.qos else []
    except Exception:  # a damaged text makes the parser raise any exception
        offers = []
    best_effort = any(offer.reliability is QosReliability.BEST_EFFORT for offer in offers)
    latched = bool(offers) and all(offer.durability is QosDurability.TRANSIENT_LOCAL for offer in offers)
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=_DEPTH,
        reliability=ReliabilityPolicy.BEST_EFFORT if best_effort else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


class Player:
    """A node that publishes a selection.

    Args:
        selected: what to play.
        rate: times the recorded speed.
        clock: whether to publish /clock.
        console: for the position.

    Raises:
        ConfigurationError: a type is not installed, or /clock is published already.
    """

    def __init__(self, selected: Selected, rate: float, clock: bool, console: Console) -> None:
        self._selected, self._rate, self._console = selected, rate, console
        start_ros([])
        self._node = rclpy.create_node("replay")
        if clock or CLOCK.name in selected.topics:
            self._look_around()
        self._publishers: dict[str, Publisher] = {}
        for name, topic in selected.topics.items():
            try:
                kind = message_class(topic.type)
            except (ImportError, AttributeError, ValueError):
                raise ConfigurationError(
                    name, f"the type {topic.type}", "an installed type, or --exclude"
                ) from None
            self._publishers[name] = self._node.create_publisher(kind, name, profile_of(topic))
        self._clock = self._node.create_publisher(ClockMessage, CLOCK.name, _DEPTH) if clock else None
        self._message = ClockMessage()
        self._published_ns = -1

    def _look_around(self) -> None:
        """Check for another /clock before publishing this one."""
        claim = Claim(holder="replay", namespace="/", names=(), clock=True)
        look = GraphLook(self._node, claim)
        try:
            while not look.ended():
                rclpy.spin_once(self._node, timeout_sec=0.02)
        except GraphTaken:
            self._node.destroy_node()
            rclpy.try_shutdown()
            raise

    def play(self, delay: float, loop: bool, paused: bool) -> int:
        """Play to the end, with `loop` repeatedly; return the exit code."""
        time.sleep(delay)
        with Keyboard() as keys, PlayBar(self._console, self._selected.length, keys.there) as bar:
            try:
                while True:
                    if not self._once(keys, bar, paused) or not loop:
                        break
            except KeyboardInterrupt:
                return _INTERRUPTED
        for publisher in self._publishers.values():
            publisher.wait_for_all_acked()
        return 0

    def _once(self, keys: Keyboard, bar: PlayBar, paused: bool) -> bool:
        """Play once; return False when ended by a key."""
        begin, shift = self._selected.first_ns, time.monotonic()
        bar.show(0.0, paused, at_once=True)
        for at, name, data in self._selected.messages:
            step = False
            while True:
                key = keys.pressed()
                if key == "q":
                    return False
                if key == " ":
                    paused = not paused
                    bar.show((at - begin) * 1e-9, paused, at_once=True)
                    shift = time.monotonic() - (at - begin) * 1e-9 / self._rate
                step = step or (paused and key == "s")
                if step:
                    break
                now = time.monotonic()
                wait = shift + (at - begin) * 1e-9 / self._rate - now
                if not paused and wait <= 0.0:
                    break
                if not paused:
                    reached = min(at, begin + round((now - shift) * self._rate * 1e9))
                    self._publish_time(reached)
                    bar.show((reached - begin) * 1e-9, paused)
                time.sleep(_CLOCK_PERIOD if paused else min(wait, _CLOCK_PERIOD))
            self._publish_time(at)
            self._publishers[name].publish(data)
            bar.show((at - begin) * 1e-9, paused, at_once=step)
        bar.show(self._selected.length, paused, at_once=True)
        return True

    def _publish_time(self, ns: int) -> None:
        if self._clock is not None and ns != self._published_ns:
            self._published_ns = ns
            set_stamp(self._message.clock, max(ns, 0))
            self._clock.publish(self._message)

    def __enter__(self) -> Player:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> Any:
        self._node.destroy_node()
        rclpy.try_shutdown()
