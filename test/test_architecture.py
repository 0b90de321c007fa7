"""The rules of the house that a machine can check: imports, rooms, forbidden names."""

from __future__ import annotations

import ast
import functools
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from source_facts import facts

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("auv_msgs_py", "auv_path_following", "auv_sim")  # each may import itself and those before it
#: Rooms, and modules beside them, in the order in which they may import each other: only what stands before.
ROOMS = (
    ("auv_msgs_py", ("values", "settings", "contract", "node")),
    (
        "auv_path_following",
        (
            "config_files", "registry", "thrust_units", "abilities", "vertical_hull", "hull_coefficients",
            "vehicle", "curves", "navigation", "missions", "control", "guidance", "mission_check",
            "parameters", "pilot", "spatial_pilot", "pilots", "course", "comparators", "nodes",
        ),
    ),
)  # fmt: skip
#: What needs ROS 2 or a bag's format at run time.
ROS = re.compile(
    r"rclpy|rcl_interfaces|ament_index_python|builtin_interfaces|rosidl\w*|\w+_msgs|std_srvs|rosbags|mcap\w*"
)
#: The rooms and modules that may need ROS. All others work without it, whatever they import.
ROS_ROOMS = (
    "auv_msgs_py.contract.conversions",
    "auv_msgs_py.contract.qos",
    "auv_msgs_py.contract.spatial_conversions",
    "auv_msgs_py.node",
    "auv_path_following.nodes",
    "auv_sim.bags",
    "auv_sim.checks.benchmark",
    "auv_sim.checks.faults",
    "auv_sim.checks.soak",
    "auv_sim.checks.vehicle_check.live",
    "auv_sim.cli",
    "auv_sim.launch",
    "auv_sim.nodes",
    "auv_sim.own_vehicle.verbs",
    "auv_sim.studies.campaign.campaign_replay",
    "auv_sim.studies.campaign.campaign_session",
    "auv_sim.studies.gallery_session",
)
#: A room with more modules than this needs rooms of its own inside.
MOST_MODULES = 12
#: A law that looks at a clock or rolls unseeded dice cannot be repeated.
UNREPEATABLE = {"time", "datetime", "random"}

MODULES = sorted(path for name in PACKAGES for path in (ROOT / "src" / name / name).rglob("*.py"))
SCRIPTS = sorted((ROOT / "scripts").glob("*.py"))
TESTS = sorted((ROOT / "test").rglob("*.py"))


@functools.cache
def dotted(path: Path) -> str:
    """``.../src/auv_sim/auv_sim/vehicle/remus.py`` -> ``auv_sim.vehicle.remus``."""
    parts = path.relative_to(ROOT / "src").with_suffix("").parts[1:]
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def may_use_ros(module: str) -> bool:
    return any(module == room or module.startswith(room + ".") for room in ROS_ROOMS)


@functools.cache
def sources(path: Path) -> frozenset[str]:
    """The modules of the suite that a module imports from."""
    named = {found for name in facts(path).imports for found in (name, name.rpartition(".")[0])}
    return frozenset(named & {dotted(other) for other in MODULES} - {dotted(path)})


def needing_ros() -> set[str]:
    """Modules that import ROS, themselves or through others."""
    found = {
        dotted(path)
        for path in MODULES
        if any(ROS.fullmatch(n.split(".")[0]) for n in facts(path).imports if n.split(".")[0] not in PACKAGES)
    }
    graph = {dotted(path): sources(path) for path in MODULES}
    while more := {module for module, used in graph.items() if used & found} - found:
        found |= more
    return found


#: A private attribute of something that goes by the name of one of rclpy's objects.
OF_RCLPY = r"(node|publisher|subscription|executor|clock)\._[^_]\w*$"


def test_one_module_alone_uses_private_parts_of_rclpy_and_one_of_numba() -> None:
    """Underscore names that the suite does not define, `handle`, and modules behind rclpy's public ones."""
    harmless = {"_asdict", "_fields", "_replace", "_exit", "_getframe"}
    harmless = harmless.union(*(facts(path).defined for path in MODULES))
    users = set()
    for path in MODULES:
        names = facts(path).attributes
        private = {name for name in names - harmless if re.fullmatch(r"_[^_]\w*", name)}
        private |= names & {"handle"} | {name for name in names if re.search(OF_RCLPY, name)}
        if private or any(re.match(r"rclpy\.(_|impl\b)", name) for name in facts(path).imports):
            users.add(dotted(path))
    assert users == {"auv_msgs_py.node.private_rclpy", "auv_sim.flight.batch.compiled"}


def test_there_is_something_to_look_at() -> None:
    assert {dotted(path).split(".")[0] for path in MODULES} == set(PACKAGES)


def test_imports_point_one_way() -> None:
    against = [
        f"{dotted(path)} imports {name}"
        for path in MODULES
        for name in facts(path).imports
        if name.split(".")[0] in PACKAGES[PACKAGES.index(dotted(path).split(".")[0]) + 1 :]
    ]
    assert against == []


