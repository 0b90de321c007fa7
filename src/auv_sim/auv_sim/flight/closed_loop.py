"""The whole suite in one loop without ROS: the reference for the graph, and the tool for fast studies.

The nodes run the same steps in the same order with the same times, so the two trajectories agree to
rounding. The graph only adds the conversions of the wire.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import starmap

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import heading_over_the_wire
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance import guide
from auv_path_following.guidance.approach import agility_of, empty_approach
from auv_path_following.guidance.guide import Measured
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.navigation import current_observer
from auv_path_following.navigation.current_observer import CurrentObserverConfig
from auv_path_following.pilot import Pilot, begun, pilot
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.run_record import Run
from auv_sim.flight.signals import TRUTH
from auv_sim.sim_parameters import CRUISE
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.simulated import SimulatedVehicle


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """The complete configuration of one flight.

    Attributes:
        path: what to follow.
        vehicle: the plant's hull.
        thrust: N, while the mission runs.
        initial: the plant's first state; the path's start at cruising speed if None.
        current: constant current, m/s, NED, added to the sea's own.
        sea: imperfections; None: an ideal sea.
        seed: of the sea's random numbers.
        step: time between odometries, s.
        guidance, observer, autopilot: laws and gains.
        controller_vehicle: the hull that guidance and autopilot assume; the plant's own if None.
        time_limit: latest end of the flight, s.
    """

    path: CompositePath
    vehicle: Vehicle
    thrust: float
    initial: PlantState | None = None
    current: Current = NO_CURRENT
    sea: Sea | None = None
    seed: int = 0
    step: float = 0.05
    guidance: PathFollowerConfig = field(default_factory=PathFollowerConfig)
    observer: CurrentObserverConfig = field(default_factory=CurrentObserverConfig)
    autopilot: AutopilotConfig = field(default_factory=AutopilotConfig)
    controller_vehicle: Vehicle | None = None
    time_limit: float = 3600.0

    @property
    def step_ns(self) -> int:
        """Step in whole ns, as stamps have it."""
        return round(self.step * 1e9)

    @property
    def dt(self) -> float:
        """Step as the difference of two stamps, s."""
        return self.step_ns * 1e-9


#: Columns of a step's row: navigation, water, command, guidance, estimated and true current.
_COLUMNS = (
    "x", "y", "psi", "r", "ur", "vr", "rudder_cmd", "thrust_cmd", "psi_d", "r_d", "xe", "ye", "psi_e", "s",
    "Vx_est", "Vy_est", "Vx_true", "Vy_true",
)  # fmt: skip


def start_of(path: CompositePath) -> PlantState:
    """Return the state on the path's first point, along its tangent, at cruising speed."""
    x, y, chi = path.start_pose
    return PlantState(x, y, chi, CRUISE, 0.0, 0.0)


def pilot_of(scenario: Scenario) -> Pilot:
    """Return the pilot of a scenario: no limits, no holds, and over the wire's last bits only at sea.

    Raises:
        ConfigurationError: a law or gain needs a key that the vehicle's file lacks.
    """
    c = scenario
    hull = c.controller_vehicle or c.vehicle
    guidance = guide.prepare(c.guidance, agility_of(hull, c.thrust), c.thrust)
    steering = autopilot.prepare(c.autopilot, hull)
    observer = current_observer.prepare(c.observer, c.dt)
    return Pilot(observer, guidance, steering, math.inf, c.sea is not None)


def fly(scenario: Scenario, progress: Callable[[float], None] | None = None) -> Run:
    """Fly until the end of the path or the time limit.

    Args:
        scenario: what to fly.
        progress: called with s every 20 steps.

    Returns:
        One row per step. A mission that was completed ends with the row at which it was.
    """
    c = scenario
    dt = c.dt
    vehicle = SimulatedVehicle(c.vehicle, c.initial or start_of(c.path), c.sea, c.seed, c.current, dt)
    config, path = pilot_of(c), c.path.rows
    state = begun(config, empty_approach())
    at_sea, seen = c.sea is not None, vehicle.seen
    rows: list[tuple[float, ...]] = []
    rudders: list[float] = []
    for k in range(int(c.time_limit / c.step) + 1):
        navigation, water, _, _, _, motion, rudder, current = seen
        if at_sea:
            navigation = navigation._replace(psi=heading_over_the_wire(navigation.psi))
        measured = Measured(navigation, water, True, False, 0.0, k * dt)
        state, (estimate, g, _, command) = pilot(config, path, state, measured, dt if k else 0.0)
        # g begins with psi_d, r_d, xe, ye, psi_e, s: see `GuidanceOutput`.
        row = navigation + water + command + g[:6] + estimate + current
        rows.append(row + motion[:3] if at_sea else row)
        rudders.append(rudder)
        if g.finished:
            break
        if progress is not None and k % 20 == 0:
            progress(g.s)
        seen = vehicle.advance(command, dt)
    names = (*_COLUMNS, *TRUTH) if at_sea else _COLUMNS
    stamps = topics.FIRST_STAMP_NS + c.step_ns * np.arange(len(rows))
    columns = dict(zip(names, _table(rows).T, strict=True))
    return Run.from_columns(columns | {"t": stamps * 1e-9, "rudder": rudders})


def _table(rows: list[tuple[float, ...]]) -> NDArray[np.float64]:
    """Return rows of equal length as an array, in a third of the time that `np.array` takes."""
    pack = struct.Struct(f"{len(rows[0])}d").pack
    return np.frombuffer(b"".join(starmap(pack, rows))).reshape(len(rows), -1)
