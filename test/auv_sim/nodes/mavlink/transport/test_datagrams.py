"""One datagram: what is read of it, what is not, and what a signature is worth."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.nodes.mavlink.transport.datagrams import Codec
from auv_sim.nodes.mavlink.transport.signing import load_key

KEY, OTHER = bytes(range(32)), bytes(32)


def attitude(boot_ms: int) -> mavlink.MAVLink_attitude_message:
    return mavlink.MAVLink_attitude_message(boot_ms, 0.0, 0.0, 0.5, 0.0, 0.0, 0.1)


def times(codec: Codec, datagram: bytes) -> list[int]:
    return [frame.message.time_boot_ms for frame in codec.unpack(datagram)[0] if frame.message is not None]


def test_a_datagram_may_hold_several_messages_and_some_of_another_dialect() -> None:
    codec, sender = Codec(255, 191), Codec(1, 1)
    unknown = bytearray(sender.pack(attitude(0)))
    unknown[7:10] = (60_000).to_bytes(3, "little")
    frames, damage = codec.unpack(sender.pack(attitude(1)) + bytes(unknown) + sender.pack(attitude(2)))
    assert [(f.system, f.component, f.number) for f in frames] == [(1, 1, 1), (1, 1, 0), (1, 1, 2)]
    assert [f.message.time_boot_ms if f.message else None for f in frames] == [1, None, 2]
    assert damage == ""


def test_what_follows_a_wrong_checksum_is_read_and_what_follows_garbage_is_not() -> None:
    codec, sender = Codec(255, 191), Codec(1, 1)
    broken = bytearray(sender.pack(attitude(1)))
    broken[15] ^= 0xFF
    assert times(codec, bytes(broken) + sender.pack(attitude(2))) == [2]
    assert times(codec, sender.pack(attitude(3)) + b"garbage" + sender.pack(attitude(4))) == [3]
    assert codec.unpack(sender.pack(attitude(5))[:-1]) == ([], "a message cut short")


def test_a_datagram_of_nothing_but_failures_costs_little() -> None:
    codec, sender = Codec(255, 191), Codec(1, 1)
    broken = bytearray(sender.pack(attitude(1)))
    broken[15] ^= 0xFF
    assert times(codec, 3 * bytes(broken) + sender.pack(attitude(2))) == [2]
    assert times(codec, 4 * bytes(broken) + sender.pack(attitude(3))) == []


@given(st.binary(max_size=600), st.booleans())
def test_no_bytes_end_the_reading_with_an_exception(data: bytes, prefixed: bool) -> None:
    frames, damage = Codec(255, 191, KEY).unpack(b"\xfd" + data if prefixed else data)
    assert damage or frames  # something is said of every datagram


def test_a_message_counts_only_with_the_right_signature() -> None:
    reader = Codec(255, 191, KEY)
    assert times(reader, Codec(1, 1, KEY).pack(attitude(1))) == [1]
    for sender in (Codec(1, 1), Codec(1, 1, OTHER)):
        assert reader.unpack(sender.pack(attitude(2))) == ([], "Invalid signature")


def test_a_replay_is_refused_and_another_line_has_its_own_order() -> None:
    reader, sender = Codec(255, 191, KEY), Codec(1, 1, KEY)
    late, early, other = sender.pack(attitude(1)), sender.pack(attitude(2)), sender.pack(attitude(3), line=1)
    assert times(reader, other) == [3]
    assert times(reader, early) == [2]
    assert times(reader, late) == []
    assert times(reader, early) == []


def test_a_forgery_from_the_future_does_not_silence_the_vehicle() -> None:
    reader, sender, forger = Codec(255, 191, KEY), Codec(1, 1, KEY), Codec(1, 1, OTHER)
    forger._signing.timestamp = 2**47
    assert times(reader, forger.pack(attitude(1))) == []
    assert times(reader, sender.pack(attitude(2))) == [2]


def test_a_key_is_read_from_a_file_of_its_owner(tmp_path: Path) -> None:
    file = tmp_path / "key"
    file.write_text(KEY.hex() + "\n")
    file.chmod(0o600)
    assert load_key(str(file), "signing_key") == KEY
    assert load_key("", "signing_key") is None


@pytest.mark.parametrize(
    ("content", "mode", "found"),
    [
        (KEY.hex(), 0o640, "found mode 0640"),
        (KEY.hex(), 0o604, "found mode 0604"),
        ("secret passphrase", 0o600, "64 hexadecimal digits"),
        (KEY.hex()[:-2], 0o600, "64 hexadecimal digits"),
        (KEY.hex() + "00", 0o600, "64 hexadecimal digits"),
    ],
)
def test_a_key_that_cannot_be_is_refused_without_being_printed(
    tmp_path: Path, content: str, mode: int, found: str
) -> None:
    file = tmp_path / "key"
    file.write_text(content)
    file.chmod(mode)
    with pytest.raises(ConfigurationError, match=found) as error:
        load_key(str(file), "signing_key")
    assert content[:8] not in str(error.value)


def test_a_key_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match=r"signing_key: found .*nothing' \(No such file"):
        load_key(str(tmp_path / "nothing"), "signing_key")
    with pytest.raises(ConfigurationError, match="signing_key: found"):
        load_key(str(tmp_path), "signing_key")
