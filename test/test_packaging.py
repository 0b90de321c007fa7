"""The three packages as their tools see them: catkin_pkg, setuptools, pip."""

from __future__ import annotations

import ast
import importlib
import importlib.metadata
import itertools
import re
import runpy
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
import setuptools
import yaml
from catkin_pkg.package import Package, parse_package
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from auv_msgs_py.contract import topics

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("auv_msgs_py", "auv_path_following", "auv_sim")
EXECUTABLES = {
    "auv_msgs_py": set(),
    "auv_path_following": {"current_observer", "ailos_guidance", "heading_autopilot"},
    "auv_sim": {
        "remus_plant",
        "recorder",
        "fault_relay",
        "fleet_clock",
        "check_vehicle",
        "mavlink_driver",
        "mavlink_emulator",
        "mission_supervisor",
        "display",
        "manoeuvres",
        "mavlink_strangers",
    },
}
#: Import names that differ from the name to install.
DISTRIBUTIONS = {
    "yaml": "PyYAML",
    "foxglove": "foxglove-sdk",
    "pydantic_core": "pydantic",
    "mpl_toolkits": "matplotlib",
}
#: Import name -> rosdep key (rosdistro's rosdep/python.yaml), for what is not a ROS package.
ROSDEP_KEYS = {
    "hypothesis": "python3-hypothesis",
    "matplotlib": "python3-matplotlib",
    "mpl_toolkits": "python3-matplotlib",
    "numpy": "python3-numpy",
    "pydantic": "python3-pydantic",
    "pydantic_core": "python3-pydantic",
    "pymap3d": "python3-pymap3d",
    "pymavlink": "python3-pymavlink-pip",
    "pytest": "python3-pytest",
    "rich": "python3-rich",
    "rosbags": "python3-rosbags-pip",
    "scipy": "python3-scipy",
    "yaml": "python3-yaml",
}
#: For these rosdep has no key. mcap brings zstandard; Pillow comes with matplotlib.
WITHOUT_KEY = {"mcap", "zstandard"}
#: The suite works without them, or says in one line how to install them.
OPTIONAL = {"aiohttp", "cma", "distributed", "foxglove", "numba", "pyarrow"}
#: The message packages that auv_msgs_py finds by the names in its table of topics, and those of the services.
BY_NAME = {topic.type.split("/")[0] for topic in (*topics.CONTRACT, *topics.RECORDING)} | {"std_srvs"}

#: What reads the launch files that auv_sim installs.
LAUNCH = {"launch_xml", "ros2launch"}


def manifest(name: str) -> Package:
    warnings: list[str] = []
    package = parse_package(str(ROOT / "src" / name), warnings=warnings)
    assert warnings == []
    return package


