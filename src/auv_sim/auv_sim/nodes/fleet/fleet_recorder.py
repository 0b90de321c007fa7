"""One bag for all vehicles of a fleet: a recorder for each of them in one process, with one writer.

Each simulator waits for the recorder of its own namespace, as it does alone. The first recorder owns the
bag: it flushes and closes it, and it alone records /clock and the lines of nodes that belong to no vehicle.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import run_nodes
from auv_sim.bags import line_owner
from auv_sim.bags.texts import texts_of_fleet
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.bags.writing.opened_bag import open_bag
from auv_sim.nodes.recorder_node import RecorderNode


class FleetRecorderNode(RecorderNode):
    """The recorder of one vehicle, which shares its bag with those of the others.

    Args:
        recorders: those that exist; this one is appended.
        arguments: as of `RecorderNode`.
    """

    def __init__(self, recorders: list[FleetRecorderNode], **arguments: Any) -> None:
        self._recorders = recorders
        super().__init__(**arguments)
        recorders.append(self)
        self.report_every = topics.shared(topics.RECORDING_REPORT, len(self.parameters.vehicles.split()))

    @property
    def _owner(self) -> FleetRecorderNode:
        return self._recorders[0] if self._recorders else self

    @property
    def lost(self) -> dict[str, int]:
        """Messages that never came: of the owner, of all vehicles."""
        if self._owner is not self:
            return super().lost
        return {
            topic.name: topic.watch.lost
            for recorder in self._recorders
            for topic in recorder.selection.topics
            if topic.watch.lost
        }

    def new_writer(self, directory: Path) -> BagWriter:
        if self._owner is not self:
            return self._owner.writer
        texts = texts_of_fleet(directory.parent, self.parameters.vehicles.split())
        return open_bag(self.parameters, directory, texts, self.get_name())

    def keeps(self, topic: str) -> Callable[[bytes], bool] | None:
        if self._owner is self:
            return super().keeps(topic)
        if topic == topics.CLOCK.name:
            return lambda _: False
        return line_owner.only(topic, self.get_namespace())

    def _flush(self) -> None:
        if self._owner is self:
            super()._flush()

    def close(self) -> None:
        if self._owner is self:
            for recorder in self._recorders[1:]:
                recorder.finish()
            super().close()


def main(argv: Sequence[str]) -> int:
    """Run the recorders; the one argument is a JSON list with the ROS arguments of each."""
    recorders: list[FleetRecorderNode] = []
    requested: list[list[str]] = json.loads(argv[0])
    return run_nodes(
        [
            partial(FleetRecorderNode, recorders, cli_args=["--ros-args", *words], use_global_arguments=False)
            for words in requested
        ],
        [],
    )


if __name__ == "__main__":
    import sys

    raise SystemExit(main(sys.argv[1:]))
