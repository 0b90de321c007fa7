"""Makes the scenario of any run from a study's files, the same on every machine and at any time."""

from __future__ import annotations

import dataclasses
import itertools
import math
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch.scenarios import flight_of
from auv_sim.flight.loops import followed_path
from auv_sim.flight.scenario import Scenario
from auv_sim.studies.campaign import targets
from auv_sim.studies.campaign.distributions import Value
from auv_sim.studies.campaign.study_file import figures_of, load_study
from auv_sim.studies.campaign.study_files import StudyFiles
from auv_sim.studies.settings_changes import changed, multiplied
from auv_sim.vehicle import sea
from auv_sim.vehicle.sea import Sea


class StudyPlan:
    """A study with all its files read and every name checked.

    A run's values depend only on the study's seed, the name of the parameter and the number of the run. With
    grids run k is point ``k % points``, and all points of one round share what is drawn: their differences
    are the grid's own.

    Args:
        source: the study file.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """

    def __init__(self, source: Path) -> None:
        self.source = source
        self.where = str(source)
        self.study, self.notices = load_study(source)
        study = self.study
        self.files = StudyFiles(source, study)
        self.grids = [name for name, distribution in study.vary.items() if distribution.grid is not None]
        self.points: list[tuple[Value, ...]] = list(
            itertools.product(*[study.vary[name].grid or () for name in self.grids])
        )
        self.runs = study.runs * len(self.points)
        self.sea: Sea | None = sea.load(self.files.file("seas", study.sea)) if study.sea else None
        #: Whether a vehicle of the study dives: its table then has the figures of `SpatialFlights`.
        self.dives = any(self.files.hull(name).dives for name in self.files.words("vehicle"))
        self._check()

    def values(self, run: int) -> dict[str, Value]:
        """Return the value of each varied parameter in run number `run` (from 0)."""
        drawn = dict(zip(self.grids, self.points[run % len(self.points)], strict=True))
        turn = run // len(self.points)
        return {
            name: drawn[name] if name in drawn else distribution.draw(self._generator(turn, name))
            for name, distribution in self.study.vary.items()
        }

    def _generator(self, turn: int, name: str) -> np.random.Generator:
        return np.random.default_rng([self.study.seed, turn, zlib.crc32(name.encode())])

    def sea_seed(self, run: int) -> int:
        """Return the seed of everything that is random at sea in run number `run` (from 0)."""
        return int(self._generator(run // len(self.points), "sea").integers(2**31))

    def scenario(self, run: int) -> Scenario:
        """Return the scenario of run number `run` (from 0).

        Raises:
            ConfigurationError: values that do not go together.
        """
        where = f"{self.where}: run {run}"
        return self.scenario_of(self.values(run), where, self.sea_seed(run))

    def scenario_of(self, values: dict[str, Value], where: str, seed: int = 0) -> Scenario:
        """Return what is flown with these values of the varied parameters.

        Args:
            values: parameter -> value; what is missing is as in the files.
            where: what an error names as its place.
            seed: of everything that is random at sea.
        """
        study = self.study
        mission = self.files.mission_of(values)
        if mission.altitude is not None:
            found = "a mission at an altitude, in a campaign"
            expected = "depth, depth_profile or a planar mission: the figures are about the depth of the path"
            raise ConfigurationError(f"{mission.source}: altitude", found, expected)
        hull = self.files.hull(str(values.get("vehicle", study.vehicle)))
        configs = self._configs(values, mission, hull)
        given = self._by_group(values, configs)
        for group, config in configs.items():
            if config is None and given[group]:
                raise ConfigurationError(
                    f"{self.where}: vary", f"{group}.*, and no {group}", f"{group}: FILE"
                )
            configs[group] = changed(config, given[group], f"{where}: {group}")
        scenario = Scenario(
            path=mission.path,
            vehicle=configs["vehicle"],
            thrust=mission.thrust,
            sea=configs["sea"],
            seed=seed,
            step=study.step,
            guidance=configs["guidance"],
            observer=configs["observer"],
            autopilot=configs["autopilot"],
            pitch=configs["pitch"],
            controller_vehicle=self.files.hull(study.controller_model) if study.controller_model else hull,
            time_limit=study.time_limit,
            spatial=mission.spatial,
        )
        return self._begun(scenario, given, where)

    def _begun(self, scenario: Scenario, given: dict[str, dict[str, Any]], where: str) -> Scenario:
        """Return a scenario with its start and current; both are relative to the path that is followed."""
        initial, water = given["initial"], given["current"]
        path = followed_path(scenario)
        if isinstance(path, SpatialPath):
            start = targets.spatial_start(path, initial, scenario.vehicle.shallowest, where)
            current = targets.spatial_current(water)
            return dataclasses.replace(scenario, initial=start, current=current)
        for name in (*targets.DIVING_START, *targets.DIVING_CURRENT):
            if name in initial or name in water:
                group = "initial" if name in initial else "current"
                found = f"it with {scenario.vehicle.name}"
                raise ConfigurationError(f"{where}: {group}.{name}", found, "a vehicle with stern planes")
        return dataclasses.replace(
            scenario, initial=targets.start(path, initial), current=targets.current(water)
        )

    def _configs(self, values: dict[str, Value], mission: Mission, hull: Vehicle) -> dict[str, Any]:
        """Return the settings objects before anything is varied: group -> object."""
        parameters = self.files.parameters(str(values.get("params", self.study.params)))
        return {
            "vehicle": hull,
            "sea": self.sea,
            "guidance": parameters[topics.GUIDANCE].with_mission_overrides(mission).guidance,
            "observer": parameters[topics.OBSERVER].observer,
            "autopilot": parameters[topics.AUTOPILOT].autopilot,
            "pitch": parameters[topics.AUTOPILOT].pitch,
        }

    def _by_group(self, values: dict[str, Value], configs: dict[str, Any]) -> dict[str, dict[str, Any]]:
        """Return the values by group and name, with factors applied: group -> name -> value."""
        given: dict[str, dict[str, Any]] = {group: {} for group in ("initial", "current", *configs)}
        for name, value in values.items():
            group, rest = targets.group_of(name, self.where)
            if not rest:
                continue
            if self.study.vary[name].factor:
                if group not in configs:
                    raise ConfigurationError(f"{self.where}: vary.{name}", "factor", "a value of its own")
                value = multiplied(configs[group], rest, float(value), f"{self.where}: vary.{name}")
            given[group][rest] = value
        return given

    def _check(self) -> None:
        """Check every name, and every distribution at its ends, before anything is flown."""
        for figure in (*self.study.success, self.study.judge):
            if figure not in figures_of(self.dives):
                expected = "a figure of flights in the plane, or a vehicle with stern planes"
                raise ConfigurationError(
                    f"{self.where}: {figure}", "a figure of flights with depth", expected
                )
        for name, distribution in self.study.vary.items():
            targets.group_of(name, self.where)
            is_word = name in targets.WORDS
            if is_word and (
                distribution.listed is None or not all(isinstance(v, str) for v in distribution.listed)
            ):
                raise ConfigurationError(
                    f"{self.where}: vary.{name}", "no names", "choice or grid: [NAME, ...]"
                )
        first = {name: distribution.extremes[0] for name, distribution in self.study.vary.items()}
        nominal = {name: value for name, value in first.items() if name in targets.WORDS}
        for name, distribution in self.study.vary.items():
            for value in distribution.extremes:
                if isinstance(value, float) and not math.isfinite(value):
                    raise ConfigurationError(f"{self.where}: vary.{name}", f"{value}", "finite numbers")
                scenario = self.scenario_of(nominal | {name: value}, f"{self.where}: vary.{name}")
                flight_of(scenario)
        flight_of(self.scenario_of(nominal, self.where))
