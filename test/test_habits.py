"""The files that keep the repository's habits agree with each other."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

from doc_pages import PAGES, ROOT, copies
from test_architecture import MOST_MODULES
from test_names_and_sizes import MOST_OF_FILE, MOST_OF_NODE, MOST_OF_TEST

TEMPLATES = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))


def pins(name: str) -> dict[str, str]:
    text = (ROOT / "requirements" / name).read_text(encoding="utf-8")
    return {pair[1].lower(): pair[2] for pair in re.finditer(r"(?m)^([\w.-]+)==(\S+)$", text)}


def test_pre_commit_uses_the_pinned_versions() -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"][0][
        "hooks"
    ]
    asked = [line for hook in hooks for line in hook["additional_dependencies"]]
    fixed = pins("constraints.txt") | pins("ros.txt")
    assert {line.split("==")[0] for line in asked} >= {"ruff", "mypy"}
    for line in asked:
        name, version = line.split("==")
        assert fixed[name.lower()] == version, f".pre-commit-config.yaml: {line}"


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda path: path.name)
def test_issue_templates_are_whole(path: Path) -> None:
    form = yaml.safe_load(path.read_text(encoding="utf-8"))
    if "body" not in form:
        return
    assert form["name"] and form["description"]
    identities = [item["id"] for item in form["body"] if item["type"] != "markdown"]
    assert len(set(identities)) == len(identities) > 0


def test_the_quality_declaration_is_linked_and_names_the_version() -> None:
    declaration = (ROOT / "QUALITY_DECLARATION.md").read_text(encoding="utf-8")
    manifest = (ROOT / "src" / "auv_sim" / "package.xml").read_text(encoding="utf-8")
    (version,) = re.findall(r"<version>(.*)</version>", manifest)
    assert f"version is {version}" in declaration
    assert "(QUALITY_DECLARATION.md)" in (ROOT / "README.md").read_text(encoding="utf-8")


def contributing() -> str:
    return (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "number", range(4), ids=["order of rooms", "rooms that need ROS", "law", "line of the law"]
)
def test_a_page_shows_what_the_code_has(number: int) -> None:
    page, shown, source = list(copies())[number]
    assert shown == source, f"{page}: cd test && python3 -m doc_pages"


def test_contributing_gives_the_limits_that_are_held() -> None:
    limits = (
        f"Files have at most {MOST_OF_FILE} lines, nodes at most {MOST_OF_NODE}, tests at most {MOST_OF_TEST}"
    )
    assert f"{limits}." in contributing()
    assert f"A folder has at most {MOST_MODULES} modules." in contributing()


@pytest.mark.parametrize("page", PAGES)
def test_the_files_that_a_page_names_exist(page: str) -> None:
    """By the end of their path; names without a folder only in CONTRIBUTING.md."""
    folders = ("src", "test", "docs", "scripts", "examples", "config")
    files = [path.as_posix() for folder in folders for path in (ROOT / folder).rglob("*")]
    folder = "" if page == "CONTRIBUTING.md" else r"[\w.]+/"
    pattern = rf"`({folder}[\w/.]+\.(?:py|md|csv))[`:]"
    for name in re.findall(pattern, (ROOT / page).read_text(encoding="utf-8")):
        assert (ROOT / name).exists() or any(path.endswith(f"/{name}") for path in files), name
