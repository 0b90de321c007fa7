"""The rules of the house that a machine can check: imports, rooms, forbidden names."""

from __future__ import annotations

import ast
import functools
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

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


@functools.cache
def imports(path: Path) -> tuple[str, ...]:
    """Every module named by an import, wherever it stands; `from a import b` gives ``a.b``."""
    found: list[str] = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import hides where it points"
            found += (f"{node.module}.{alias.name}" for alias in node.names)
    return tuple(found)


def may_use_ros(module: str) -> bool:
    return any(module == room or module.startswith(room + ".") for room in ROS_ROOMS)


@functools.cache
def sources(path: Path) -> frozenset[str]:
    """The modules of the suite that a module imports from."""
    named = {found for name in imports(path) for found in (name, name.rpartition(".")[0])}
    return frozenset(named & {dotted(other) for other in MODULES} - {dotted(path)})


def needing_ros() -> set[str]:
    """Modules that import ROS, themselves or through others."""
    found = {
        dotted(path)
        for path in MODULES
        if any(ROS.fullmatch(n.split(".")[0]) for n in imports(path) if n.split(".")[0] not in PACKAGES)
    }
    graph = {dotted(path): sources(path) for path in MODULES}
    while more := {module for module, used in graph.items() if used & found} - found:
        found |= more
    return found


#: A private attribute of something that goes by the name of one of rclpy's objects.
OF_RCLPY = r"(node|publisher|subscription|executor|clock)\._[^_]\w*$"


def defined(nodes: list[ast.AST]) -> Iterator[str]:
    """Every name that is assigned or defined as a function."""
    for node in nodes:
        match node:
            case (
                ast.Attribute(attr=name, ctx=ast.Store())
                | ast.Name(id=name, ctx=ast.Store())
                | ast.FunctionDef(name=name)
                | ast.AsyncFunctionDef(name=name)
            ):
                yield name


def test_one_module_alone_uses_private_parts_of_rclpy_and_one_of_numba() -> None:
    """Underscore names that the suite does not define, `handle`, and modules behind rclpy's public ones."""
    trees = {path: list(ast.walk(ast.parse(path.read_text(encoding="utf-8")))) for path in MODULES}
    harmless = {"_asdict", "_fields", "_replace", "_exit", "_getframe"}.union(*map(defined, trees.values()))
    users = set()
    for path, nodes in trees.items():
        attributes = [node for node in nodes if isinstance(node, ast.Attribute)]
        names = {node.attr for node in attributes}
        private = {name for name in names - harmless if re.match("_[^_]", name)} | names & {"handle"}
        private |= {name for name in map(ast.unparse, attributes) if re.search(OF_RCLPY, name)}
        if private or any(re.match(r"rclpy\.(_|impl\b)", name) for name in imports(path)):
            users.add(dotted(path))
    assert users == {"auv_msgs_py.node.private_rclpy", "auv_sim.flight.batch.compiled"}


def test_there_is_something_to_look_at() -> None:
    assert {dotted(path).split(".")[0] for path in MODULES} == set(PACKAGES)


@pytest.mark.parametrize("path", MODULES, ids=dotted)
def test_imports_point_one_way(path: Path) -> None:
    allowed = PACKAGES[: PACKAGES.index(dotted(path).split(".")[0]) + 1]
    for name in imports(path):
        top = name.split(".")[0]
        assert top not in PACKAGES or top in allowed, f"{dotted(path)} imports {name}"


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


@pytest.mark.parametrize("room", sorted({path.parent for path in MODULES}), ids=dotted)
def test_a_room_has_few_modules(room: Path) -> None:
    modules = [path.name for path in room.glob("*.py") if path.name != "__init__.py"]
    assert len(modules) <= MOST_MODULES


@pytest.mark.parametrize("path", [path for path in MODULES if not may_use_ros(dotted(path))], ids=dotted)
def test_laws_are_repeatable(path: Path) -> None:
    for name in imports(path):
        assert name.split(".")[0] not in UNREPEATABLE, f"{dotted(path)} imports {name}"
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) in ("np.random", "numpy.random"):
            assert node.attr in ("default_rng", "Generator"), f"{dotted(path)} uses np.random.{node.attr}"


@pytest.mark.parametrize("path", [*MODULES, *SCRIPTS, *TESTS], ids=lambda path: str(path.relative_to(ROOT)))
def test_annotations_are_not_evaluated(path: Path) -> None:
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    if any(isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.AnnAssign) for node in nodes):
        assert "__future__.annotations" in set(imports(path))


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_an_older_python_can_read_a_script_far_enough_to_say_so(path: Path) -> None:
    ast.parse(path.read_text(encoding="utf-8"), feature_version=(3, 8))


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


@pytest.mark.parametrize(
    "module",
    [
        "auv_path_following.nodes.current_observer_node",
        "auv_path_following.nodes.guidance_node",
        "auv_path_following.nodes.heading_autopilot_node",
        "auv_sim.nodes.plant_node",
        "auv_sim.nodes.recorder_node",
        "auv_sim.nodes.mavlink.driver",
    ],
)
def test_a_node_does_not_pay_for_what_it_does_not_use(module: str) -> None:
    """Five of them start at once: each slow import is paid five times before the mission begins."""
    code = f"import sys, {module}; print(*{{'scipy', 'matplotlib', 'rich'}} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
