"""Run the commands of docs/tutorial.md in a directory; as a program, also renew the page's pictures.

cd test && python3 -m tutorial
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from doc_pages import ROOT

PAGE = "docs/tutorial.md"
#: What a command writes -> the page's picture.
PICTURES = {
    "plan-my_survey.png": "tutorial_plan.png",
    "runs/first/overview.png": "tutorial_first.png",
    "compare.png": "tutorial_compare.png",
}


class Step(NamedTuple):
    """A command, and the lines that the page quotes from its output."""

    command: str
    quoted: tuple[str, ...]


def text() -> str:
    return (ROOT / PAGE).read_text(encoding="utf-8")


def steps() -> list[Step]:
    """Return the page's commands in their order."""
    found: list[Step] = []
    pattern = re.compile(r"^    ((?:python3|sed) [^\n]*)$|^```text\n(.*?)^```", re.MULTILINE | re.DOTALL)
    for match in pattern.finditer(text()):
        if match[1]:
            found.append(Step(match[1], ()))
        else:
            found[-1] = Step(found[-1].command, tuple(match[2].splitlines()))
    return found


def prepare(directory: Path) -> None:
    """Put the page's mission into a directory that looks like the root of the repository."""
    (mission,) = re.findall(r"^```yaml\n(.*?)^```", text(), re.MULTILINE | re.DOTALL)
    (directory / "my_survey.yaml").write_text(mission, encoding="utf-8")
    for name in ("scripts", "config"):
        (directory / name).symlink_to(ROOT / name)


def run(command: str, directory: Path) -> str:
    """Run a command of the page with this interpreter; return its output.

    Raises:
        subprocess.CalledProcessError: its exit code is not 0.
    """
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        ["bash", "-c", command],
        cwd=directory,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=True,
        timeout=180,
    ).stdout


def check(step: Step, printed: str) -> None:
    """Compare the quoted lines with the output, whatever the spaces between their columns.

    Raises:
        AssertionError: a quoted line is not in the output.
    """
    lines = [line.replace("│", " ").split() for line in printed.splitlines()]
    for quote in step.quoted:
        assert quote.replace("│", " ").split() in lines, f"{step.command}: {quote}"


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(folder)
        prepare(directory)
        for step in steps():
            print("$", step.command, flush=True)
            printed = run(step.command, directory)
            print(printed)
            check(step, printed)
        for made, picture in PICTURES.items():
            shutil.copyfile(directory / made, ROOT / "docs" / "images" / picture)


if __name__ == "__main__":
    main()
