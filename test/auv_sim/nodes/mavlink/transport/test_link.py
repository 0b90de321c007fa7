"""Two links on the loopback interface, and what must not disturb them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.nodes.mavlink.transport.link import MavlinkLink, parse_address
from auv_sim.nodes.mavlink.transport.peer import Configured, Peer


def attitude(boot_ms: int) -> mavlink.MAVLink_attitude_message:
    return mavlink.MAVLink_attitude_message(boot_ms, 0.0, 0.0, 0.5, 0.0, 0.0, 0.1)


@pytest.fixture
def links() -> Iterator[tuple[MavlinkLink, MavlinkLink]]:
    """(driver, vehicle)."""
    port = free_port()
    driver = MavlinkLink(f"udpin:127.0.0.1:{port}", 255, 191)
    vehicle = MavlinkLink(f"udpout:127.0.0.1:{port}", 1, 1)
    yield driver, vehicle
    driver.close()
    vehicle.close()


def received(link: MavlinkLink, count: int) -> list[object]:
    messages: list[object] = []
    for _ in range(count):
        datagram = link.receive(5.0)
        assert datagram is not None
        messages += link.messages(datagram)
    return messages


def test_who_waits_answers_to_where_it_was_spoken_to(links: tuple[MavlinkLink, MavlinkLink]) -> None:
    driver, vehicle = links
    driver.send(attitude(1))  # nobody has been heard yet: it goes nowhere, and harms nobody
    vehicle.send(attitude(2))
    assert [m.time_boot_ms for m in received(driver, 1)] == [2]
    driver.send(attitude(3))
    (message,) = received(vehicle, 1)
    assert (message.time_boot_ms, message.get_srcSystem(), message.get_srcComponent()) == (3, 255, 191)


def test_who_speaks_as_the_vehicle_first_keeps_its_place_and_its_commands() -> None:
    port, now = free_port(), [100.0]
    peer = Peer(system=1, patience=5.0)
    driver = MavlinkLink(f"udpin:127.0.0.1:{port}", 255, 191, peer=peer, clock=lambda: now[0])
    vehicle, forger, station = (MavlinkLink(f"udpout:127.0.0.1:{port}", system, 1) for system in (1, 1, 254))
    try:
        station.send_bytes(b"not MAVLink at all")
        station.send(attitude(1))
        assert received(driver, 2) == []
        driver.send(attitude(2))
        assert station.receive(0.1) is None
        assert peer.others == {(254, 1)}
        vehicle.send(attitude(3))
        for data in (b"again", forger.pack(attitude(4)), station.pack(attitude(5)), b""):
            forger.send_bytes(data)
        assert [m.time_boot_ms for m in received(driver, 5)] == [3]
        driver.send(attitude(6))
        assert [m.time_boot_ms for m in received(vehicle, 1)] == [6]
        assert forger.receive(0.1) is None
        assert (peer.changes, peer.strangers) == (0, 6)
        now[0] += 5.1  # the vehicle is silent: its program was started anew, say, on another port
        forger.send(attitude(7))
        assert [m.time_boot_ms for m in received(driver, 1)] == [7]
        driver.send(attitude(8))
        assert [m.time_boot_ms for m in received(forger, 1)] == [8]
        assert vehicle.receive(0.1) is None
        assert peer.changes == 1
        vehicle.send(attitude(9))
        assert received(driver, 1) == []
    finally:
        for link in (driver, vehicle, forger, station):
            link.close()


def test_a_configured_peer_is_the_only_one() -> None:
    port = free_port()
    elsewhere = MavlinkLink(
        f"udpin:127.0.0.1:{port}", 255, 191, peer=Peer(1, 5.0, Configured("127.0.0.2", "p"))
    )
    vehicle = MavlinkLink(f"udpout:127.0.0.1:{port}", 1, 1)
    try:
        vehicle.send(attitude(1))
        assert received(elsewhere, 1) == []
        assert elsewhere.peer.address is None
        assert elsewhere.peer.strangers == 1
    finally:
        elsewhere.close()
        vehicle.close()


@pytest.mark.parametrize(
    "poison",
    [
        bytes.fromhex("fdff0000000101200000"),  # promises 255 bytes
        b"\xfd" * 60_000,
        b"",
        bytes(range(256)),
    ],
)
def test_no_datagram_outlives_itself(links: tuple[MavlinkLink, MavlinkLink], poison: bytes) -> None:
    driver, vehicle = links
    for k in range(5):
        vehicle.send_bytes(poison)
        vehicle.send(attitude(k))
    assert [m.time_boot_ms for m in received(driver, 10)] == [0, 1, 2, 3, 4]
    assert driver.damaged == 5


def test_lost_messages_are_counted_for_each_component(links: tuple[MavlinkLink, MavlinkLink]) -> None:
    driver, vehicle = links
    datagrams = [vehicle.pack(attitude(k)) for k in range(6)]
    log = [vehicle.pack(attitude(k), component=25) for k in range(3)]
    for data in (datagrams[0], log[0], datagrams[3], log[2], datagrams[5], datagrams[4]):
        vehicle.send_bytes(data)
    assert len(received(driver, 6)) == 6
    assert driver.lost == 2 + 1 + 1  # the one that was overtaken counts as lost


def test_damage_is_counted_and_what_follows_is_read(links: tuple[MavlinkLink, MavlinkLink]) -> None:
    driver, vehicle = links
    broken = bytearray(vehicle.pack(attitude(1)))
    broken[15] ^= 0xFF
    for data in (b"not MAVLink at all", bytes(broken), vehicle.pack(attitude(2))):
        vehicle.send_bytes(data)
    assert [m.time_boot_ms for m in received(driver, 3)] == [2]
    assert driver.damaged > 0


def test_silence_is_no_error(links: tuple[MavlinkLink, MavlinkLink]) -> None:
    driver, vehicle = links
    assert driver.receive(0.0) is None
    driver.close()
    for _ in range(3):
        vehicle.send(attitude(1))  # the system tells the sender that nobody listens there
        vehicle.receive(0.01)


@pytest.mark.parametrize(
    "text",
    ["", "14550", "tcp:127.0.0.1:14550", "udpin:127.0.0.1", "udpin::1", "udpout:host:0", "udp:host:99999"],
)
def test_an_address_that_cannot_be_is_refused_with_its_place(text: str) -> None:
    with pytest.raises(ConfigurationError, match=r"^--vehicle-address: found .* expected udpin:"):
        parse_address(text, "--vehicle-address")


def test_an_address_that_is_taken_is_refused(links: tuple[MavlinkLink, MavlinkLink]) -> None:
    port = links[0]._socket.getsockname()[1]
    with pytest.raises(ConfigurationError, match="expected an address that is free"):
        MavlinkLink(f"udpin:127.0.0.1:{port}", 255, 191)
