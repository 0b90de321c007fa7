"""recorder: topics, raw, into a rosbag2 directory (MCAP)."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rclpy.clock import Clock, ClockType
from std_msgs.msg import UInt64

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_sim.bags import line_owner
from auv_sim.bags.texts import texts_below
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.bags.writing.disk_room import RoomWatch
from auv_sim.bags.writing.intake import ReceivedMessage, Timestamps, drain
from auv_sim.bags.writing.opened_bag import closed, open_bag
from auv_sim.bags.writing.selection import Selection
from auv_sim.sim_parameters import RecorderParameters

#: Requested niceness; the system grants it to root only.
_PRIORITY = -10
#: Period of fetching all messages unless the simulator requests it, s.
_POLL = 0.02
#: The same once the simulator requests it: messages after its last request wait for this long, s.
_POLL_BESIDE = 0.1
#: Period of looking for new topics and publishers, s; in lockstep no contract topic needs it to be short.
_LOOK_AROUND, _SELDOM = 0.25, 1.0
#: Silence that shows, after a requested stop, that no message is in flight, s.
_QUIET = 0.2
#: With simulated time: most messages kept until the first /clock.
_EARLY_LIMIT = 10_000


class RecorderNode(SuiteNode):
    """Writes messages in the order of their arrival."""

    report_every = topics.RECORDING_REPORT

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.RECORDER, RecorderParameters, **arguments)
        p: RecorderParameters = self.parameters
        directory = Path(p.directory or time.strftime("bag-%Y%m%d-%H%M%S"))
        self.writer = self.new_writer(directory)
        self._room = RoomWatch(directory)
        self._times = Timestamps(bool(self.get_parameter("use_sim_time").value))
        self._early: list[ReceivedMessage] = []
        self._last = self._flushed = self._polled = time.monotonic()
        self._flushed_ns = 0
        self._progress = self.advertise(topics.RECORDED_STEPS) if p.lockstep else None
        self._reported = 0
        self.close_gate()
        self.selection = Selection(self, p, self.writer, self.keeps)
        spatial = topics.SPATIAL_PER_STEP if p.sternplanes else ()
        per_step = {self.resolve_topic_name(topic.name) for topic in (*topics.PER_STEP, *spatial)}
        self._per_step = [topic.channel for topic in self.selection.topics if topic.name in per_step]
        # In lockstep too: for what comes after the last request, and for a simulator that sends none.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.create_timer(_POLL, self._poll_unless_asked, clock=steady)
        if p.lockstep:
            self.listen(topics.RECORD_REQUEST, self._on_request)
            self.create_timer(_POLL_BESIDE, self._poll_unless_asked, clock=steady)
        seldom = p.lockstep and not self.selection.seeks
        self.create_timer(_SELDOM if seldom else _LOOK_AROUND, self._look_around, clock=steady)

    def new_writer(self, directory: Path) -> BagWriter:
        """Return the writer of the bag, which has the configuration and needs no other file.

        Raises:
            ConfigurationError: the directory exists, or the disk has too little room.
        """
        return open_bag(self.parameters, directory, texts_below(directory.parent / "config"), self.get_name())

    def keeps(self, topic: str) -> Callable[[bytes], bool] | None:
        """Return which messages of a topic to record; None: all."""
        others = set(self.parameters.vehicles.split()) - {self.get_namespace()}
        return line_owner.without(topic, sorted(others))

    @property
    def lost(self) -> dict[str, int]:
        """Messages that never came, by topic."""
        return {topic.name: topic.watch.lost for topic in self.selection.topics if topic.watch.lost}

    def report(self) -> dict[str, Any]:
        lost = self.lost
        return {
            "directory": str(self.writer.directory),
            "messages": sum(self.writer.counts.values()),
            "size [MB]": f"{self.writer.size / 1e6:.1f}",
            "dropped": sum(lost.values()) + self.writer.given_up,
        } | {f"dropped {name}": number for name, number in lost.items()}

    def _look_around(self) -> None:
        for text in self.selection.look_around():
            self.get_logger().warning(text)
        lost = self.lost
        text = ", ".join(f"{number} of {name}" for name, number in lost.items())
        self.health.warn("lost", f"messages lost: {text}" if lost else "")

    def _on_request(self, _: UInt64) -> None:
        self._timer.cancel()
        self._poll()

    def _poll_unless_asked(self) -> None:
        """Fetch, unless the simulator has just asked for it."""
        if time.monotonic() - self._polled >= 0.5 * _POLL:
            self._poll()

    def _poll(self) -> None:
        self._polled = now = time.monotonic()
        batch = drain(self.selection.topics)
        if batch:
            self._last = now
            self._take_in(batch)
        self._report_progress()
        end = self._times.now or 0
        period = self.parameters.flush_period
        if now - self._flushed >= period or abs(end - self._flushed_ns) >= period * 1e9:
            self._flushed, self._flushed_ns = now, end
            self._flush()

    def _take_in(self, batch: list[ReceivedMessage], last: bool = False) -> None:
        times, write = self._times, self.writer.write
        if times.simulated and times.now is None:
            batch = self._early + batch
            clock_known = any(order == 0 for _, order, *_ in batch)
            if not (clock_known or last or len(batch) > _EARLY_LIMIT):
                self._early = batch
                return
            self._early = []
            times.begin(batch)
        for sent_ns, _, sequence, received_ns, topic, data in batch:
            if not topic.known:
                self.selection.meet(topic)
            topic.watch.note(sequence, topic.publishers)
            if topic.is_clock:
                times.tick(sent_ns, data)
            if topic.keeps is not None and not topic.keeps(data):
                continue
            log_ns, publish_ns = times.of(sent_ns, received_ns)
            write(topic.channel, log_ns, publish_ns, data, sequence)
        if self._progress is not None:
            self.time_is(times.now or 0)

    def _report_progress(self) -> None:
        """Publish the number of complete steps, from the moment the simulator's reader is matched."""
        if self._progress is None:
            return
        steps = min((channel.count for channel in self._per_step), default=0)
        if steps - self._reported >= self.report_every and not self.gate_waits_for():
            self._reported = steps
            self._progress.publish(UInt64(data=steps))

    def _flush(self) -> None:
        if self.writer.closed:
            return
        if short := self._room.lacking(self.parameters.min_free_space):
            self.writer.close()
            text = f"the recording was closed: {short[0]}, expected {short[1]}"
            self.get_logger().error(text)
        elif self.writer.flush():
            self.health.error("disk", "")
            return
        else:
            text = f"cannot write {self.writer.trouble}"
        if self.parameters.lockstep:
            self.fail(text)
        given_up = f", {self.writer.given_up} messages given up" if self.writer.given_up else ""
        self.health.error("disk", text + given_up)

    def busy(self) -> bool:
        return time.monotonic() - self._last < _QUIET

    def finish(self) -> None:
        """Write what has arrived and end all subscriptions."""
        self._take_in(drain(self.selection.topics), last=True)
        self.selection.close()

    def close(self) -> None:
        self.finish()
        for line in closed(self.writer, self.lost):
            print(line)


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `recorder`."""
    # Starved of processor time it would lose messages; the threads that receive them inherit this.
    with contextlib.suppress(OSError):
        os.nice(_PRIORITY)
    return run_nodes([RecorderNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
