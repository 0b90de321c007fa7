"""From scenarios of `closed_loop` to rows of numbers of the batch engine."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.spatial.flown_path import check_range
from auv_sim.flight.batch.compiled_flight import Course, FlightConfig
from auv_sim.flight.batch.config_rows import flat, layout_of
from auv_sim.flight.batch.distance import outlines_of, rows_of
from auv_sim.flight.batch.kinds.nearest import spatial_arrays_of, spatial_outlines_of
from auv_sim.flight.batch.tally import calm_time
from auv_sim.flight.loops import check_kind, followed_path, pilot_of
from auv_sim.flight.path_cells import cells_of
from auv_sim.flight.scenario import Scenario, spatial_start_of, start_of
from auv_sim.vehicle.fins.actuator import ring_size, servo_of
from auv_sim.vehicle.hulls.spatial_plant import spatial_plant_of
from auv_sim.vehicle.remus import plant_of


def flight_of(scenario: Scenario) -> FlightConfig:
    """Return the configuration of a flight, without its path, its start and its current.

    Raises:
        ConfigurationError: no hull, no thrust, or a law or a gain needs a key that the vehicle's file lacks.
    """
    if not scenario.thrust > 0.0:
        raise ConfigurationError("thrust", f"{scenario.thrust:g}", "a number greater than 0")
    scenario, dives = scenario.in_newtons, scenario.vehicle.dives
    return FlightConfig(
        pilot=pilot_of(scenario),
        plant=(spatial_plant_of if dives else plant_of)(scenario.plant_vehicle),
        dt=scenario.dt,
        steps=int(scenario.time_limit / scenario.step) + 1,
        calm=calm_time(scenario.vehicle),
    )


def start_row(scenario: Scenario, path: CompositePath | SpatialPath) -> list[float]:
    """Return the first state of a scenario's hull, which begins on its path by default."""
    start: Any = scenario.initial
    if start is None:
        start = spatial_start_of(path, scenario.vehicle) if isinstance(path, SpatialPath) else start_of(path)
    return [float(number) for number in start]


def current_row(scenario: Scenario) -> list[float]:
    """Return the constant current of a scenario: two components, or three for a vehicle that dives."""
    size = 3 if scenario.vehicle.dives else 2
    return [*map(float, scenario.current), 0.0][:size]


def rings_of(scenario: Scenario) -> int:
    """Return how many numbers the largest ring of a vehicle's servos holds."""
    fins = scenario.plant_vehicle.rudder, scenario.plant_vehicle.sternplanes
    return max(ring_size(servo_of(fin)) for fin in fins if fin is not None)


class Courses:
    """The courses of many scenarios; scenarios with one path share one."""

    def __init__(self) -> None:
        self._known: dict[tuple[int, float], tuple[Course, CompositePath | SpatialPath, Any]] = {}

    def of(self, scenario: Scenario) -> tuple[Course, CompositePath | SpatialPath]:
        """Return a scenario's course, and the path that it was made of.

        Raises:
            ConfigurationError: a vehicle in the plane and a path with depths; a path outside of the range of
                depths of its vehicle, or a thrust too low for it.
        """
        c = scenario
        # A vehicle that dives follows a planar path at its surface depth.
        surface = c.vehicle.depth.surface if c.vehicle.dives and c.spatial is None else -1.0
        key = id(c.path if c.spatial is None else c.spatial), surface
        known = self._known.get(key)
        if known is None:
            path = followed_path(c)
            # The scenario's path is kept, because another one at its address would have its key.
            known = self._known[key] = course_of(path), path, c
        course, path, _ = known
        if isinstance(path, SpatialPath):
            check_kind(c)
            check_range(path, c.vehicle, c.thrust)
        return course, path


def course_of(path: CompositePath | SpatialPath) -> Course:
    """Return a path as compiled code reads it."""
    if isinstance(path, SpatialPath):
        return Course(spatial_arrays_of(path), spatial_outlines_of(path), cells_of(path))
    return Course(rows_of(path), outlines_of(path), cells_of(path))


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
        settings = (
            c.vehicle,
            c.controller_vehicle,
            c.guidance,
            c.observer,
            c.autopilot,
            c.pitch,
            c.mode,
            c.sea,
            c.peer,
        )
        key = (*map(id, settings), c.thrust, c.step, c.command_delay, c.time_limit)
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
