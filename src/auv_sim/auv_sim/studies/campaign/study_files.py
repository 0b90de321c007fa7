"""The files that a study names: where they are, and what is read from them."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from auv_msgs_py.settings import params_file, user_files, yaml_file
from auv_msgs_py.settings.schema import validated
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.campaign.distributions import Value
from auv_sim.studies.campaign.study_file import Study

#: Beside a bundled study: kind -> name in the study -> file.
BUNDLED = "files.json"


class StudyFiles:
    """The files of one study, each read once.

    Args:
        source: the study file.
        study: its contents.

    Raises:
        ConfigurationError: the list of bundled files cannot be used.
    """

    def __init__(self, source: Path, study: Study) -> None:
        self._folder, self._where, self._study = source.parent, str(source), study
        bundled = source.parent / BUNDLED
        self._bundled: dict[str, dict[str, str]] = (
            validated(dict[str, dict[str, str]], yaml_file.parse(bundled), str(bundled))
            if bundled.is_file()
            else {}
        )

    def file(self, kind: config_files.Kind, name: str) -> str:
        """Return a file that the study names: bundled, beside the study, from here, or a shipped one."""
        if name in self._bundled.get(kind, {}):
            return str(self._folder / self._bundled[kind][name])
        beside = self._folder / user_files.from_home(name)
        try:
            return str(beside if user_files.is_file(beside) else config_files.find(kind, name))
        except ConfigurationError as error:
            raise ConfigurationError(f"{self._where}: {error.where}", error.found, error.expected) from None

    def named(self) -> Iterator[tuple[config_files.Kind, str, tuple[Path, ...]]]:
        """Yield every file that the study names: its kind, its name there, itself and what belongs to it."""
        study = self._study
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
        """Return all files that the study names as mission, vehicle or params."""
        distribution = self._study.vary.get(name)
        if distribution is None:
            return (getattr(self._study, name),)
        return tuple(str(word) for word in distribution.listed or ())

    def mission_of(self, values: dict[str, Value]) -> Mission:
        """Return the mission that is flown with these values of the varied parameters."""
        name, hull = (str(values.get(word, getattr(self._study, word))) for word in ("mission", "vehicle"))
        return self.mission(name, self._study.controller_model or hull)

    @functools.cache  # noqa: B019 - a study lives as long as its process
    def mission(self, name: str, hull: str) -> Mission:
        """Return a mission that the study names, with the thrust that a hull needs for its speed."""
        return mission_file.load(self.file("missions", name), self.hull(hull))

    @functools.cache  # noqa: B019
    def hull(self, name: str) -> Vehicle:
        """Return a vehicle that the study names."""
        return vehicle.load(self.file("vehicles", name))

    @functools.cache  # noqa: B019
    def parameters(self, name: str) -> dict[str, Any]:
        """Return gains that the study names."""
        return params_file.load(Path(self.file("params", name)), SUITE)
