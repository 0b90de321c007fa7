"""Stamps and positions that no message can mean."""

from __future__ import annotations

import pytest
from builtin_interfaces.msg import Time

from auv_msgs_py.contract.conversions import set_stamp, stamp_of
from auv_msgs_py.values.errors import MessageRefused


@pytest.mark.parametrize(
    ("sec", "nanosec"), [(2**31 - 1, 2**32 - 1), (5, 1_000_000_000), (-1, 0), (-(2**31), 999_999_999)]
)
def test_a_stamp_that_is_no_time_is_refused(sec: int, nanosec: int) -> None:
    with pytest.raises(MessageRefused, match="odom: found a stamp of"):
        stamp_of(Time(sec=sec, nanosec=nanosec), "odom")


def test_the_last_stamp_that_is_accepted_can_be_sent_again() -> None:
    stamp = Time(sec=2**31 - 1, nanosec=999_999_999)
    copy = Time()
    set_stamp(copy, stamp_of(stamp, "odom"))
    assert copy == stamp
