"""The study file: its flights, what is varied, and what counts as a success."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Annotated, Literal

import pydantic

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import no_boolean, unfit
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.flight.batch.flight_figures import Flights, SpatialFlights
from auv_sim.flight.least_share import LEAST_SHARE
from auv_sim.studies.campaign.distributions import Distribution

_Version = Annotated[Literal[1], pydantic.BeforeValidator(no_boolean)]


def figures_of(dives: bool) -> tuple[str, ...]:
    """Return the figures of a flight that are one number; with those in depth if its vehicle dives."""
    return tuple(
        field.name
        for field in dataclasses.fields(SpatialFlights if dives else Flights)
        if not field.name.startswith("subpath_") and field.name not in ("completed", "finite")
    )


#: All figures of a flight that are one number.
FIGURES = figures_of(True)
#: Keys that have been renamed: former name -> present name.
_RENAMED = {"believed": "controller_model"}
_MOST_RUNS = 10_000_000
_MOST_POINTS = 1_000_000


@settings
class Study:
    """A whole study file. A flight that flies the path to its end is a success if it keeps the limits."""

    version: _Version = setting(doc="version of this format")
    name: str = setting(doc="what people call it")
    description: str = setting("", "more for people")
    seed: int = setting(0, "of all that is drawn", ge=0)
    runs: int = setting(1, "how many flights; with grids, for each point of them", ge=1, le=_MOST_RUNS)
    mission: str = setting("paper_composite", "mission file, or the name of a shipped one")
    vehicle: str = setting("remus100", "the hull that is flown: a file, or the name of a shipped one")
    controller_model: str = setting("", "the autopilot's model of the hull; empty: that of `vehicle`")
    params: str = setting("robust", "gains: parameter file, or the name of a shipped one")
    sea: str = setting("", "sea file, or the name of a shipped one; empty: ideal")
    step: float = setting(0.05, "time between two odometries", unit="s", ge=0.001, le=1.0)
    time_limit: float = setting(1500.0, "a flight ends here at the latest", unit="s", gt=0.0, le=1e6)
    vary: dict[str, Distribution] = setting(factory=dict, doc="parameter -> its distribution or grid")
    success: dict[str, float] = setting(
        factory=dict, doc="figure -> the most that it may be in a successful flight"
    )
    flown: float = setting(
        LEAST_SHARE, "least share of the path that a successful flight flies", ge=0.0, le=1.0
    )
    judge: str = setting("rms_distance", "the figure that sensitivities and pictures are about")
    axes: tuple[str, ...] = setting((), "one or two varied parameters: success is drawn over these")

    @pydantic.model_validator(mode="after")
    def _fits(self) -> Study:
        for figure in (*self.success, self.judge):
            if figure not in FIGURES:
                raise unfit(f"the figure {figure!r}", f"one of {', '.join(FIGURES)}")
        for axis in self.axes:
            if axis not in self.vary or not self.vary[axis].is_numeric:
                raise unfit(f"the axis {axis!r}", "parameters under vary whose values are numbers")
        if len(self.axes) > 2:
            raise unfit(f"{len(self.axes)} axes", "one or two")
        cells = 1
        for distribution in self.vary.values():
            cells *= len(distribution.grid or (None,))
        if cells > _MOST_POINTS:
            raise unfit(f"{cells} points of the grids", f"at most {_MOST_POINTS}")
        if cells * self.runs > _MOST_RUNS:
            raise unfit(f"{cells * self.runs} flights", f"at most {_MOST_RUNS}")
        return self


def load_study(source: Path) -> tuple[Study, tuple[str, ...]]:
    """Read a study file; keys under a former name are accepted.

    Returns:
        The study, and a notice for each key that has been renamed.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    data = yaml_file.parse(source)
    notices = []
    for former, present in _RENAMED.items():
        if isinstance(data, dict) and former in data:
            if present in data:
                raise ConfigurationError(str(source), f"{former} and {present}", f"{present} alone")
            data[present] = data.pop(former)
            notices.append(f"{source}: {former} is now {present}")
    return yaml_file.checked(data, source, Study), tuple(notices)
