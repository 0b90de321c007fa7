"""Looking into a bag while it is being written."""

from __future__ import annotations

from pathlib import Path

from auv_sim.bags.reading.growing_bag import has_message
from auv_sim.bags.writing.bag_writer import BagWriter, typestore

FLOAT = "std_msgs/msg/Float64"


def test_a_message_is_found_once_it_is_there(tmp_path: Path) -> None:
    bag, store = tmp_path / "bag", typestore()
    assert not has_message(bag, "/auv/rudder_cmd")
    bag.mkdir()
    (bag / "bag_0.mcap").touch()  # made, and nothing written yet
    assert not has_message(bag, "/auv/rudder_cmd")
    with BagWriter(tmp_path / "whole", "none", 500) as writer:
        rudder = writer.add_topic("/auv/rudder_cmd", FLOAT, [])
        writer.add_topic("/auv/thrust_cmd", FLOAT, [])
        writer.write(rudder, 1_000, 900, bytes(store.serialize_cdr(store.types[FLOAT](0.1), FLOAT)))
    assert has_message(tmp_path / "whole", "/auv/rudder_cmd")
    assert not has_message(tmp_path / "whole", "/auv/thrust_cmd")
