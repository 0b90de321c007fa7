"""From what a person asked for to what every node is told: checked before anything is started."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.settings import params_file, result_files, yaml_file
from auv_msgs_py.settings.schema import Pair
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following import config_files, vehicle
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.parameters import AutopilotParameters
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.mission_check.flyable import Findings, check, refusal
from auv_sim.flight.closed_loop import Scenario
from auv_sim.launch.options import DRIVERS, Options
from auv_sim.launch.vehicle_driver import configure_driver
from auv_sim.sim_parameters import SUITE
from auv_sim.vehicle import sea


@dataclass(frozen=True)
class Plan:
    """One mission, resolved.

    Attributes:
        options: what was asked for.
        mission, vehicle: as read from their files.
        parameters: node name -> settings object, for the nodes that are started.
        sources: what each input was read from: "mission", "vehicle", "params", with a sea "sea" -> path.
        verdicts: what was found when the mission was checked.
        emulator: command line of the emulated vehicle, None without one.
    """

    options: Options
    mission: Mission
    vehicle: Vehicle
    parameters: dict[str, Any]
    sources: dict[str, Path]
    verdicts: Findings
    controller_model: Vehicle
    emulator: tuple[str, ...] | None = None

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
        """What the mission takes for itself in the graph."""
        namespace = self.options.namespace
        vehicle = () if self.options.no_sim else (topics.PLANT, *DRIVERS.values())
        names = {*self.parameters, *vehicle, topics.LAUNCHER}
        holder = topics.full_name(namespace, topics.LAUNCHER)
        return Claim(holder=holder, namespace=namespace, names=tuple(sorted(names)), clock=self.own_clock)

    def scenario(self) -> Scenario:
        """The same flight for `closed_loop`.

        Raises:
            ValueError: there is no simulator in this plan.
        """
        if not self.options.simulator:
            raise ValueError("a mission without the simulator has no closed loop")
        plant = self.parameters[topics.PLANT]
        return Scenario(
            path=self.mission.path,
            vehicle=self.vehicle,
            thrust=self.mission.thrust,
            initial=plant.initial.state,
            current=plant.current.value,
            sea=sea.load(plant.sea) if plant.sea else None,
            seed=plant.seed,
            step=plant.step,
            guidance=self.parameters[topics.GUIDANCE].guidance,
            observer=self.parameters[topics.OBSERVER].observer,
            autopilot=self.parameters[topics.AUTOPILOT].autopilot,
            controller_vehicle=self.controller_model,
        )

    def write(self, directory: Path) -> Path:
        """Write the resolved configuration, such that it can be flown again as it stands.

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
        told = {}
        for name, settings in self.parameters.items():
            its = {k: str(here[k]) for k in here if hasattr(settings, k)}
            if "vehicle" in its and "controller_model" in here and name != topics.PLANT:
                its["vehicle"] = str(here["controller_model"])
            told[name] = dataclasses.replace(settings, **its)
        target = directory / "params.yaml"
        yaml_file.dump(params_file.as_ros(told), target)
        return target


