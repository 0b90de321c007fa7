"""What the tests of whole processes share: a ROS domain of their own, short missions, nothing left behind."""

from __future__ import annotations

import contextlib
import itertools
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import rclpy
from hypothesis import HealthCheck, settings

from auv_sim.launch.processes.domains import free_domain
from node_bench import Bench

REPOSITORY = Path(__file__).resolve().parents[1]
SHORT_MISSION = Path(__file__).parent / "data" / "short.yaml"
SHORT_DIVE = Path(__file__).parent / "data" / "short_dive.yaml"

os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
# xdist sets the width of the terminal in its workers; the commands under test write into pipes.
os.environ.pop("COLUMNS", None)
_ASKED = itertools.count()

# A test that takes longer on a loaded machine has not failed. The same examples in every run: a failure can
# be repeated, and belongs to the change that is tested.
settings.register_profile(
    "suite", deadline=None, derandomize=not os.environ.get("AUV_NEW_EXAMPLES"),
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
settings.load_profile("suite")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests of whole missions first: begun last, they would leave one of two workers with nothing to do."""
    items.sort(key=lambda item: item.path.parent != Path(__file__).parent)


@pytest.fixture(scope="session", autouse=True)
def _elsewhere(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Run the session in an empty directory: no test depends on where pytest was started."""
    os.chdir(tmp_path_factory.mktemp("elsewhere"))


@pytest.fixture
def short_mission() -> Path:
    """A mission of half a minute."""
    return SHORT_MISSION


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A ROS domain of this test alone, and that no other test has just left."""
    with free_domain(skip=next(_ASKED)) as number:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
        yield number


@pytest.fixture(scope="module")
def module_domain() -> Iterator[int]:
    """A ROS domain of the tests of one module alone, and of the processes that they start."""
    with free_domain(skip=next(_ASKED)) as number, pytest.MonkeyPatch.context() as environment:
        environment.setenv("ROS_DOMAIN_ID", str(number))
        yield number


@pytest.fixture
def command_line() -> Callable[..., list[str]]:
    """`command_line("auv_sim.cli.mission", "--help")`: run a module of the suite with this interpreter."""
    return lambda module, *arguments: [sys.executable, "-m", module, *map(str, arguments)]


@pytest.fixture
def spawn(domain: int) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Start a process; it is killed, with everything it started, when the test ends."""
    started: list[subprocess.Popen[str]] = []

    def start(command: list[str]) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ.copy()
        )
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.wait()
        for stream in (process.stdout, process.stderr):
            if stream is not None:
                stream.close()


def children_of(pid: int) -> list[int]:
    """The process ids of the direct children, from /proc."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError):  # the thread has ended meanwhile
            found += [int(child) for child in task.read_text().split()]
    return found


@pytest.fixture
def node_processes() -> Callable[[int], dict[str, int]]:
    """The nodes a launcher (its process id) has started: last part of the module's name -> process id."""

    def look(pid: int) -> dict[str, int]:
        nodes = {}
        for child in children_of(pid):
            try:
                words = Path(f"/proc/{child}/cmdline").read_bytes().decode().split("\0")
            except OSError:
                continue
            if "-m" in words:
                nodes[words[words.index("-m") + 1].rsplit(".", 1)[-1]] = child
        return nodes

    return look


@pytest.fixture(scope="session")
def dive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A dive over the graph in one process, in lockstep, in a current with upwelling: its run directory."""
    from auv_sim.cli import mission

    run = tmp_path_factory.mktemp("dive") / "run"
    words = ["--mission", str(SHORT_DIVE), "--vehicle", "remus100_6dof", "--composed", "--quiet"]
    sea = ["--current", "0.1", "0.2", "--upwelling", "-0.05"]
    assert mission.main([*words, *sea, "--out", str(run)]) == 0
    return run


@pytest.fixture
def bench(domain: int) -> Iterator[Bench]:
    """ROS in this process, and a bench in it."""
    rclpy.init(args=[], domain_id=domain)
    made = Bench()
    yield made
    made.close()
    rclpy.try_shutdown()
