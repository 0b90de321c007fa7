"""A full disk: every kind of result is whole or not there, and a command ends with one line."""

from __future__ import annotations

import resource
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from matplotlib.figure import Figure

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import SuiteError
from auv_sim.bags import metadata
from auv_sim.cli import plan as plan_command
from auv_sim.studies.campaign import store
from auv_sim.views.plot_style import save

LIMIT = 4096


@pytest.fixture
def full_disk() -> Iterator[None]:
    """No file can grow beyond some kB: writing fails in the middle, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def _picture(target: Path) -> None:
    figure = Figure()
    figure.add_subplot().plot(np.arange(9))
    save(figure, target)


def _table(target: Path) -> None:
    store._write_table(pa.table({"a": np.random.default_rng(0).random(10_000)}), target, 10_000)


WRITERS = {
    "text": lambda target: write_text(target, "x" * 10_000),
    "YAML": lambda target: yaml_file.dump(["x" * 10_000], target),
    "picture": _picture,
    "table": _table,
    "metadata": lambda target: metadata.write(target.parent, {"x": "x" * 10_000}),
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_full_disk_costs_one_line_and_leaves_what_was_there(tmp_path, full_disk, name):
    folder = tmp_path / "results"
    folder.mkdir()
    target = folder / ("metadata.yaml" if name == "metadata" else "result.png")
    target.write_text("old")
    with pytest.raises(SuiteError) as caught:
        WRITERS[name](target)
    assert str(caught.value) == f"{target} cannot be written (File too large)"
    assert [(path.name, path.read_text()) for path in folder.iterdir()] == [(target.name, "old")]


def test_a_command_ends_with_that_line(tmp_path, full_disk, capsys):
    assert plan_command.main(["loiter", "--quiet", "--out", str(tmp_path / "plan.png")]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "plan.png (File too large), expected a picture that can be written" in said
    assert list(tmp_path.iterdir()) == []
