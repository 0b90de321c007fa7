"""Two links on the loopback interface, and what must not disturb them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.errors import ConfigurationError
from auv_sim.drivers.mavlink_link import MavlinkLink, parse_address
from auv_sim.mission.vehicle_driver import free_port


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
        messages += link.messages(link.receive(5.0))
    return messages


def test_who_waits_answers_to_where_it_was_spoken_to(links: tuple[MavlinkLink, MavlinkLink]) -> None:
    driver, vehicle = links
    driver.send(attitude(1))  # nobody has been heard yet: it goes nowhere, and harms nobody
    vehicle.send(attitude(2))
    assert [m.time_boot_ms for m in received(driver, 1)] == [2]
    driver.send(attitude(3))
    (message,) = received(vehicle, 1)
    assert (message.time_boot_ms, message.get_srcSystem(), message.get_srcComponent()) == (3, 255, 191)


def test_only_a_message_of_the_vehicle_makes_somebody_the_one_who_is_spoken_to() -> None:
    port = free_port()
    driver = MavlinkLink(f"udpin:127.0.0.1:{port}", 255, 191, peer_system=1)
    vehicle, station = (MavlinkLink(f"udpout:127.0.0.1:{port}", system, 1) for system in (1, 254))
    try:
        station.send_bytes(b"not MAVLink at all")
        station.send(attitude(1))
        received(driver, 2)
        driver.send(attitude(2))
        assert station.receive(0.1) == b""
        vehicle.send(attitude(3))
        for data in (b"again", station.pack(attitude(4)), station.pack(attitude(5))):
            station.send_bytes(data)
        assert [m.time_boot_ms for m in received(driver, 4)] == [3, 4, 5]
        driver.send(attitude(6))
        assert [m.time_boot_ms for m in received(vehicle, 1)] == [6]
        assert station.receive(0.1) == b""
    finally:
        for link in (driver, vehicle, station):
            link.close()


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
    assert driver.receive(0.0) == b""
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
