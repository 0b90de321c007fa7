"""From scenarios of `closed_loop` to rows of numbers of the batch engine."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.flight.batch.compiled_flight import FlightConfig
from auv_sim.flight.batch.config_rows import flat, layout_of
from auv_sim.flight.loops import pilot_of
from auv_sim.flight.scenario import Scenario
from auv_sim.vehicle.remus import plant_of


def flight_of(scenario: Scenario) -> FlightConfig:
    """Return the configuration of a flight, without its path, its start and its current.

    Raises:
        ConfigurationError: no hull, no thrust, or a path with depths.
    """
    if scenario.spatial is not None:
        expected = "a planar one: the compiled engine has no depth yet"
        raise ConfigurationError("mission", "a path with depths", expected)
    if not scenario.thrust > 0.0:
        raise ConfigurationError("thrust", f"{scenario.thrust:g}", "a number greater than 0")
    return FlightConfig(
        pilot=pilot_of(scenario),
        plant=plant_of(scenario.vehicle),
        dt=scenario.dt,
        steps=int(scenario.time_limit / scenario.step) + 1,
    )


class Preparation:
    """The configurations of many scenarios; scenarios that share all settings share one.

    Attributes:
        flights: all different ones.
    """

    def __init__(self) -> None:
        self.flights: list[FlightConfig] = []
        self._layouts: list[Any] = []
        self._known: dict[tuple[Any, ...], int] = {}

    def row_of(self, scenario: Scenario) -> tuple[int, Any]:
        """Return the place of a scenario's flight in `flights`, and its layout.

        Raises:
            ConfigurationError: as `flight_of`.
        """
        c = scenario
        settings = c.vehicle, c.controller_vehicle, c.guidance, c.observer, c.autopilot, c.sea
        key = (*map(id, settings), c.thrust, c.step, c.time_limit)
        row = self._known.get(key)
        if row is None:
            flight = flight_of(scenario)
            row = self._known[key] = len(self.flights)
            self.flights.append(flight)
            self._layouts.append(layout_of(flight))
        return row, self._layouts[row]

    def rows(self, places: list[int]) -> npt.NDArray[np.float64]:
        """Return the numbers of some flights of one layout, one row each."""
        return np.array([flat(self.flights[place]) for place in places])
