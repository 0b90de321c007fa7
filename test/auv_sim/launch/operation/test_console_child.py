"""The console as a child: its log has the token, and its end has a line."""

from __future__ import annotations

import stat
from pathlib import Path

from auv_sim.launch.operation import console_child
from auv_sim.launch.processes.process_group import Children


def test_the_log_is_its_owners_alone_from_the_start(tmp_path: Path) -> None:
    log = tmp_path / "console.log"
    log.write_text("of a former run")
    log.chmod(0o644)
    children = Children(tmp_path, {})
    console_child.start(children, 300)
    assert stat.S_IMODE(log.stat().st_mode) == 0o600
    (child,) = children
    child.process.wait(180.0)
    said = console_child.addresses(children, lambda _: None)
    assert said.startswith("no console: ")
    assert "from 0 to 232" in said
