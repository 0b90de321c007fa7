"""Who is taken for the vehicle, with times and addresses that are made up."""

from __future__ import annotations

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.nodes.mavlink.transport.datagrams import Frame
from auv_sim.nodes.mavlink.transport.link import MavlinkLink
from auv_sim.nodes.mavlink.transport.link_watch import LinkWatch
from auv_sim.nodes.mavlink.transport.peer import Configured, Peer

VEHICLE, OTHER = ("10.0.0.2", 14550), ("10.0.0.9", 4711)


def frames(system: int = 1, message: object = "anything") -> list[Frame]:
    return [Frame(system, 1, 0, message)]


def test_what_cannot_be_read_makes_no_sender_the_vehicle() -> None:
    peer = Peer(system=1, patience=5.0)
    assert not peer.is_vehicle(OTHER, frames(message=None), 0.0)
    assert not peer.is_vehicle(OTHER, [], 0.0)
    assert not peer.is_vehicle(OTHER, frames(system=2), 0.0)
    assert peer.is_vehicle(VEHICLE, frames(), 0.0)
    assert peer.address == VEHICLE


def test_every_message_of_the_vehicle_keeps_its_place() -> None:
    peer = Peer(system=1, patience=5.0)
    for now in range(0, 100, 4):
        assert peer.is_vehicle(VEHICLE, frames(), float(now))
        assert not peer.may_be(OTHER, now + 3.9)
    assert peer.may_be(OTHER, 96.0 + 5.1)


def test_garbage_from_the_vehicles_address_does_not_keep_its_place() -> None:
    peer = Peer(system=1, patience=5.0)
    assert peer.is_vehicle(VEHICLE, frames(), 0.0)
    assert peer.is_vehicle(VEHICLE, [], 4.0)
    assert peer.may_be(OTHER, 5.1)


def test_a_forger_cannot_fill_the_memory() -> None:
    peer = Peer(system=1)
    for k in range(1000):
        peer.is_vehicle((f"10.0.{k // 250}.{k % 250}", k + 1), frames(system=2 + k % 250), 0.0)
        peer.refuse(OTHER, 0.0)
    assert len(peer.others) == 5
    assert peer.strangers == 1000


@pytest.mark.parametrize(
    ("text", "accepted"),
    [("127.0.0.1", {1, 2}), ("127.0.0.1:2", {2}), ("localhost:1", {1})],
)
def test_a_peer_is_configured_with_or_without_a_port(text: str, accepted: set[int]) -> None:
    allowed = Configured(text, "peer")
    assert {port for port in (1, 2) if allowed.allows(("127.0.0.1", port))} == accepted
    assert not allowed.allows(("127.0.0.2", 2))


@pytest.mark.parametrize("text", [":1", "127.0.0.1:x", "127.0.0.1:0", "127.0.0.1:99999", "no host"])
def test_a_peer_that_cannot_be_is_refused_with_its_place(text: str) -> None:
    with pytest.raises(ConfigurationError, match=r"^peer: found .* expected HOST or HOST:PORT"):
        Configured(text, "peer")


def test_conditions_come_and_go() -> None:
    link = MavlinkLink(f"udpin:127.0.0.1:{free_port()}", 255, 191, peer=Peer(system=1, patience=5.0))
    watch = LinkWatch(link, 1)
    try:
        link.peer.is_vehicle(OTHER, frames(system=7), 0.0)
        assert (
            watch.conditions(0.0, heard=False)["system"] == "no vehicle with system id 1, but 7 (component 1)"
        )
        assert watch.conditions(0.0, heard=True)["system"] == ""
        link.peer.refuse(OTHER, 0.0)
        refused = "datagrams from 10.0.0.9:4711 are refused: the vehicle "
        assert watch.conditions(0.0, heard=False)["strangers"] == refused + "has not been heard yet"
        link.peer.is_vehicle(VEHICLE, frames(), 0.0)
        link.damaged, link.damage = 1, "no MAVLink, from somewhere"
        assert watch.conditions(2.0, heard=True) == {
            "strangers": refused + "is at 10.0.0.2:14550",
            "damage": "damaged datagrams: no MAVLink, from somewhere",
            "system": "",
        }
        assert set(watch.conditions(8.0, heard=True).values()) == {""}
        assert watch.moved() == ""
        link.peer.is_vehicle(OTHER, frames(), 9.0)
        assert watch.moved() == "the vehicle now speaks from 10.0.0.9:4711"
        assert watch.moved() == ""
    finally:
        link.close()
