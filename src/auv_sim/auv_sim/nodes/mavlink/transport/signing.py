"""MAVLink 2 signing: the key file, the clock of signatures, and a reader that is robust against forgeries."""

from __future__ import annotations

import os
import stat
import time
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.settings import user_files
from auv_msgs_py.values.errors import ConfigurationError

_KEY_BYTES = 32
#: Signatures count units of 10 us since 2015-01-01 (UTC).
_EPOCH, _TICKS = 1_420_070_400, 100_000


def load_key(path: str, where: str) -> bytes | None:
    """Read a signing key: 64 hexadecimal digits in a file that only its owner can read.

    Args:
        path: the file; empty: no signing.
        where: the parameter or option, for the message, which never contains the key.

    Returns:
        The 32 bytes of the key, None for an empty path.

    Raises:
        ConfigurationError: no such file, one that other users can read, or no key in it.
    """
    if not path:
        return None
    try:
        with user_files.from_home(path).open("rb") as file:
            status = os.fstat(file.fileno())
            _refuse_exposed(status, f"{where}: {path}")
            text = file.read(4 * _KEY_BYTES).strip()
    except OSError as error:
        raise ConfigurationError(where, f"'{path}' ({error.strerror})", "a file with the key") from None
    try:
        key = bytes.fromhex(text.decode("ascii"))
    except ValueError:  # no ASCII, or no hexadecimal digits
        key = b""
    if len(key) != _KEY_BYTES:
        raise ConfigurationError(
            f"{where}: {path}",
            "other content",
            f"{2 * _KEY_BYTES} hexadecimal digits (openssl rand -hex 32)",
        )
    return key


def _refuse_exposed(status: os.stat_result, where: str) -> None:
    mode = stat.S_IMODE(status.st_mode)
    if not stat.S_ISREG(status.st_mode):
        raise ConfigurationError(where, "no regular file", "a file with the key")
    if mode & 0o077:
        raise ConfigurationError(where, f"mode {mode:04o}", "0600 or 0400: a key is for its owner alone")
    if status.st_uid not in (os.getuid(), 0):
        raise ConfigurationError(where, "a file of another user", "one of the user that runs this")


def signing(key: bytes | None) -> Any:
    """Return the signing state of one link; it signs and demands signatures if there is a key."""
    state = mavlink.MAVLinkSigning()
    state.secret_key, state.sign_outgoing = key, key is not None
    return state


def keep_time(state: Any) -> None:
    """Set the clock of signatures to the computer's; it never goes back, nor behind received signatures."""
    state.timestamp = max(state.timestamp, round((time.time() - _EPOCH) * _TICKS))


class Reader(mavlink.MAVLink):  # type: ignore[misc]
    """pymavlink's decoder, made stateless towards messages with a false signature.

    The original stores the time of a signature before checking it. One forgery from the far future would then
    cause every genuine message of that component to be refused as a replay.
    """

    def check_signature(self, msgbuf: bytearray, srcSystem: int, srcComponent: int) -> bool:
        """Return whether the signature is valid and newer than the last of its link and component."""
        times = self.signing.stream_timestamps
        self.signing.stream_timestamps = dict(times)
        valid = bool(super().check_signature(msgbuf, srcSystem, srcComponent))
        if not valid:
            self.signing.stream_timestamps = times
        return valid
