"""Every reader against some spoiled files, always the same ones: read, or refused in one line.

`python3 -m mutation --minutes 30`, in this folder's parent, spoils other ones for as long as there is time.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from mutation.readers import READERS, Cases

SOME = 40
#: Waypoint files and recordings have tests of their own beside those of their readers.
ELSEWHERE = ("places.", "bag/")
NAMES = [name for name, reader in READERS.items() if not reader.file.startswith(ELSEWHERE)]


@pytest.mark.parametrize("name", NAMES)
def test_a_spoiled_file_is_read_or_refused(tmp_path: Path, name: str) -> None:
    cases = Cases(name, tmp_path)
    read = sum(cases.is_read(cases.put_down(number)) for number in range(SOME))
    assert 0 < read < SOME  # neither is every case refused at once, nor does every one stay whole
