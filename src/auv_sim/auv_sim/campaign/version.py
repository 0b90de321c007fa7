"""Names the version of the code that a campaign is flown with: runs of two versions are not put together."""

from __future__ import annotations

import functools
from pathlib import Path

import auv_msgs_py
import auv_path_following
import auv_sim
from auv_sim.batch.compiled import digest_of, files_of

#: All that a run passes through, from the study's file to its row: more than what is compiled.
_FLOWN_BY = (
    (auv_msgs_py, "*.py"),
    (auv_path_following, "*.py"),
    (auv_path_following, "control/**/*.py"),
    (auv_path_following, "guidance/**/*.py"),
    (auv_path_following, "paths/**/*.py"),
    (auv_sim, "closed_loop.py"),
    (auv_sim, "*parameters.py"),
    (auv_sim, "analysis/flown_share.py"),
    (auv_sim, "analysis/least_share.py"),
    (auv_sim, "analysis/metrics.py"),
    (auv_sim, "analysis/run.py"),
    (auv_sim, "batch/*.py"),
    (auv_sim, "plant/*.py"),
    *((auv_sim, f"campaign/{name}.py") for name in ("distributions", "plan", "spec", "table", "targets")),
)


def files() -> list[Path]:
    """The files of that code, in order."""
    return files_of(_FLOWN_BY)


@functools.cache
def code_digest() -> str:
    """Another one for every other version of these files."""
    return digest_of(files())
