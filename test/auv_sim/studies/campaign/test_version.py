"""The version that a campaign is flown with has all the code in it that a run passes through."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from auv_sim.studies.campaign import version


def test_everything_that_a_run_passes_through_counts() -> None:
    code = (
        "import sys\n"
        "from auv_path_following import config_files\n"
        "from auv_sim.studies.campaign import runner\n"
        "from auv_sim.studies.campaign.campaign_plan import StudyPlan\n"
        "for name in ('currents', 'region_of_attraction'):\n"
        "    StudyPlan(config_files.find('studies', name)).scenario(0)\n"
        "for name, module in sys.modules.items():\n"
        "    if name.startswith('auv_'):\n"
        "        print(module.__file__)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    used = {Path(line) for line in done.stdout.split()}
    assert {"closed_loop.py", "metrics.py", "vehicle.py", "targets.py", "nism.py"} <= {
        path.name for path in used
    }
    # What only hands the runs out and keeps their rows does not change them.
    handing_out = {
        "__init__.py",
        "command_line.py",
        "runner.py",
        "store.py",
        "version.py",
        "pool.py",
        "log_directory.py",
    }
    assert {path for path in used - set(version.files()) if path.name not in handing_out} == set()


def test_another_version_has_another_name(tmp_path: Path, monkeypatch) -> None:
    law = tmp_path / "law.py"
    monkeypatch.setattr(version, "files", lambda: [law])
    digests = []
    for text in ("a = 1", "a = 2", "a = 1"):
        law.write_text(text, encoding="utf-8")
        digests.append(version.code_digest.__wrapped__())
    assert digests[0] == digests[2] != digests[1]
