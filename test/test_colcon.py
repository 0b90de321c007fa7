"""The packages in a colcon workspace: what `ros2 run` needs is there, starts, and ends on request."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from rclpy.node import Node

from auv_sim.launch.processes.domains import free_domain

ROOT = Path(__file__).resolve().parents[1]
EXECUTABLES = [
    ("auv_path_following", "current_observer"),
    ("auv_path_following", "ailos_guidance"),
    ("auv_path_following", "heading_autopilot"),
    ("auv_sim", "remus_plant"),
    ("auv_sim", "recorder"),
]
NAMESPACE = "/colcon_test"
PATIENCE = 180.0  # s, for a node to appear; it takes about one on an idle machine


def colcon(base: Path, *words: str | Path) -> str:
    """Run colcon in a workspace whose sources are this repository's; what it prints."""
    command = [sys.executable, "-m", "colcon", "--log-base", base / "log", *words]
    done = subprocess.run(command, cwd=base, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def install(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The install folder of a finished `colcon build`."""
    base = tmp_path_factory.mktemp("workspace")
    places = ("--build-base", base / "build", "--install-base", base / "install")
    colcon(base, "build", "--base-paths", ROOT / "src", *places)
    return base / "install"


@pytest.fixture(scope="module")
def domain() -> Iterator[int]:
    """A ROS domain of this test's own, on this machine only."""
    with pytest.MonkeyPatch.context() as patch, free_domain() as number:
        patch.setenv("ROS_DOMAIN_ID", str(number))
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield number


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Node]:
    """A node that looks at the graph."""
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node("observer", context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def in_workspace(install: Path, command: str) -> list[str]:
    return ["bash", "-c", f"source '{install}/setup.bash' && exec {command}"]


@pytest.mark.parametrize(("package", "executable"), EXECUTABLES)
def test_executables_stand_where_ros2_run_looks(install: Path, package: str, executable: str) -> None:
    assert os.access(install / package / "lib" / package / executable, os.X_OK)
    assert (install / package / "share/ament_index/resource_index/packages" / package).is_file()
    assert (install / package / "share" / package / "package.xml").is_file()


def test_colcon_runs_the_tests_of_each_package(install: Path) -> None:
    """A few tests of one room of each: that the others pass is what this run is for."""
    places = ("--build-base", install.parent / "build", "--install-base", install)
    rooms = {"auv_msgs_py": "values", "auv_path_following": "guidance", "auv_sim": "checks"}
    left_out = (
        f" --ignore={path}"  # colcon has options of its own that begin so
        for package, room in rooms.items()
        for path in (ROOT / "test" / package).iterdir()
        if path.name != room
    )
    names = "test_angles or test_los or test_turning"
    chosen = ("--pytest-args", "-k", names, "-p", "no:cacheprovider", *left_out)
    sources = ("--base-paths", ROOT / "src", "--return-code-on-test-failure")
    colcon(install.parent, "test", *sources, *places, *chosen)
    listed = colcon(install.parent, "test-result", "--all", "--test-result-base", install.parent / "build")
    counts = dict(re.findall(r"/(\w+)/pytest\.xml: (\d+) tests?, 0 errors, 0 failures, 0 skipped", listed))
    assert set(counts) == set(rooms), listed
    assert "0" not in counts.values(), listed


def test_shipped_files_are_installed_for_people_and_for_the_package(install: Path) -> None:
    shipped = {path.relative_to(ROOT / "config") for path in (ROOT / "config").rglob("*") if path.is_file()}
    share = install / "auv_path_following/share/auv_path_following/config"
    assert {path.relative_to(share) for path in share.rglob("*") if path.is_file()} == shipped
    ask = "from importlib.resources import files; print(files('auv_path_following') / 'config')"
    command = in_workspace(install, f'{sys.executable} -c "{ask}"')
    found = Path(
        subprocess.run(command, cwd=install, capture_output=True, text=True, check=True).stdout.strip()
    )
    assert install in found.parents
    assert {path.relative_to(found) for path in found.rglob("*") if path.is_file()} == shipped


def test_launch_files_stand_where_ros2_launch_looks(install: Path) -> None:
    shipped = {path.name for path in (ROOT / "src/auv_sim/launch").iterdir() if ".launch." in path.name}
    assert shipped == {"mission.launch.py", "vehicle.launch.py", "two_vehicles.launch.xml"}
    assert {path.name for path in (install / "auv_sim/share/auv_sim/launch").iterdir()} == shipped
    assert os.access(install / "auv_sim/lib/auv_sim/mission_supervisor", os.X_OK)


def test_a_printed_command_works_where_there_is_no_scripts_folder(install: Path) -> None:
    """A mission of `ros2 launch` ends with the next command, as one of `scripts/mission.py` does."""
    ask = "from auv_sim.command_line import to_type; print(to_type('vehicle.py', '--help'))"
    command = in_workspace(install, f'{sys.executable} -c "{ask}"')
    printed = subprocess.run(command, cwd=install, capture_output=True, text=True, check=True).stdout
    done = subprocess.run(
        in_workspace(install, printed.strip()), cwd=install, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0 and "manoeuvres" in done.stdout, printed + done.stderr


@pytest.mark.parametrize(("package", "executable"), EXECUTABLES)
def test_executables_start_in_a_namespace_and_leave_on_sigint(
    install: Path, observer: Node, tmp_path: Path, package: str, executable: str
) -> None:
    path = install / package / "lib" / package / executable
    command = in_workspace(install, f"'{path}' --ros-args -r __ns:={NAMESPACE} -p use_sim_time:=true")
    with (tmp_path / "output").open("w+") as output:
        process = subprocess.Popen(command, cwd=tmp_path, stdout=output, stderr=output)
        try:
            deadline = time.monotonic() + PATIENCE
            while (executable, NAMESPACE) not in observer.get_node_names_and_namespaces():
                assert process.poll() is None and time.monotonic() < deadline, (
                    tmp_path / "output"
                ).read_text()
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE) == 0, (tmp_path / "output").read_text()
        finally:
            process.kill()
            process.wait()
    assert "Traceback" not in (tmp_path / "output").read_text()
