"""The mission in a recording: its run, its path and its configuration, as far as they are recorded."""

from __future__ import annotations

import contextlib
import dataclasses
import math
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError, printable
from auv_path_following import config_files, vehicle
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.missions.orders.start_place import path_parameter_of
from auv_path_following.vehicle import Vehicle
from auv_sim.bags.content.mission_list import listed, missions_by_digest
from auv_sim.bags.reading.load import run_of
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.texts import texts_below
from auv_sim.flight.by_odometry import ByOdometry, by_odometry
from auv_sim.flight.figures.mission_summary import MissionSummary
from auv_sim.flight.metrics import summarise
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.sim_parameters import SUITE

#: Stamps that differ by less are one, s.
SAME_STAMP = 1e-6
#: The files that the launcher writes and the recorder keeps.
MISSION, VEHICLE, PARAMS = "mission.yaml", "vehicle.yaml", "params.yaml"
#: The hull as the nodes knew it; only there where it was not the vehicle's.
CONTROLLER_MODEL, FORMER_CONTROLLER_MODEL = "controller_model.yaml", "believed.yaml"


@dataclass
class RecordedMission:
    """The mission in a recording; None where it lacks something.

    Attributes:
        bag: the recording.
        run: the odometry's rows.
        mission, vehicle: of the flight.
        notes: reasons for what is missing, a line each.
        place: of the path at which the mission began, as an operator names it; empty: its start.
        parts: the missions that were flown, where there are several, each with its rows of the run; the
            figures are then those of the first.
        ended: state and reason that guidance reported last.
    """

    bag: Bag
    run: Run | None
    mission: Mission | None
    vehicle: Vehicle | None
    notes: list[str]
    place: str = ""
    parts: tuple[RecordedMission, ...] = ()
    ended: tuple[str, str] = ("", "")

    @property
    def missions(self) -> tuple[RecordedMission, ...]:
        """Each mission that was flown."""
        return self.parts or (self,)

    @property
    def spatial(self) -> SpatialPath | None:
        """The path in three dimensions, where a vehicle that dives flew and was recorded as one."""
        mission, hull = self.mission, self.vehicle
        if self.parts or mission is None or not isinstance(self.run, SpatialRun):
            return None
        if mission.spatial is not None or mission.altitude is not None or hull is None or not hull.dives:
            return mission.spatial
        # A recorded flight is judged even if the vehicle's file, as it is now, would refuse it.
        with contextlib.suppress(ConfigurationError):
            return flown_path(mission.path, None, hull, mission.thrust)
        return None

    @property
    def summary(self) -> MissionSummary | None:
        """The figures, where run and path are known."""
        if self.parts:
            return self.parts[0].summary
        if self.run is None or self.mission is None:
            return None
        path = self.spatial or self.mission.path
        begin = 0.0
        with contextlib.suppress(ConfigurationError):
            begin = path_parameter_of(self.place, path)
        return summarise(self.run, path, begin)

    @property
    def by_odometry(self) -> ByOdometry | None:
        """The distances by the vehicle's odometry, where the true ones are known, too."""
        if self.parts:
            return self.parts[0].by_odometry
        if self.run is None or self.mission is None:
            return None
        return by_odometry(self.run, self.mission.path)


def mission_in(bag: Bag, mission: str | None = None, namespace: str | None = None) -> RecordedMission:
    """Find the mission of a recording.

    Args:
        bag: the recording, with all messages of the contract's topics.
        mission: a mission file instead of the recorded one.
        namespace: of the vehicle.

    Raises:
        ConfigurationError: `mission` cannot be used, or there are several vehicles and no namespace.
    """
    notes: list[str] = []
    run = None
    try:
        odometry = bag.find(topics.ODOM.name, namespace)
        run = run_of(bag, namespace)
        if odometry is not None and odometry.name.rsplit("/", 1)[-1] != topics.ODOM.name:
            notes.append(f"odometry taken from {odometry.name}")
    except ConfigurationError as error:
        if "several topics" in error.found or error.where == "--odometry":
            raise
        notes.append(f"no mission figures: {_without_place(error, bag)}")
    flown = hull = model = None
    known: dict[str, Mission] = {}
    with configuration(bag) as directory:
        if (directory / VEHICLE).exists():
            with _noted(notes):
                hull = vehicle.load(str(directory / VEHICLE))
                model = vehicle.load(str(controller_model(directory)))
        if mission is not None:
            flown = mission_file.load(str(config_files.find("missions", mission)), model)
        elif (directory / MISSION).exists():
            with _noted(notes):
                flown = mission_file.load(str(directory / MISSION), model)
                known[flown.digest] = flown  # while its file is there
    if flown is None and run is not None:
        notes.append("no mission file in or beside the recording: name one with --mission for the figures")
    found = RecordedMission(bag, run, flown, hull, [printable(note) for note in notes])
    return found if mission is not None else _with_missions(found, known, model, namespace)


