"""Pass the contract's topics to Foxglove as they are on the wire: raw CDR with its definition. Read-only.

The SDK's server accepts a connection from any web page that is open on the machine, whatever its origin, and
has no hook to refuse one. So it offers the capability of time alone: no client can publish, call or set.
"""

from __future__ import annotations

import os
from collections import deque
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_sim.command_line import EXIT_DONE, say
from auv_sim.nodes.display import display_topics

_ROSOUT = Topic("/rosout", "rcl_interfaces/msg/Log", "every node")
#: Topics that are passed on.
SHOWN = (
    *topics.CONTRACT, *topics.SPATIAL_CONTRACT, display_topics.MARKERS, display_topics.LIVE_MARKERS,
    _ROSOUT,
)  # fmt: skip
_SERVED = "Foxglove: open connection ws://{}:{} (read-only; any web page on this machine can read it too)"
_INSTALL = "pip install -r requirements/foxglove.txt"


def sdk() -> Any:
    """Return the module foxglove.

    Raises:
        ConfigurationError: it is not installed.
    """
    try:
        import foxglove
    except ImportError:
        raise ConfigurationError("foxglove-sdk", "not installed", _INSTALL) from None
    return foxglove


class Bridge:
    """One channel for each topic of a namespace.

    Args:
        node: whose subscriptions are used.
        foxglove: the module.
        frames: table of the accepted frame ids.
    """

    def __init__(self, node: Any, foxglove: Any, frames: Any) -> None:
        from auv_msgs_py.contract import qos
        from auv_msgs_py.node.transport import generated_decoder
        from auv_sim.bags.definitions import definition

        self._foxglove, self._frames = foxglove, frames
        self._latched: dict[int, tuple[Any, bytes]] = {}
        self._asked: deque[int] = deque()
        self._decode = generated_decoder(topics.ODOM)
        self._transform = foxglove.channels.FrameTransformChannel("/tf")
        for topic in SHOWN:
            schema = foxglove.Schema(
                name=topic.type, encoding="ros2msg", data=definition(topic.type).text.encode()
            )
            name = node.resolve_topic_name(topic.name)
            channel = foxglove.Channel(name, schema=schema, message_encoding="cdr")
            node.create_subscription(
                qos.message_class(topic.type), topic.name, self._handler(topic, channel),
                qos.requested(topic, reliable=False), raw=True,
            )  # fmt: skip

    def _handler(self, topic: Topic, channel: Any) -> Any:
        def hand_on(data: bytes) -> None:
            if topic.latched:
                self._latched[channel.id()] = channel, data
            channel.log(data)
            if topic is topics.ODOM:
                self._move(data)

        return hand_on

    def _move(self, data: bytes) -> None:
        """Log the vehicle's transform, in ENU, so that a view can turn with it and follow it."""
        from auv_sim.nodes.display.transforms import pose_of

        try:
            message = self._decode(data)
            (x, y, z), q = pose_of(message, self._frames)
        except MessageRefused:  # the control chain reports it
            return
        of, stamp = self._foxglove.messages, message.header.stamp
        self._transform.log(
            of.FrameTransform(
                timestamp=of.Timestamp(stamp.sec, stamp.nanosec), parent_frame_id="map",
                child_frame_id="base_link", translation=of.Vector3(x=x, y=y, z=z),
                rotation=of.Quaternion(x=q.x, y=q.y, z=q.z, w=q.w),
            )
        )  # fmt: skip

    def latched_topics(self) -> dict[str, int]:
        """Return the latched topics of which there is a message, with the number of their channel."""
        return {channel.topic(): number for number, (channel, _) in self._latched.items()}

    def on_subscribe(self, client: Any, channel: Any) -> None:
        """Remember that a client, in a thread of the server, wants a channel: the SDK keeps no message."""
        self._asked.append(channel.id)

    def answer_late(self) -> None:
        """Log the latched messages of newly subscribed channels again."""
        while self._asked:
            channel, data = self._latched.get(self._asked.popleft(), (None, b""))
            if channel is not None:
                channel.log(data)


def listener_of(bridge: Bridge, foxglove: Any) -> Any:
    """Return the server's listener for a bridge."""

    class Listener(foxglove.websocket.ServerListener):  # type: ignore[misc]
        on_subscribe = staticmethod(bridge.on_subscribe)

    return Listener()


def serve(namespace: str, address: str, port: int, domain: int | None) -> int:
    """Serve until a signal; return the exit code.

    Args:
        namespace: of the vehicle.
        address, port: where Foxglove connects.
        domain: ROS domain; None for the environment's.

    Raises:
        ConfigurationError: no SDK, or the port is taken.
    """
    foxglove = sdk()
    import rclpy
    from rclpy.experimental import EventsExecutor
    from rclpy.task import Future

    from auv_msgs_py.contract.frames import FrameIds, FrameTable
    from auv_msgs_py.node.run import StopRequest, start_ros

    if domain is not None:
        os.environ["ROS_DOMAIN_ID"] = str(domain)
    start_ros([])
    stop = StopRequest()
    node = rclpy.create_node("live_view", namespace=namespace, start_parameter_services=False)
    try:
        bridge = Bridge(node, foxglove, FrameTable(FrameIds()))
        server = _server(foxglove, bridge, address, port)
        say(_SERVED.format(address, server.port))
        executor = EventsExecutor()
        executor.add_node(node)
        while not stop.requested:
            executor.spin_until_future_complete(Future(), timeout_sec=0.1)
            bridge.answer_late()
        server.stop()
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
        stop.withdraw()
    return EXIT_DONE


def _server(foxglove: Any, bridge: Bridge, address: str, port: int) -> Any:
    try:
        return foxglove.start_server(
            name="auv_path_following", host=address, port=port,
            capabilities=[foxglove.websocket.Capability.Time],
            server_listener=listener_of(bridge, foxglove),
        )  # fmt: skip
    except (OSError, RuntimeError) as error:
        raise ConfigurationError(f"--port {port}", str(error), "a free port of this machine") from None


def write_layout(file: Path, namespace: str) -> int:
    """Write a layout for Foxglove; return the exit code.

    Args:
        file: to write.
        namespace: of the vehicle.

    Raises:
        ConfigurationError: no SDK.
        NotWritten: the file cannot be written.
    """
    sdk()
    from auv_msgs_py.settings.result_files import write_text
    from auv_sim.nodes.live_view.foxglove_layout import layout

    write_text(file, layout(namespace))
    say(f"{file}: a layout, to be imported in Foxglove; it fits recordings too")
    return EXIT_DONE
