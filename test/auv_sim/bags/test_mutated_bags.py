"""Recordings spoiled at random are read as far as they go, or refused in one line; see `test/mutation`."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from mutation.__main__ import CPU_BOUND
from mutation.readers import Cases

#: Cases of each reader: more are seen by `python3 -m mutation` in the folder `test`.
CASES = 8


@pytest.mark.parametrize(
    "name",
    [
        "mcap", "mcap_zstd", "sqlite", "sqlite_packed", "sqlite_wal", "ros1", "metadata", "metadata_sqlite",
    ],
)  # fmt: skip
def test_every_reader_of_recordings_survives(tmp_path: Path, name: str) -> None:
    cases = Cases(name, tmp_path)
    for number in range(CASES):
        file = cases.put_down(number)
        begun = time.process_time()
        cases.is_read(file)
        assert time.process_time() - begun < CPU_BOUND, f"case {number}"
