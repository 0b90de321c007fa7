"""One flight of the paper's path: what differs from the files, and its scenario."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.types import Current
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_path_following.vehicle import Vehicle
from auv_sim.flight import closed_loop
from auv_sim.flight.run_record import Run
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import CRUISE, SUITE
from auv_sim.studies.paper.variants import PLANTS
from auv_sim.studies.settings_changes import changed
from auv_sim.vehicle.remus import PlantState

MISSION = "paper_composite"


@dataclass(frozen=True, kw_only=True)
class PaperFlight:
    """One flight of the paper's path.

    Attributes:
        name: in files and claims.
        plant: of `PLANTS`.
        params: parameter file.
        controller: heading controller, None for the parameter file's.
        law: guidance law, None for the parameter file's.
        switching: joints with a circle of acceptance.
        current: m/s, NED.
        compensated: whether guidance uses the observer's estimate.
        start: x, y (m), heading (rad); the path's start if None.
        changes: further parameters, node -> dotted name -> value.
        time_limit: the flight ends here at the latest, s.
        step: time between two odometries, s.
    """

    name: str
    plant: str = "prestero"
    params: str = "paper"
    controller: str | None = None
    law: str | None = None
    switching: str = "g0"
    current: tuple[float, float] = (0.0, 0.0)
    compensated: bool = True
    start: tuple[float, float, float] | None = None
    changes: Mapping[str, Mapping[str, Any]] = dataclasses.field(default_factory=dict)
    time_limit: float = 1500.0
    step: float = 0.05

    def scenario(self) -> Scenario:
        """Return the scenario for `closed_loop.fly`.

        Raises:
            ConfigurationError: a file or a value that cannot be used.
        """
        mission = _mission()
        parameters = parameters_named(self.params)
        guidance = parameters[topics.GUIDANCE].guidance
        autopilot = parameters[topics.AUTOPILOT].autopilot
        switching = dataclasses.replace(guidance.switching, mode=self.switching)
        guidance = dataclasses.replace(guidance, switching=switching, compensate_current=self.compensated)
        # The paper's P waits at the path's start.
        guidance = changed(guidance, {"approach.enabled": False}, self.name)
        if self.law is not None:
            guidance = dataclasses.replace(guidance, law=self.law)
        if self.controller is not None:
            autopilot = dataclasses.replace(autopilot, controller=self.controller)
        guidance = changed(guidance, self.changes.get("guidance", {}), self.name)
        autopilot = changed(autopilot, self.changes.get("autopilot", {}), self.name)
        x, y, psi = self.start or mission.path.start_pose
        plant = PLANTS[self.plant]
        return Scenario(
            path=mission.path,
            vehicle=vehicle_named(plant.hull),
            thrust=mission.thrust,
            initial=PlantState(x, y, psi, CRUISE, 0.0, 0.0),
            current=Current(*self.current),
            step=self.step,
            guidance=guidance,
            observer=parameters[topics.OBSERVER].observer,
            autopilot=autopilot,
            controller_vehicle=vehicle_named(plant.controller_model),
            time_limit=self.time_limit,
        )


@functools.cache
def _mission() -> Any:
    return mission_file.load(MISSION)


@functools.cache
def parameters_named(name: str) -> dict[str, Any]:
    """Return the settings of a shipped parameter file: node name -> settings; read once."""
    return params_file.load(config_files.find("params", name), SUITE)


@functools.cache
def vehicle_named(name: str) -> Vehicle:
    """Return a shipped vehicle; read once."""
    return vehicle.load(name)


def fly(flight: PaperFlight) -> Run:
    """Fly in this process."""
    return closed_loop.fly(flight.scenario())
