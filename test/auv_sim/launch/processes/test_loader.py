"""One process loads for all nodes of a mission and becomes them; and how soon they find each other."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from auv_sim.launch.composed import NODES
from auv_sim.launch.outcome import MissionFailed
from auv_sim.launch.processes import discovery
from auv_sim.launch.processes.adopted import Adopted, Loader

#: What takes long to import, none of it for a node.
NEVER = {"matplotlib", "scipy", "rich", "numba", "pyarrow", "pymavlink", "pandas"}


def imported(code: str) -> set[str]:
    """What a new interpreter prints, word by word."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    return set(done.stdout.split())


def test_the_loader_has_no_ros_and_no_thread_beside_its_own() -> None:
    code = "import os, sys; from auv_sim.launch.processes import loader; loader.load(); print(*sys.modules)"
    found = imported(f"{code}; print('threads', len(os.listdir('/proc/self/task')))")
    assert {"threads", "1", "numpy", "pydantic", "yaml", "rosbags", "mcap"} <= found
    assert "rclpy" not in found
    assert not found & NEVER


def test_a_node_imports_only_ros_and_the_suite_beyond_what_the_loader_has() -> None:
    modules = [
        path.split(":")[0] for name, path in NODES.items() if name not in ("mavlink_driver", "display")
    ]
    code = (
        "import sys; from auv_sim.launch.processes import loader; loader.load(); before = set(sys.modules)\n"
        f"import {', '.join(modules)}\n"
        "print(*{name.split('.')[0] for name in set(sys.modules) - before} - set(sys.stdlib_module_names))"
    )
    assert imported(code) <= {"rclpy", "ament_index_python", "auv_msgs_py", "auv_path_following", "auv_sim"}


def run(module: str, *arguments: str, log: Path) -> int:
    """Have a loader become a module; returns its exit code."""
    with Loader() as loader:
        (node,) = loader.fork({"LC_ALL": "C"}, [("one", module, arguments, str(log))]).values()
        assert Path(f"/proc/{node.pid}/stat").read_text().rpartition(")")[2].split()[1] == str(os.getpid())
        return node.wait(180.0)


def test_what_it_forks_is_a_child_of_the_launcher_with_a_log(tmp_path: Path) -> None:
    assert run("calendar", "2026", "1", log=tmp_path / "log") == 0
    assert "January" in (tmp_path / "log").read_text()


def test_with_a_thread_it_begins_anew_instead(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    threaded = "import threading, time; threading.Thread(target=time.sleep, args=(9,), daemon=True).start()"
    (tmp_path / "sitecustomize.py").write_text(threaded)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    assert run("calendar", "2026", "1", log=tmp_path / "log") == 0
    assert "January" in (tmp_path / "log").read_text()


def test_a_loader_that_has_ended_is_a_line_not_a_hang() -> None:
    with Loader() as loader:
        os.kill(loader._process.pid, signal.SIGKILL)
        with pytest.raises(MissionFailed, match="the nodes cannot be loaded"):
            loader.fork({}, [])


def test_an_exit_code_is_kept_and_patience_ends() -> None:
    process = Adopted(subprocess.Popen(["sleep", "600"]).pid)
    assert process.poll() is None
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.02)
    process.kill()
    assert (process.wait(180.0), process.poll()) == (-signal.SIGKILL, -signal.SIGKILL)
    process.send_signal(signal.SIGINT)  # it has ended: nothing is sent


def test_the_look_is_short_where_nothing_else_can_be(domain: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_STATIC_PEERS", raising=False)
    assert discovery.look_for(domain) == discovery.LOOK_ALONE
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as participant:
        participant.bind(("127.0.0.1", 7410 + 250 * domain + 2 * 7))
        assert discovery.look_for(domain) == discovery.LOOK
    monkeypatch.setenv("ROS_STATIC_PEERS", "192.0.2.1")
    assert discovery.look_for(domain) == discovery.LOOK
    monkeypatch.delenv("ROS_STATIC_PEERS")
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    assert discovery.look_for(domain) == discovery.LOOK


def test_the_middleware_reads_the_profile_and_a_users_own_stays(
    domain: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("FASTRTPS_DEFAULT_PROFILES_FILE", raising=False)
    variables = discovery.variables()
    assert list(variables) == ["FASTRTPS_DEFAULT_PROFILES_FILE"]
    code = "import rclpy; rclpy.init(args=[]); rclpy.create_node('one'); rclpy.shutdown()"
    done = subprocess.run(
        [sys.executable, "-c", code], env=os.environ | variables, capture_output=True, text=True, check=True
    )
    assert done.stdout + done.stderr == ""
    monkeypatch.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", "mine.xml")
    assert discovery.variables() == {}
