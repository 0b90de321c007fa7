"""Every reader of files from outside, each with whole files to be spoiled and a way to read one."""

from __future__ import annotations

import contextlib
import functools
import io
import random
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import SuiteError
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_sim.cli import bag as bag_command
from auv_sim.cli import plan as plan_command
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.vehicle import sea
from mutation import seeds, waypoint_seeds
from mutation.mutate import mutate


class Wrong(AssertionError):
    """A reader that ended otherwise than documented."""


class Reader(NamedTuple):
    """One reader.

    Attributes:
        file: where the spoiled file goes in the case's directory.
        seeds: makes whole files, in an empty directory.
        read: reads the spoiled file; a `SuiteError` is a refusal.
        around: puts down what belongs beside it, from the directory in which the seeds were made.
        is_text: whether values in it are exchanged, too.
    """

    file: str
    seeds: Callable[[Path], Sequence[bytes]]
    read: Callable[[Path], object]
    around: Callable[[Path, Path], object] = lambda made, directory: None
    is_text: bool = True


class Cases:
    """The cases of one reader, numbered: case k is always the same file.

    Args:
        name: of the reader.
        scratch: a directory for its files.
    """

    def __init__(self, name: str, scratch: Path) -> None:
        self._name = name
        self._reader = READERS[name]
        self._made, self._directory = scratch / "made", scratch / "case"
        self._made.mkdir()
        self._seeds = self._reader.seeds(self._made)

    def put_down(self, number: int) -> Path:
        """Put down a case; returns the spoiled file."""
        dice = random.Random(f"{self._name}/{number}")
        shutil.rmtree(self._directory, ignore_errors=True)
        self._directory.mkdir()
        self._reader.around(self._made, self._directory)
        file = self._directory / self._reader.file
        one, other = dice.choice(self._seeds), dice.choice(self._seeds)
        file.write_bytes(mutate(one, other, dice, self._reader.is_text))
        return file

    def is_read(self, file: Path) -> bool:
        """Read the file; False when it is refused as documented.

        Raises:
            Exception: anything else is a fault.
        """
        try:
            self._reader.read(file)
        except SuiteError as refusal:
            if not str(refusal).isprintable():
                raise Wrong(f"a refusal that is not one line for a terminal: {str(refusal)!r}") from None
            return False
        return True


def _run(main: Callable[[Sequence[str]], int], *arguments: str) -> None:
    """Run a command; its refusal has to be one line that a terminal may show."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(arguments)
    shown = (out.getvalue() + err.getvalue()).replace("\n", "")
    if not shown.isprintable():
        raise Wrong(f"characters that a terminal must not get: {shown[:2000]!r}")
    if code == 2:
        raise SuiteError(err.getvalue().strip())
    if code != 0:
        raise Wrong(f"exit code {code} with {err.getvalue()!r}")


def _plan(file: Path) -> None:
    _run(plan_command.main, str(file), "--quiet")


def _bag(file: Path) -> None:
    bag = str(file.parent)
    _run(bag_command.main, "inspect", bag)
    with contextlib.suppress(SuiteError):  # without odometry there is no table
        _run(bag_command.main, "export", bag, "--out", str(file.parent.parent / "t.csv"))
    _run(bag_command.main, "repair", bag, "--out", str(file.parent.parent / "whole"))


def _waypoints(suffix: str, is_text: bool = True) -> Reader:
    def around(_: Path, directory: Path) -> None:
        for use, keys in seeds.USES.items():
            text = seeds.AROUND + keys.format(suffix=suffix)
            (directory / f"{use}.yaml").write_text(text, encoding="utf-8")

    def read(file: Path) -> None:
        for use in ("survey", "geofence"):
            with contextlib.suppress(SuiteError):
                mission_file.load(str(file.with_name(f"{use}.yaml")))
        _plan(file.with_name("waypoints.yaml"))

    files = functools.partial(waypoint_seeds.files, suffix)
    return Reader(f"places.{suffix}", lambda made: files(), read, around, is_text)


def _recording(write: Callable[[Path], Path], spoiled: str, is_text: bool) -> Reader:
    def make(made: Path) -> list[bytes]:
        write(made / "bag")
        return [(made / "bag" / spoiled).read_bytes()]

    def around(made: Path, directory: Path) -> None:
        shutil.copytree(made / "bag", directory / "bag")

    return Reader(f"bag/{spoiled}", make, _bag, around, is_text)


def _beside_missions(_: Path, directory: Path) -> None:
    shutil.copy(config_files.shipped("missions")["course_linear"].with_name("course.csv"), directory)


def _yaml(kind: str, read: Callable[[Path], object]) -> Reader:
    return Reader("file.yaml", lambda made: seeds.shipped(kind), read)  # type: ignore[arg-type]


_MCAP = functools.partial(seeds.mcap, compression="none")
_PACKED = functools.partial(seeds.mcap, compression="zstd")
#: Every reader by the name of what it reads.
READERS = {
    "mission": Reader("m.yaml", lambda made: seeds.missions(), _plan, _beside_missions),
    # `mission` stands for a mission file here, not for QGroundControl's old format of that suffix.
    **{suffix: _waypoints(suffix) for suffix in waypoint_seeds.TEXTS if suffix != "mission"},
    "qgc_mission": _waypoints("mission"),
    "kmz": _waypoints("kmz", is_text=False),
    "vehicle": _yaml("vehicles", lambda file: vehicle.load(str(file))),
    "params": _yaml("params", lambda file: params_file.load(file, SUITE)),
    "sea": _yaml("seas", lambda file: sea.load(str(file))),
    "study": _yaml("studies", lambda file: StudyPlan(file).scenario(0)),
    "mcap": _recording(_MCAP, "bag_0.mcap", is_text=False),
    "mcap_zstd": _recording(_PACKED, "bag_0.mcap", is_text=False),
    "sqlite": _recording(seeds.sqlite, "bag.db3", is_text=False),
    "sqlite_packed": _recording(seeds.packed, "bag.db3.zstd", is_text=False),
    "sqlite_wal": _recording(seeds.unmerged, "whole.db3-wal", is_text=False),
    "ros1": _recording(seeds.ros1, "bag.bag", is_text=False),
    "metadata": _recording(_MCAP, "metadata.yaml", is_text=True),
    "metadata_sqlite": _recording(seeds.sqlite, "metadata.yaml", is_text=True),
}
