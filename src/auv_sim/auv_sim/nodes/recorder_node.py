"""recorder: every topic of the contract, raw, into a rosbag2 directory (MCAP)."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rclpy.clock import Clock, ClockType
from rosbags.interfaces import Qos
from std_msgs.msg import UInt64

from auv_msgs_py import qos, topics
from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.runtime import SuiteNode, run_nodes
from auv_msgs_py.topics import Topic
from auv_sim.parameters import RecorderParameters
from auv_sim.recording.bag_writer import BagWriter
from auv_sim.recording.qos_records import qos_record

#: ROS's own topics that belong to every record.
_ROS_OWN = (
    Topic("/rosout", "rcl_interfaces/msg/Log", "every node", latched=True),
    Topic("/parameter_events", "rcl_interfaces/msg/ParameterEvent", "every node"),
)
#: Lockstep: how often the recorder tells how far it is, steps.
_REPORT_EVERY = 100
#: After a stop was requested, silence for this long means that nothing is under way any more, s.
_QUIET = 0.2


class RecorderNode(SuiteNode):
    """Writes what comes, as it comes."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.RECORDER, RecorderParameters, **arguments)
        p: RecorderParameters = self.parameters
        directory = Path(p.directory)
        if directory.exists():
            raise ConfigurationError(f"{self.get_name()}: parameter directory", f"{directory}, which exists", "a new one")
        self.writer = BagWriter(directory, p.compression)
        self._last = time.monotonic()
        self._ros_clock = self.get_clock()
        self._progress = self.advertise(topics.RECORDED_STEPS) if p.lockstep else None
        self.close_gate()
        for topic in (*topics.CONTRACT, *_ROS_OWN):
            self._record(topic)
        self.create_timer(p.flush_period, self._flush, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def report(self) -> dict[str, Any]:
        return {"messages": sum(self.writer.counts.values()), "directory": self.parameters.directory}

    def _record(self, topic: Topic) -> None:
        reliable = self.parameters.lockstep or topic.latched or topic.publisher != topics.PLANT
        profile = qos.requested(topic, reliable, qos.RECORDER_DEPTH)
        callback = self._writer_of(topic, qos_record(qos.offered(topic)))
        self.create_subscription(qos.message_class(topic.type), topic.name, callback, profile, raw=True)

    def _writer_of(self, topic: Topic, offered: Qos) -> Callable[[bytes], None]:
        name = self.resolve_topic_name(topic.name)
        channel = self.writer.add_topic(name, topic.type, [offered])
        write, clock = self.writer.write, self._ros_clock
        is_odometry = topic is topics.ODOM

        def on_message(data: bytes) -> None:
            now = clock.now().nanoseconds
            write(channel, now, now, data)
            self._last = time.monotonic()
            if is_odometry and self._progress is not None and channel.count % _REPORT_EVERY == 0:
                self._report_progress(channel.count)

        return on_message

    def _report_progress(self, steps: int) -> None:
        progress = self._progress
        assert progress is not None
        self.answer(lambda: progress.publish(UInt64(data=steps)))

    def _flush(self) -> None:
        self.writer.flush()

    def busy(self) -> bool:
        return time.monotonic() - self._last < _QUIET

    def close(self) -> None:
        self.writer.close()
        counts = self.writer.counts
        print(f"{self.writer.directory}: {sum(counts.values())} messages of {len(counts)} topics")


def main(args: Sequence[str] | None = None) -> int:
    """The executable `recorder`."""
    return run_nodes([RecorderNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
