"""What a command imports before it is told what to do: nothing that takes long."""

from __future__ import annotations

import subprocess
import sys

import pytest

#: Each of these takes 0.1 s or more.
HEAVY = {
    "aiohttp", "matplotlib", "mcap", "numba", "numpy", "pyarrow", "pydantic", "pymavlink", "rclpy", "rich",
    "rosbags", "scipy", "yaml",
}  # fmt: skip


def imported(code: str) -> set[str]:
    """The heavy ones among what a new interpreter has imported behind this code."""
    whole = f"import sys\n{code}\nprint(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", whole], capture_output=True, text=True, check=True)
    return set(done.stderr.split()) & HEAVY


@pytest.mark.parametrize(
    "module",
    [
        "auv_sim.cli.bag",
        "auv_sim.cli.benchmark",
        "auv_sim.cli.campaign",
        "auv_sim.cli.vehicles.check_vehicle",
        "auv_sim.cli.console",
        "auv_sim.cli.fault_matrix",
        "auv_sim.cli.gallery",
        "auv_sim.cli.live_view",
        "auv_sim.cli.mission",
        "auv_sim.cli.plan",
        "auv_sim.cli.reproduce_paper",
        "auv_sim.cli.sea_trials",
        "auv_sim.cli.soak",
        "auv_sim.cli.vehicles.vehicle_command",
    ],
)
def test_help_needs_no_library(module: str) -> None:
    code = f"from {module} import main\ntry: main(['--help'])\nexcept SystemExit as end: assert end.code == 0"
    assert imported(code) == set()


def test_launch_files_need_no_library() -> None:
    """`ros2` may run on an interpreter without them."""
    assert (
        imported("from auv_sim.launch.ros_launch import description; description.arguments.of_mission()")
        == set()
    )


def test_what_draws_and_what_reads_bags_is_loaded_after_the_flight() -> None:
    assert imported("from auv_sim.launch import mission_flight, monitor") == {
        "numpy", "pydantic", "rclpy", "rich", "yaml",
    }  # fmt: skip
