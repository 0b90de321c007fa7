"""Identifies the code that a campaign is flown with: runs of two versions are not combined."""

from __future__ import annotations

import functools
from pathlib import Path

import auv_msgs_py
import auv_path_following
import auv_sim
from auv_sim.flight.batch.compiled import digest_of, files_of

#: All code that a run passes through, from the study's file to its row: more than what is compiled.
_FLOWN_BY = (
    *((auv_msgs_py, f"{room}/*.py") for room in ("values", "settings", "contract")),
    (auv_path_following, "*.py"),
    *((auv_path_following, f"{room}/**/*.py") for room in ("curves", "missions", "navigation")),
    *((auv_path_following, f"{room}/**/*.py") for room in ("guidance", "control", "comparators")),
    (auv_sim, "*parameters.py"),
    (auv_sim, "flight/**/*.py"),
    (auv_sim, "vehicle/**/*.py"),
    (auv_sim, "studies/settings_changes.py"),
    *(
        (auv_sim, f"studies/campaign/{name}.py")
        for name in ("distributions", "campaign_plan", "study_file", "study_files", "run_table", "targets")
    ),
)


def files() -> list[Path]:
    """Return the files of that code, in order."""
    return files_of(_FLOWN_BY)


@functools.cache
def code_digest() -> str:
    """Return a digest of these files."""
    return digest_of(files())
