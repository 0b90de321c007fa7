"""What commands print: as it is, safely, and also when the reader has gone."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from rich.table import Table

from auv_sim import command_line, terminal

ROOT = Path(__file__).resolve().parents[2]


def test_what_was_written_and_what_comes_next_are_printed_as_they_are(
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = terminal.console()
    terminal.wrote(out, Path("runs/leg [/m] [bold]") / "bag", "every topic [m/s]")
    terminal.go_on(out, "Look [red]further", "python3 scripts/bag.py report 'runs/leg [/m]'")
    assert capsys.readouterr().out == (
        "  runs/leg [/m] [bold]/bag  every topic [m/s]\n"
        "\nLook [red]further:  python3 scripts/bag.py report 'runs/leg [/m]'\n"
    )


def test_a_command_goes_on_when_its_reader_has_gone() -> None:
    code = (
        "import sys\n"
        "from auv_sim.terminal import console, progress_bar\n"
        "c = console()\n"
        "for k in range(2000): c.print('x' * 100)\n"
        "with progress_bar(c) as bar: bar.advance(bar.add_task('fly', total=1))\n"
        "print('still here', file=sys.stderr)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None and process.stderr is not None
    process.stdout.close()
    assert process.stderr.read() == "still here\n"
    assert process.wait() == 0


def test_text_from_a_file_cannot_steer_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    evil = "a\x1b]0;title\x07b\x1b[2J"
    console = terminal.console(force_terminal=True)
    console.print(f"[red]{evil}[/red]\nsecond")
    table = Table()
    table.add_column(evil)
    console.print(table)
    command_line.say(f"{evil}\nsecond")
    shown = capsys.readouterr().out
    assert "\x1b]" not in shown and "\x1b[2J" not in shown and "\x07" not in shown
    assert shown.count("a\\x1b]0;title") == 3
    assert "\x1b[31m" in shown  # rich's own colour


def test_text_from_recordings_is_printed_in_one_place() -> None:
    for room in ("bags", "launch"):
        modules = sorted((ROOT / "src" / "auv_sim" / "auv_sim" / room).rglob("*.py"))
        assert modules
        for path in modules:
            for line in path.read_text(encoding="utf-8").splitlines():
                plain = re.match(r"\s*print\(", line) and "json.dumps" not in line
                assert not plain, f"{path.name}: {line.strip()}: say() shows it as it is safe"
