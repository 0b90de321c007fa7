"""The plan of a fleet: the plan of each vehicle's mission, and the fleet's clock."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.settings import params_file, result_files, yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.texts import label_of
from auv_sim.launch import mission_plan, node_settings
from auv_sim.launch.fleet import fleet_file
from auv_sim.launch.fleet.fleet_file import Fleet
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options
from auv_sim.sim_parameters import FleetClockParameters

#: Name of the one bag below the run directory, where there is one for all.
BAG = "bag"


@dataclass(frozen=True)
class FleetPlan:
    """Several missions in one graph, resolved.

    Attributes:
        source, fleet: the file and its content.
        directory: the run directory.
        members: vehicle's directory name below it -> its plan.
        clock: settings of the node that publishes /clock.
    """

    source: Path
    fleet: Fleet
    directory: Path
    members: dict[str, Plan]
    clock: FleetClockParameters

    @property
    def lockstep(self) -> bool:
        """Whether each simulator waits for its nodes."""
        return self.clock.lockstep

    @property
    def one_bag(self) -> Path | None:
        """The bag of all vehicles; None where each has its own."""
        return self.directory / BAG if self.fleet.bags == "one" else None

    @property
    def has_console(self) -> bool:
        """Whether operators start the missions in the console, and the nodes stay after their ends."""
        return any(plan.options.console for plan in self.members.values())

    def claims(self) -> dict[str, Claim]:
        """Return what each vehicle claims in the graph; the first one claims /clock for the fleet."""
        claims = {
            label: dataclasses.replace(plan.claim(), clock=False) for label, plan in self.members.items()
        }
        first = next(iter(claims))
        return claims | {first: dataclasses.replace(claims[first], clock=True)}

    def write(self) -> dict[str, Path]:
        """Write the resolved configuration; return the parameter file of each vehicle and of the clock.

        Raises:
            NotWritten: a file cannot be written.
        """
        folder = self.directory / "config"
        folder.mkdir(parents=True)
        result_files.copy(self.source, folder / "fleet.yaml")
        files = {label: plan.write(self.directory / label / "config") for label, plan in self.members.items()}
        files[topics.FLEET_CLOCK] = folder / "params.yaml"
        yaml_file.dump(params_file.as_ros({topics.FLEET_CLOCK: self.clock}), folder / "params.yaml")
        return files


def make(name: str, common: Options, directory: Path) -> FleetPlan:
    """Read and check all files of a fleet.

    Args:
        name: fleet file, or the name of a shipped one.
        common: the command line.
        directory: the run directory.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    source, fleet = fleet_file.load(name)
    members = {}
    vehicles = " ".join(vehicle.namespace for vehicle in fleet.vehicles)
    for (place, vehicle), options in zip(
        fleet_file.places(source, fleet), fleet_file.options_of(source, fleet, common), strict=True
    ):
        label = label_of(vehicle.namespace)
        try:
            plan = mission_plan.make(options, directory / label)
            if not plan.vehicle.dives:
                plan.mission.require_planar()
        except ConfigurationError as error:
            where = f"{place}: {error.where.removeprefix('--')}"
            raise ConfigurationError(where, error.found, error.expected) from None
        node_settings.change(plan.parameters, topics.PLANT, shared_clock=True)
        node_settings.change(plan.parameters, topics.RECORDER, shared_clock=True, vehicles=vehicles)
        if fleet.bags == "one":
            node_settings.change(plan.parameters, topics.PLANT, recorded_vehicles=len(fleet.vehicles))
            node_settings.change(plan.parameters, topics.RECORDER, directory=str(directory / BAG))
        members[label] = plan
    steps = [plan.parameters[topics.PLANT].step for plan in members.values()]
    lockstep = common.speed is None
    clock = FleetClockParameters(
        lockstep=lockstep,
        vehicles=vehicles,
        step=min(steps),
        speed=common.speed or 1.0,
    )
    return FleetPlan(source, fleet, directory, members, clock)
