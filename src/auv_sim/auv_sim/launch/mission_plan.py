"""The plan of a mission: its files read and checked, and the settings of every node, before any starts."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.settings import params_file, result_files, yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.guidance.spatial.spatial_follower import mode_of
from auv_path_following.mission_check.flyable import Findings, refusal
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.missions.orders.start_place import path_parameter_of
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.scenario import Scenario
from auv_sim.launch import node_settings
from auv_sim.launch.options import BY_RULE, DEFAULT_PARAMS, DRIVERS, Options
from auv_sim.launch.plan_checks import check_altimeter, check_flight, check_simulated
from auv_sim.launch.vehicle_driver import configure_driver
from auv_sim.vehicle import sea


@dataclass(frozen=True)
class Plan:
    """One mission, resolved.

    Attributes:
        options: the command line.
        mission, vehicle: as read from their files.
        parameters: node name -> settings object, for the nodes that are started.
        sources: kind of input ("mission", "vehicle", "params", "controller_model", "sea") -> its file.
        verdicts: the findings of the mission check.
        controller_model: the hull that the nodes assume.
        emulator: command line of the emulated vehicle, None without one.
        begin: s of Eq. (1) at which the mission begins.
    """

    options: Options
    mission: Mission
    vehicle: Vehicle
    parameters: dict[str, Any]
    sources: dict[str, Path]
    verdicts: Findings
    controller_model: Vehicle
    emulator: tuple[str, ...] | None = None
    begin: float = 0.0

    @property
    def path(self) -> CompositePath | SpatialPath:
        """The path by which the flight is judged: in three dimensions where the path has the depths.

        A flight at an altitude has the depths of the bottom, and is judged in the plane.
        """
        mission = self.mission
        if not self.vehicle.dives or mission.altitude is not None:
            return mission.path
        return flown_path(mission.path, mission.spatial, self.controller_model, mission.thrust)

    @property
    def lockstep(self) -> bool:
        """Whether the simulator waits for the nodes."""
        return self.options.simulator and self.options.speed is None

    @property
    def own_clock(self) -> bool:
        """Whether this mission publishes /clock."""
        return self.options.simulator or (self.options.emulator and self.options.speed is not None)

    @property
    def use_sim_time(self) -> bool:
        """Whether the nodes follow /clock."""
        return self.options.use_sim_time or self.own_clock

    def claim(self) -> Claim:
        """Return what the mission claims in the graph."""
        namespace = self.options.namespace
        vehicle = () if self.options.no_sim else (topics.PLANT, *DRIVERS.values())
        names = {*self.parameters, *vehicle, topics.LAUNCHER}
        holder = topics.full_name(namespace, topics.LAUNCHER)
        return Claim(holder=holder, namespace=namespace, names=tuple(sorted(names)), clock=self.own_clock)

    def scenario(self) -> Scenario:
        """Return the same flight for `closed_loop`.

        Raises:
            ValueError: there is no simulator in this plan.
            ConfigurationError: the mission begins elsewhere than at the start of its path.
        """
        if not self.options.simulator:
            raise ValueError("a mission without the simulator has no closed loop")
        plant, guidance = self.parameters[topics.PLANT], self.parameters[topics.GUIDANCE]
        if self.begin > 0.0:
            expected = "none: closed_loop flies a path from its start"
            raise ConfigurationError("--start-at", repr(guidance.start_at), expected)
        dives = self.vehicle.dives
        return Scenario(
            path=self.mission.path,
            vehicle=self.vehicle,
            thrust=self.mission.thrust,
            initial=plant.initial.spatial_state if dives else plant.initial.state,
            spatial=self.mission.spatial,
            current=plant.current.of(dives),
            sea=sea.load(plant.sea) if plant.sea else None,
            seed=plant.seed,
            step=plant.step,
            guidance=guidance.guidance,
            observer=self.parameters[topics.OBSERVER].observer,
            autopilot=self.parameters[topics.AUTOPILOT].autopilot,
            pitch=self.parameters[topics.AUTOPILOT].pitch,
            mode=mode_of(self.mission, guidance.guidance, guidance.limits, self.controller_model),
            controller_vehicle=self.controller_model,
        )

    def write(self, directory: Path) -> Path:
        """Write the resolved configuration, ready to be flown again.

        Returns:
            The parameter file for the nodes.

        Raises:
            NotWritten: a file cannot be written.
        """
        directory.mkdir(parents=True)
        here = {"mission": self.mission.copy_to(directory)}
        for kind in ("vehicle", "controller_model", "sea"):
            if kind in self.sources:
                here[kind] = directory / f"{kind}.yaml"
                result_files.copy(self.sources[kind], here[kind])
        written = {}
        for name, settings in self.parameters.items():
            changes = {kind: str(here[kind]) for kind in here if hasattr(settings, kind)}
            if "vehicle" in changes and "controller_model" in here and name != topics.PLANT:
                changes["vehicle"] = str(here["controller_model"])
            written[name] = dataclasses.replace(settings, **changes)
        target = directory / "params.yaml"
        yaml_file.dump(params_file.as_ros(written), target)
        return target


def make(options: Options, directory: Path) -> Plan:
    """Read and check all files, and set the parameters of every node.

    Args:
        options: the command line.
        directory: the run directory; the bag goes there.

    Raises:
        ConfigurationError: one line with the place, what was found and what was expected.
    """
    sources = _find_files(options)
    hull = model = vehicle.load(str(sources["vehicle"]))
    if "controller_model" in sources:
        model = vehicle.load(str(sources["controller_model"]))
    mission = mission_file.load(str(sources["mission"]), model)
    params = node_settings.params_of(options, model)
    by_rule = params == BY_RULE
    sources["params"] = config_files.find("params", DEFAULT_PARAMS if by_rule else params).absolute()
    check_simulated(options, hull, sources["vehicle"])
    notices: list[str] = []
    settings = node_settings.load(options, sources["params"], model, by_rule, notices)
    begin = _set_beginning(settings, options, mission, model, sources)
    node_settings.set_mission(settings, options, mission, sources, directory, hull, begin)
    mean = node_settings.set_options(settings, options, sources)
    check_altimeter(options, mission, settings)
    verdicts = check_flight(options, mission, hull, settings, mean)
    verdicts = dataclasses.replace(verdicts, notices=(*verdicts.notices, *notices))
    if verdicts.refusals and not options.force:
        raise refusal(mission, verdicts, "--force flies it all the same")
    emulator, driver = None, DRIVERS.get(options.vehicle_driver or "")
    if driver is not None:
        file = str(sources["vehicle"])
        address, speed = options.vehicle_address, options.speed
        emulator = configure_driver(driver, address, speed, file, hull.dives, settings)
    for name in {topics.PLANT, *DRIVERS.values()} - {topics.PLANT if options.simulator else driver}:
        del settings[name]
    if not options.display:
        del settings[topics.DISPLAY]
    return Plan(options, mission, hull, settings, sources, verdicts, model, emulator, begin)


def scenario(options: Options) -> Scenario:
    """Return the flight that the launcher would fly, for `closed_loop.fly`; write nothing.

    Args:
        options: as for the launcher, with its defaults.

    Raises:
        ConfigurationError: one line with the place, what was found and what was expected.
    """
    return make(options, Path("runs")).scenario()


def _find_files(options: Options) -> node_settings.Sources:
    """Return the input files by kind.

    Raises:
        ConfigurationError: there is no such file.
    """
    sources = {
        "mission": config_files.find("missions", options.mission).absolute(),
        "vehicle": config_files.find("vehicles", options.vehicle).absolute(),
    }
    if options.controller_model is not None:
        sources["controller_model"] = config_files.find("vehicles", options.controller_model).absolute()
    return sources


def _set_beginning(
    settings: node_settings.NodeSettings, options: Options, mission: Mission, model: Vehicle,
    sources: node_settings.Sources,
) -> float:  # fmt: skip
    """Set where the mission begins; return its s of Eq. (1).

    Raises:
        ConfigurationError: it is no place of the path.
    """
    where = "--start-at"
    if options.start_at is None:
        where = f"{sources['params']}: {topics.GUIDANCE}: start_at"
    else:
        node_settings.change(settings, topics.GUIDANCE, start_at=options.start_at)
    path: CompositePath | SpatialPath = mission.spatial or mission.path
    if model.dives:
        path = flown_path(mission.path, mission.spatial, model, mission.thrust)
    try:
        return path_parameter_of(settings[topics.GUIDANCE].start_at, path)
    except ConfigurationError as error:
        raise ConfigurationError(where, error.found, error.expected) from None
