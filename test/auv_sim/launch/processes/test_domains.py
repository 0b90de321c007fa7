"""ROS domains that nobody uses."""

from __future__ import annotations

import socket

from hypothesis import given
from hypothesis import strategies as st

from auv_sim.launch.processes.domains import LAST, free_domain


@given(skip=st.integers(0, 500))
def test_a_domain_is_one_that_can_be_had_and_is_not_everybodys(skip: int) -> None:
    assert 1 <= free_domain(skip) <= LAST


def test_a_domain_in_use_is_left_out() -> None:
    first = free_domain()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as participant:
        participant.bind(("127.0.0.1", 7410 + 250 * first))
        assert free_domain() != first