def described(name: str, monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What setup.py hands to setuptools."""
    monkeypatch.chdir(ROOT / "src" / name)
    with mock.patch.object(setuptools, "setup") as setup:
        runpy.run_path("setup.py")
    return dict(setup.call_args.kwargs)


@pytest.mark.parametrize("name", PACKAGES)
def test_ros_takes_the_manifest_for_an_ament_python_package(name: str) -> None:
    package = manifest(name)
    package.validate()
    assert (package.name, package.package_format) == (name, 3)
    assert package.get_build_type() == "ament_python"
    assert package.licenses == ["Apache-2.0"]
    assert (ROOT / "src" / name / "resource" / name).is_file()
    assert (ROOT / "src" / name / name / "py.typed").is_file()


def test_there_is_one_version(monkeypatch: pytest.MonkeyPatch) -> None:
    newest = re.search(r"^## \[(.+?)\]", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert newest
    versions = {f"{name}/package.xml": manifest(name).version for name in PACKAGES}
    versions |= {f"{name}/setup.py": described(name, monkeypatch)["version"] for name in PACKAGES}
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    versions["CITATION.cff"] = cited["version"]
    assert versions == dict.fromkeys(versions, newest[1])


@pytest.mark.parametrize("name", PACKAGES)
def test_setup_says_what_the_manifest_says(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    package, setup = manifest(name), described(name, monkeypatch)
    assert (setup["name"], setup["description"], setup["license"]) == (
        name,
        package.description,
        "Apache-2.0",
    )
    assert (setup["maintainer"], setup["maintainer_email"]) == (
        package.maintainers[0].name,
        package.maintainers[0].email,
    )


@pytest.mark.parametrize("name", PACKAGES)
def test_every_executable_has_a_function_behind_it(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scripts = described(name, monkeypatch).get("entry_points", {}).get("console_scripts", [])
    targets = dict(re.split(r"\s*=\s*", script) for script in scripts)
    assert set(targets) == EXECUTABLES[name]
    for target in targets.values():
        module, function = target.split(":")
        assert callable(getattr(importlib.import_module(module), function)), target


@pytest.mark.parametrize("name", PACKAGES)
def test_every_module_is_packaged(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    packaged = set(described(name, monkeypatch)["packages"])
    folders = {
        path.parent.relative_to(ROOT / "src" / name) for path in (ROOT / "src" / name / name).rglob("*.py")
    }
    assert {".".join(folder.parts) for folder in folders} == packaged


def imported(*folders: Path) -> set[str]:
    """Top-level names that the Python files below some folders import, without the standard library's."""
    tops = set()
    for path in itertools.chain.from_iterable(folder.rglob("*.py") for folder in folders):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                tops |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                tops.add(str(node.module).split(".")[0])
    return tops - set(sys.stdlib_module_names)


def sources(name: str) -> set[str]:
    return imported(ROOT / "src" / name / name) - {name}


@pytest.mark.parametrize("name", PACKAGES)
def test_the_manifest_names_what_is_imported_and_nothing_else(name: str) -> None:
    """By rosdep key where there is one; ROS packages and the suite's own by their names."""
    declared = {dependency.name for dependency in manifest(name).exec_depends}
    used = sources(name) | (BY_NAME if name == "auv_msgs_py" else set())
    used |= LAUNCH if name == "auv_sim" else set()
    assert declared == {ROSDEP_KEYS.get(top, top) for top in used - WITHOUT_KEY - OPTIONAL}


@pytest.mark.parametrize("name", PACKAGES)
def test_setup_names_what_pip_has_to_install(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Everything imported that is no ROS package; what can be missing stands among the extras."""
    setup = described(name, monkeypatch)
    required = {Requirement(line).name for line in setup["install_requires"]}
    groups = setup["extras_require"]
    assert {Requirement(line).name for line in groups.pop("test")} <= {"hypothesis", "pytest"}
    extras = {Requirement(line).name for line in itertools.chain(*groups.values())}
    ours = {top for top in sources(name) if top in {*ROSDEP_KEYS, *WITHOUT_KEY, *OPTIONAL, *PACKAGES}}
    assert required == {DISTRIBUTIONS.get(top, top) for top in ours - OPTIONAL}
    assert extras == {DISTRIBUTIONS.get(top, top) for top in ours & OPTIONAL}


def test_the_requirement_files_bring_what_the_packages_need() -> None:
    needed = set().union(*(sources(name) for name in PACKAGES)) & {*ROSDEP_KEYS, *WITHOUT_KEY, *OPTIONAL}
    listed = {
        line
        for name in ("ros", "tools", "batch", "cluster", "console", "foxglove", "vehicle")
        for line in (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8").splitlines()
    }
    assert {DISTRIBUTIONS.get(top, top) for top in needed} <= {line.split("==")[0] for line in listed}


def test_the_workspace_page_names_what_rosdep_cannot_install() -> None:
    page = (ROOT / "docs" / "ros2_workspace.md").read_text(encoding="utf-8")
    (line,) = re.findall(r"rosdep has no key for .*", page)
    assert set(re.findall(r"`(\w+)`", line)) == WITHOUT_KEY


@pytest.mark.parametrize("name", PACKAGES)
def test_the_manifest_names_what_the_tests_import(name: str) -> None:
    package = manifest(name)
    declared = {dependency.name for dependency in package.exec_depends + package.test_depends}
    # The helpers of test/ serve all three packages, and pytest reads their sources in place.
    helpers = {each.stem for each in (ROOT / "test").iterdir()}
    tops = imported(ROOT / "test" / name) - helpers - set(PACKAGES)
    brought = {"PIL", "yarl"}  # by matplotlib and aiohttp
    assert {ROSDEP_KEYS.get(top, top) for top in tops - WITHOUT_KEY - OPTIONAL - brought} <= declared


def test_an_old_pydantic_is_named_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "pydantic-1.10.14.dist-info").mkdir()
    (tmp_path / "pydantic-1.10.14.dist-info" / "METADATA").write_text("Name: pydantic\nVersion: 1.10.14\n")
    command = [
        sys.executable,
        "-c",
        "import sys; sys.path.insert(0, sys.argv[1]); import auv_msgs_py",
        tmp_path,
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.strip() == (
        "auv_msgs_py: found pydantic 1.10.14, expected 2 or newer: python3 -m pip install 'pydantic>=2'"
    )


def test_the_shipped_files_are_in_the_wheel(tmp_path: Path) -> None:
    # From a copy: pip builds beside the source. The link to the shipped files has to survive as a link.
    shutil.copytree(ROOT / "config", tmp_path / "config")
    source = tmp_path / "src" / "auv_path_following"
    made = shutil.ignore_patterns("build", "*.egg-info", "__pycache__", ".*_cache")
    shutil.copytree(ROOT / "src" / "auv_path_following", source, symlinks=True, ignore=made)
    command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--no-index"]
    subprocess.run([*command, "--use-pep517", "-w", tmp_path, source], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    inside = set(zipfile.ZipFile(wheel).namelist())
    shipped = {str(path.relative_to(ROOT)) for path in (ROOT / "config").rglob("*") if path.is_file()}
    assert shipped
    assert {f"auv_path_following/{path}" for path in shipped} <= inside
    share = f"{wheel.name.removesuffix('-py3-none-any.whl')}.data/data/share/auv_path_following"
    assert {f"{share}/{path}" for path in shipped} <= inside


def pins() -> dict[str, str]:
    lines = (ROOT / "requirements" / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pairs = (line.split("==") for line in lines if line and not line.startswith("#"))
    return {canonicalize_name(name): version for name, version in pairs}


def test_everything_installed_for_the_suite_is_pinned() -> None:
    """Walks from the requirement files through what each distribution says it needs."""
    ours = Path(sys.prefix, "lib")
    open_requirements = [
        Requirement(line)
        for name in ("ros", "tools", "batch", "cluster", "vehicle", "dev", "docs")
        for line in (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8").splitlines()
        if line and line[0] not in "#-"
    ]
    fixed, seen = pins(), set()
    while open_requirements:
        requirement = open_requirements.pop()
        name = canonicalize_name(requirement.name)
        if name in seen or (requirement.marker and not requirement.marker.evaluate({"extra": ""})):
            continue
        seen.add(name)
        try:
            distribution = importlib.metadata.distribution(name)
        except importlib.metadata.PackageNotFoundError:
            assert name.startswith("ros-"), f"{name} is missing"  # a sourced ROS has no wheels
            continue
        open_requirements += [Requirement(line) for line in distribution.requires or ()]
        if name != "numpy" and ours in Path(str(distribution.locate_file(""))).parents:
            assert fixed.get(name) == distribution.version, f"requirements/constraints.txt: {name}"