def _with_missions(
    flight: RecordedMission, known: dict[str, Mission], model: Vehicle | None, namespace: str | None
) -> RecordedMission:
    """Return a flight with the place where its mission began, or with its missions if there are several."""
    missions, run = listed(flight.bag, namespace), flight.run
    if run is None or not missions:
        return flight
    if len(missions) == 1:
        (one,) = missions
        return dataclasses.replace(flight, place=one.place, ended=(one.state, one.reason))
    known = known | missions_by_digest(flight.bag, namespace, model)
    parts = []
    ends = [*(one.begun for one in missions[1:]), math.inf]
    for one, end in zip(missions, ends, strict=True):
        rows = run.select((run.t > one.begun - SAME_STAMP) & (run.t < end - SAME_STAMP))
        mission, notes = known.get(one.digest), []
        if mission is None:
            notes.append(f"no figures of {printable(one.name)}: its file is not in the recording")
        parts.append(
            RecordedMission(
                flight.bag, _driven(rows), mission, flight.vehicle, notes, one.place,
                ended=(one.state, one.reason),
            )
        )  # fmt: skip
    notes = [*flight.notes, *(note for part in parts for note in part.notes)]
    return dataclasses.replace(flight, notes=notes, parts=tuple(parts))


def _driven(run: Run) -> Run:
    """Return the rows up to the one after the last with thrust: what follows is no part of a mission."""
    driven = np.flatnonzero(run.thrust_cmd > 0.0)
    return run.select(slice(0, int(driven[-1]) + 2)) if driven.size else run


def controller_model(directory: Path) -> Path:
    """Return the file of the hull that the nodes were configured with; it may be absent."""
    names = (CONTROLLER_MODEL, FORMER_CONTROLLER_MODEL, VEHICLE)
    return next((directory / name for name in names if (directory / name).exists()), directory / VEHICLE)


def texts_of(bag: Bag) -> dict[str, str]:
    """Return the flown configuration by file name: from the bag, else from beside it."""
    if bag.texts:
        return dict(sorted(bag.texts.items()))
    root = bag.path if bag.path.is_dir() else bag.path.parent
    return texts_below(root.parent / "config")


@contextlib.contextmanager
def configuration(bag: Bag) -> Iterator[Path]:
    """Provide a temporary directory with the configuration's files.

    Names in a recording are not trusted: one that leads out of the directory, or is invalid, is left out.
    """
    with tempfile.TemporaryDirectory(prefix="auv-bag-") as name:
        directory = Path(name).resolve()
        for file, text in texts_of(bag).items():
            with contextlib.suppress(OSError, ValueError):
                place = (directory / file).resolve()
                if place.is_relative_to(directory):
                    place.parent.mkdir(parents=True, exist_ok=True)
                    place.write_text(text, encoding="utf-8")
        yield directory


def lockstep_of(bag: Bag) -> bool | None:
    """Return whether the mission was flown in lockstep; None where that is not recorded."""
    with configuration(bag) as directory:
        if not (directory / PARAMS).exists():
            return None
        try:
            return bool(params_file.load(directory / PARAMS, SUITE)[topics.GUIDANCE].lockstep)
        except ConfigurationError:
            return None


@contextlib.contextmanager
def _noted(notes: list[str]) -> Iterator[None]:
    try:
        yield
    except ConfigurationError as error:
        notes.append(
            f"{Path(error.where.split(':')[0]).name}: found {error.found}, expected {error.expected}"
        )


def _without_place(error: ConfigurationError, bag: Bag) -> str:
    return str(error).removeprefix(f"{bag.path}: ")
