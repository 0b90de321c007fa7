"""Every reader against some spoiled files, always the same ones: read, or refused in one line.

`python3 -m mutation --minutes 30`, in this folder's parent, spoils other ones for as long as there is time.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from mutation.readers import READERS, Cases

#: Recordings take longer: each case is inspected, exported and repaired.
SOME, FEW = 40, 4
#: Waypoint files have a test of their own, of their readers alone.
NAMES = [name for name, reader in READERS.items() if not reader.file.startswith("places.")]


@pytest.mark.parametrize("name", NAMES)
def test_a_spoiled_file_is_read_or_refused(tmp_path: Path, name: str) -> None:
    cases = Cases(name, tmp_path)
    is_recording = READERS[name].file.startswith("bag/")
    read = sum(cases.is_read(cases.put_down(number)) for number in range(FEW if is_recording else SOME))
    assert read > 0 or name == "mission"  # not every case is refused at once
