"""From a study's files to the scenario of any of its runs: the same one on every machine and at any time."""

from __future__ import annotations

import functools
import itertools
import math
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, user_files, yaml_file
from auv_msgs_py.settings.schema import validated
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch.scenarios import flight_of
from auv_sim.flight.closed_loop import Scenario
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.campaign import targets
from auv_sim.studies.campaign.distributions import Value
from auv_sim.studies.campaign.study_file import load_study
from auv_sim.studies.settings_changes import changed, multiplied
from auv_sim.vehicle import sea
from auv_sim.vehicle.sea import Sea

#: Beside a bundled study: kind -> name in the study -> file.
BUNDLED = "files.json"


class StudyPlan:
    """A study with all its files read and every name checked.

    A run's values depend on the study's seed, the name of the parameter and the number of the run only. With
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
        bundled = source.parent / BUNDLED
        self._bundled: dict[str, dict[str, str]] = (
            validated(dict[str, dict[str, str]], yaml_file.parse(bundled), str(bundled))
            if bundled.is_file()
            else {}
        )
        self.study, self.notices = load_study(source)
        study = self.study
        self.grids = [name for name, distribution in study.vary.items() if distribution.grid is not None]
        self.points: list[tuple[Value, ...]] = list(
            itertools.product(*[study.vary[name].grid or () for name in self.grids])
        )
        self.runs = study.runs * len(self.points)
        self.sea: Sea | None = sea.load(self.file("seas", study.sea)) if study.sea else None
        self._check()

    def file(self, kind: config_files.Kind, name: str) -> str:
        """A file that the study names: as it was bundled, beside the study, from here, or a shipped one."""
        if name in self._bundled.get(kind, {}):
            return str(self.source.parent / self._bundled[kind][name])
        beside = self.source.parent / user_files.from_home(name)
        try:
            return str(beside if user_files.is_file(beside) else config_files.find(kind, name))
        except ConfigurationError as error:
            raise ConfigurationError(f"{self.where}: {error.where}", error.found, error.expected) from None

    def files(self) -> Iterator[tuple[config_files.Kind, str, tuple[Path, ...]]]:
        """Every file that the study names: its kind, its name there, itself and what belongs to it."""
        study = self.study
        for name in self.words("mission"):
            mission = self.mission_of({"mission": name})
            yield "missions", name, (mission.source, *mission.files)
        for name in self.words("params"):
            yield "params", name, (Path(self.file("params", name)),)
        for name in dict.fromkeys(filter(None, (*self.words("vehicle"), study.controller_model))):
            yield "vehicles", name, (Path(self.file("vehicles", name)),)
        if study.sea:
            yield "seas", study.sea, (Path(self.file("seas", study.sea)),)

    def words(self, name: str) -> tuple[str, ...]:
        """All files that the study names as mission, vehicle or params."""
        distribution = self.study.vary.get(name)
        if distribution is None:
            return (getattr(self.study, name),)
        return tuple(str(word) for word in distribution.listed or ())

    def mission_of(self, values: dict[str, Value]) -> Mission:
        """The mission that is flown with these values of the varied parameters."""
        name, hull = (str(values.get(word, getattr(self.study, word))) for word in ("mission", "vehicle"))
        return self.mission(name, self.study.controller_model or hull)

    @functools.cache  # noqa: B019 - a plan lives as long as its process
    def mission(self, name: str, hull: str) -> Mission:
        """A mission that the study names, with the thrust that a hull needs for its speed."""
        return mission_file.load(self.file("missions", name), self.hull(hull))

    @functools.cache  # noqa: B019
    def hull(self, name: str) -> Vehicle:
        """A vehicle that the study names."""
        return vehicle.load(self.file("vehicles", name))

    @functools.cache  # noqa: B019
    def parameters(self, name: str) -> dict[str, Any]:
        """Gains that the study names."""
        return params_file.load(Path(self.file("params", name)), SUITE)

    def values(self, run: int) -> dict[str, Value]:
        """What run number `run` (from 0) has of each varied parameter."""
        drawn = dict(zip(self.grids, self.points[run % len(self.points)], strict=True))
        turn = run // len(self.points)
        return {
            name: drawn[name] if name in drawn else distribution.draw(self._generator(turn, name))
            for name, distribution in self.study.vary.items()
        }

    def _generator(self, turn: int, name: str) -> np.random.Generator:
        return np.random.default_rng([self.study.seed, turn, zlib.crc32(name.encode())])

    def sea_seed(self, run: int) -> int:
        """The seed of everything that is random at sea in run number `run`."""
        return int(self._generator(run // len(self.points), "sea").integers(2**31))

    def scenario(self, run: int) -> Scenario:
        """What run number `run` (from 0) flies.

        Raises:
            ConfigurationError: values that do not go together.
        """
        where = f"{self.where}: run {run}"
        return self.scenario_of(self.values(run), where, self.sea_seed(run))

    def scenario_of(self, values: dict[str, Value], where: str, seed: int = 0) -> Scenario:
        """What is flown with these values of the varied parameters."""
        study = self.study
        mission = self.mission_of(values)
        hull = self.hull(str(values.get("vehicle", study.vehicle)))
        told = self.parameters(str(values.get("params", study.params)))
        configs: dict[str, Any] = {
            "vehicle": hull,
            "sea": self.sea,
            "guidance": told[topics.GUIDANCE].with_mission_overrides(mission).guidance,
            "observer": told[topics.OBSERVER].observer,
            "autopilot": told[topics.AUTOPILOT].autopilot,
        }
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
        for group, config in configs.items():
            if config is None and given[group]:
                raise ConfigurationError(
                    f"{self.where}: vary", f"{group}.*, and no {group}", f"{group}: FILE"
                )
            configs[group] = changed(config, given[group], f"{where}: {group}")
        return Scenario(
            path=mission.path,
            vehicle=configs["vehicle"],
            thrust=mission.thrust,
            initial=targets.start(mission.path, given["initial"]),
            current=targets.current(given["current"]),
            sea=configs["sea"],
            seed=seed,
            step=study.step,
            guidance=configs["guidance"],
            observer=configs["observer"],
            autopilot=configs["autopilot"],
            controller_vehicle=self.hull(study.controller_model) if study.controller_model else hull,
            time_limit=study.time_limit,
        )

    def _check(self) -> None:
        """Every name, and every value at its ends, before anything is flown."""
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