def make(options: Options, directory: Path) -> Plan:
    """Read and check all files, and give every node its parameters.

    Args:
        options: what was asked for.
        directory: the run directory; the bag goes there.

    Raises:
        ConfigurationError: one line with the place, what was found and what was expected.
    """
    sources = {
        "mission": config_files.find("missions", options.mission).absolute(),
        "vehicle": config_files.find("vehicles", options.vehicle).absolute(),
        "params": config_files.find("params", options.params).absolute(),
    }
    hull = model = vehicle.load(str(sources["vehicle"]))
    if options.controller_model is not None:
        sources["controller_model"] = config_files.find("vehicles", options.controller_model).absolute()
        model = vehicle.load(str(sources["controller_model"]))
    model_file = str(sources.get("controller_model", sources["vehicle"]))
    mission = mission_file.load(str(sources["mission"]), model)
    if (options.simulator or options.emulator) and hull.hull is None:
        raise ConfigurationError(
            f"{sources['vehicle']}: hull",
            "nothing",
            "the hull's coefficients, or --no-sim: the simulator needs them",
        )
    notices: list[str] = []
    parameters = params_file.load(sources["params"], SUITE, options.namespace, notices)
    timing = {"lockstep": options.simulator and options.speed is None}
    timing["recorded"] = timing["lockstep"]
    for name in parameters:
        parameters[name] = dataclasses.replace(parameters[name], **timing)
    _try_gains(model, parameters[topics.AUTOPILOT], sources["params"])
    wishes = parameters[topics.GUIDANCE].with_mission_overrides(mission).guidance
    _tell(parameters, topics.GUIDANCE, guidance=wishes, mission_switching=False)
    _tell(parameters, topics.GUIDANCE, mission=str(sources["mission"]), vehicle=model_file)
    _tell(parameters, topics.OBSERVER, vehicle=model_file)
    _tell(parameters, topics.AUTOPILOT, vehicle=model_file)
    _tell(
        parameters,
        topics.PLANT,
        vehicle=str(sources["vehicle"]),
        initial=_initial(options, mission, parameters),
        publish_at_rest=False,
    )
    _tell(parameters, topics.RECORDER, directory=str(directory / "bag"))
    if options.speed is not None:
        _tell(parameters, topics.PLANT, speed=options.speed)
    water = _sea(options, parameters, sources)
    if options.current is not None:
        current = parameters[topics.PLANT].current
        changed = dataclasses.replace(current, Vx=options.current[0], Vy=options.current[1])
        _tell(parameters, topics.PLANT, current=changed)
    if options.switching is not None:
        guidance = parameters[topics.GUIDANCE].guidance
        switching = dataclasses.replace(guidance.switching, mode=options.switching)
        _tell(parameters, topics.GUIDANCE, guidance=dataclasses.replace(guidance, switching=switching))
    guidance = parameters[topics.GUIDANCE].guidance
    current = NO_CURRENT
    if options.simulator or options.emulator:
        told = parameters[topics.PLANT].current.value
        current = Current(told.Vx + water[0], told.Vy + water[1])
    verdicts = check(mission, hull, current, guidance.switching, guidance.lookahead)
    verdicts = dataclasses.replace(verdicts, notices=(*verdicts.notices, *notices))
    if verdicts.refusals and not options.force:
        raise refusal(mission, verdicts, "--force flies it all the same")
    emulator, driver = None, DRIVERS.get(options.vehicle_driver or "")
    if driver is not None:
        file = str(sources["vehicle"])
        emulator = configure_driver(driver, options.vehicle_address, options.speed, file, parameters)
    for name in {topics.PLANT, *DRIVERS.values()} - {topics.PLANT if options.simulator else driver}:
        del parameters[name]
    return Plan(options, mission, hull, parameters, sources, verdicts, model, emulator)


def scenario(options: Options) -> Scenario:
    """The flight that the launcher would fly, for `closed_loop.fly`; nothing is written.

    Args:
        options: as for the launcher, with its defaults.

    Raises:
        ConfigurationError: one line with the place, what was found and what was expected.
    """
    return make(options, Path("runs")).scenario()


def _try_gains(known: Vehicle, settings: AutopilotParameters, file: Path) -> None:
    """Find here what the autopilot's node would end with."""
    try:
        HeadingAutopilot(known, settings.autopilot)
    except ConfigurationError as error:
        place = f"{file}: {topics.AUTOPILOT}: {error.where}"
        raise ConfigurationError(place, error.found, error.expected) from None


def _sea(options: Options, parameters: dict[str, Any], sources: dict[str, Path]) -> Pair:
    """Tell the simulator its sea, asked for or of the parameter file; returns its mean current, m/s, NED."""
    name = options.sea if options.sea is not None else parameters[topics.PLANT].sea
    if not name or not options.simulator:
        if options.seed is not None:
            raise ConfigurationError("--seed", "without a sea", "--sea with it: nothing else is random")
        return 0.0, 0.0
    sources["sea"] = config_files.find("seas", name).absolute()
    seed = options.seed if options.seed is not None else parameters[topics.PLANT].seed
    _tell(parameters, topics.PLANT, sea=str(sources["sea"]), seed=seed)
    return sea.load(str(sources["sea"])).current.mean


def _tell(parameters: dict[str, Any], node: str, **changes: Any) -> None:
    parameters[node] = dataclasses.replace(parameters[node], **changes)


def _initial(options: Options, mission: Mission, parameters: dict[str, Any]) -> Any:
    """Where the simulated vehicle begins: as asked for, else on the path's start, heading along it."""
    initial = parameters[topics.PLANT].initial
    if options.initial is not None:
        x, y, psi = options.initial[0], options.initial[1], math.radians(options.initial[2])
    elif initial == type(initial)():
        x, y, psi = mission.path.start_pose
    else:
        return initial
    return dataclasses.replace(initial, x=x, y=y, psi=psi)
