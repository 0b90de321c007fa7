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
from catkin_pkg.package import Package, parse_package
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("auv_msgs_py", "auv_path_following", "auv_sim")
EXECUTABLES = {
    "auv_msgs_py": set(),
    "auv_path_following": {"current_observer", "ailos_guidance", "heading_autopilot"},
    "auv_sim": {
        "remus_plant",
        "recorder",
        "fault_relay",
        "check_vehicle",
        "mavlink_driver",
        "mavlink_emulator",
    },
}
#: Import names that differ from the name to install.
DISTRIBUTIONS = {"yaml": "PyYAML", "pydantic_core": "pydantic"}


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


@pytest.mark.parametrize("name", PACKAGES)
def test_every_import_is_declared(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """ROS packages in package.xml; everything else in setup.py, what can be missing among its extras."""
    tops = set()
    for path in (ROOT / "src" / name / name).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                tops |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                tops.add(str(node.module).split(".")[0])
    tops -= {name, *sys.stdlib_module_names}
    in_manifest = {dependency.name for dependency in manifest(name).exec_depends}
    setup = described(name, monkeypatch)
    lines = [*setup["install_requires"], *itertools.chain(*setup.get("extras_require", {}).values())]
    in_setup = {Requirement(line).name for line in lines}
    assert {DISTRIBUTIONS.get(top, top) for top in tops} <= in_manifest | in_setup


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
    wanted = [
        Requirement(line)
        for name in ("ros", "tools", "batch", "cluster", "dev")
        for line in (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8").splitlines()
        if line and line[0] not in "#-"
    ]
    fixed, seen = pins(), set()
    while wanted:
        requirement = wanted.pop()
        name = canonicalize_name(requirement.name)
        if name in seen or (requirement.marker and not requirement.marker.evaluate({"extra": ""})):
            continue
        seen.add(name)
        try:
            distribution = importlib.metadata.distribution(name)
        except importlib.metadata.PackageNotFoundError:
            assert name.startswith("ros-"), f"{name} is missing"  # a sourced ROS has no wheels
            continue
        wanted += [Requirement(line) for line in distribution.requires or ()]
        if name != "numpy" and ours in Path(str(distribution.locate_file(""))).parents:
            assert fixed.get(name) == distribution.version, f"requirements/constraints.txt: {name}"
