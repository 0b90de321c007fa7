"""Spoiled waypoint files are read or refused in one line, never anything else.

`python3 -m mutation --help`, in the folder `test`, spoils many more of them, through the commands.
"""

from __future__ import annotations

import random
import time
from typing import get_args

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import waypoint_files
from auv_path_following.missions.waypoint_files import Use
from mutation import waypoint_seeds
from mutation.mutate import mutate

CASES = 120


@pytest.mark.parametrize("suffix", [*waypoint_seeds.TEXTS, "kmz"])
def test_a_spoiled_file_is_read_or_refused(tmp_path, suffix):
    dice, file, read = random.Random(suffix), tmp_path / f"a.{suffix}", 0
    whole = waypoint_seeds.files(suffix)
    for _ in range(CASES):
        file.write_bytes(mutate(dice.choice(whole), dice.choice(whole), dice, suffix != "kmz"))
        began = time.process_time()
        for use in get_args(Use):
            try:
                taken = waypoint_files.choose(waypoint_files.read(file), use)
                assert all(isinstance(value, float) for point in taken.points for value in point)
                read += 1
            except ConfigurationError as refusal:
                assert str(refusal).isprintable()
        assert time.process_time() - began < 5.0
    assert CASES // 10 < read < 3 * CASES


@pytest.mark.parametrize("suffix", [*waypoint_seeds.TEXTS, "kmz"])
def test_a_whole_file_is_read(tmp_path, suffix):
    for whole in waypoint_seeds.files(suffix):
        (tmp_path / f"a.{suffix}").write_bytes(whole)
        content = waypoint_files.read(tmp_path / f"a.{suffix}")
        assert content.shapes or content.fences
