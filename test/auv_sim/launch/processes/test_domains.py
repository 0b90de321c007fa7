"""ROS domains that are not in use."""

from __future__ import annotations

import contextlib
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.launch.processes import domains
from auv_sim.launch.processes.domains import LAST, free_domain

#: Claims a domain in a process of its own, by the process id given, until its stdin closes.
CALLER = """
import os, sys
os.getpid = lambda: int(sys.argv[1])
from auv_sim.launch.processes.domains import free_domain
with free_domain() as domain:
    print(domain, flush=True)
    sys.stdin.read()
"""


@contextlib.contextmanager
def caller(pid: int) -> Iterator[subprocess.Popen[str]]:
    """Another process that has claimed a domain."""
    command = [sys.executable, "-c", CALLER, str(pid)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        yield process
        process.kill()


def is_unclaimed(domain: int) -> bool:
    """Return whether a domain can be claimed: `free_domain` might find another that was left meanwhile."""
    claim = domains._claim(domain)
    if claim is None:
        return False
    claim.close()
    return True


@given(skip=st.integers(0, 500))
def test_a_domain_has_ports_and_is_not_the_default(skip: int) -> None:
    with free_domain(skip) as domain:
        assert 1 <= domain <= LAST


@pytest.mark.parametrize("participant", [0, 1, 7, 119])
def test_a_domain_in_use_is_left_out(participant: int) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        with free_domain() as first:  # the claim keeps other tests' nodes from the port
            one.bind(("127.0.0.1", 7410 + 250 * first + 2 * participant))
        with free_domain() as second:
            assert second != first


def test_no_two_callers_have_the_same_domain_before_their_nodes_are_up() -> None:
    with contextlib.ExitStack() as claims:
        taken = [claims.enter_context(free_domain()) for _ in range(20)]
        assert len(set(taken)) == 20
    assert any(map(is_unclaimed, taken)), "another caller may have taken some of them meanwhile"


def test_a_claim_excludes_other_processes_until_its_own_is_killed() -> None:
    with caller(os.getpid()) as other:
        assert other.stdout is not None
        theirs = int(other.stdout.readline())
        with free_domain() as ours:
            assert ours != theirs
        assert not is_unclaimed(theirs)
        other.kill()
        other.wait()
        deadline = time.monotonic() + 180.0
        while not is_unclaimed(theirs):  # another caller may have taken it meanwhile, and leaves it again
            assert time.monotonic() < deadline
            time.sleep(0.05)


def test_without_a_free_domain_one_line_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(domains, "has_participants", lambda domain: True)
    expected = r"^ROS domain: found 1 to 101 all in use, expected a free one, or --domain with a number$"
    with pytest.raises(ConfigurationError, match=expected), free_domain():
        pass