@pytest.mark.parametrize(("package", "rooms"), ROOMS, ids=[package for package, _ in ROOMS])
def test_rooms_of_a_package_import_one_way(package: str, rooms: tuple[str, ...]) -> None:
    found = {dotted(path).split(".")[1] for path in MODULES if dotted(path).startswith(f"{package}.")}
    assert found == set(rooms)
    for path in MODULES:
        own, *parts = dotted(path).split(".")
        if own != package or not parts:
            continue
        allowed = rooms[: rooms.index(parts[0]) + 1]
        for source in sources(path):
            top, *inner = source.split(".")
            if top == package and inner:
                assert inner[0] in allowed, f"{dotted(path)} imports {source}"


@pytest.mark.parametrize("package", PACKAGES)
def test_no_modules_import_each_other_in_a_circle(package: str) -> None:
    modules = [path for path in MODULES if path.name != "__init__.py" and dotted(path).startswith(package)]
    left = {dotted(path): sources(path) for path in modules}
    while free := [name for name, used in left.items() if not used & left.keys()]:
        for name in free:
            del left[name]
    assert left == {}, "these import each other in a circle, or import a module that does"


def test_ros_stays_at_the_border() -> None:
    assert {module for module in needing_ros() if not may_use_ros(module)} == set()


def test_every_named_room_needs_ros() -> None:
    """A room that no longer needs ROS leaves the list, and CONTRIBUTING.md with it."""
    found = needing_ros()
    assert [room for room in ROS_ROOMS if not any(f"{m}.".startswith(f"{room}.") for m in found)] == []


def test_a_room_has_few_modules() -> None:
    rooms = Counter(path.parent for path in MODULES if path.name != "__init__.py")
    assert {dotted(room): count for room, count in rooms.items() if count > MOST_MODULES} == {}


def test_laws_are_repeatable() -> None:
    against = []
    for path in MODULES:
        if may_use_ros(dotted(path)):
            continue
        found = facts(path)
        used = {name for name in found.imports if name.split(".")[0] in UNREPEATABLE}
        used |= {f"np.random.{name}" for name in found.random - {"default_rng", "Generator"}}
        against += [f"{dotted(path)} uses {name}" for name in sorted(used)]
    assert against == []


def test_annotations_are_not_evaluated() -> None:
    for path in (*MODULES, *SCRIPTS, *TESTS):
        if facts(path).has_annotations:
            assert "__future__.annotations" in facts(path).imports, str(path.relative_to(ROOT))


def test_an_older_python_can_read_a_script_far_enough_to_say_so() -> None:
    for path in SCRIPTS:
        ast.parse(path.read_text(encoding="utf-8"), path.name, feature_version=(3, 8))


def texts() -> list[Path]:
    folders = ("src", "scripts", "test", "config", "docs", "requirements", ".ci")
    found = [path for folder in folders for path in (ROOT / folder).rglob("*") if path.is_file()]
    found += [path for path in ROOT.iterdir() if path.is_file()]
    made = {
        "node_modules",
        ".mypy_cache",
        ".pytest_cache",
        ".ruff_cache",
        ".hypothesis",
        "__pycache__",
        "build",
    }
    kinds = {
        "",
        ".py",
        ".md",
        ".toml",
        ".cfg",
        ".xml",
        ".yaml",
        ".yml",
        ".txt",
        ".json",
        ".sh",
        ".rviz",
        ".lock",
    }
    return sorted(
        path for path in found if path.suffix in kinds and not made & set(path.parts) and path.name != ".git"
    )


def test_nothing_names_a_machine_or_a_registry() -> None:
    # Put together from pieces, so that this file does not name them either.
    places = r"(?<![\w.~*}])/(?:work|tmp|root|home|mnt)/\w"
    registries = "|".join(
        map(re.escape, ("pypi" + ".org", "python" + "hosted", "registry." + "npm", "npm" + "js."))
    )
    forbidden = re.compile(f"{places}|{registries}")
    for path in texts():
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            assert not forbidden.search(line), f"{path.relative_to(ROOT)}:{number}: {line.strip()}"


NODES = (
    "auv_path_following.nodes.current_observer_node",
    "auv_path_following.nodes.guidance_node",
    "auv_path_following.nodes.heading_autopilot_node",
    "auv_sim.nodes.plant_node",
    "auv_sim.nodes.recorder_node",
    "auv_sim.nodes.mavlink.driver",
)


def test_a_node_does_not_pay_for_what_it_does_not_use() -> None:
    """Five of them start at once: each slow import is paid five times before the mission begins."""
    code = (
        "import importlib, sys\n"
        "for name in sys.argv[1:]:\n"
        "    importlib.import_module(name)\n"
        "    print(*(f'{name}: {slow}' for slow in {'scipy', 'matplotlib', 'rich'} & set(sys.modules)))\n"
    )
    done = subprocess.run([sys.executable, "-c", code, *NODES], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
