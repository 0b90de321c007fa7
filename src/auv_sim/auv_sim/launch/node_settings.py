"""The settings of a mission's nodes: the parameter file, then the mission's, then the command line's."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.settings.schema import Pair
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following.control import diving_autopilot
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.launch.options import BY_RULE, DEFAULT_PARAMS, Options
from auv_sim.sim_parameters import SUITE
from auv_sim.vehicle import sea

#: Node name -> its settings object.
NodeSettings = dict[str, Any]
#: "mission", "vehicle", "params" and, where given, "controller_model" and "sea" -> file.
Sources = dict[str, Path]


def params_of(options: Options, model: Vehicle) -> str:
    """Return the parameter file to use: as asked, else the vehicle's, else gains by the rule.

    A vehicle without a hull and without measured responses has the default file.
    """
    named = options.params or model.params
    if named is not None:
        return named
    has_response = model.hull is not None or (model.turning is not None and model.turning.effect is not None)
    return BY_RULE if has_response else DEFAULT_PARAMS


def load(options: Options, file: Path, model: Vehicle, by_rule: bool, notices: list[str]) -> NodeSettings:
    """Read the parameter file, set the timing, and validate the autopilot's gains before any node starts.

    Args:
        options: the command line.
        file: the parameter file.
        model: the hull that the nodes assume.
        by_rule: replace the gains by those of the rule.
        notices: a line for each name in a block for all nodes that no node has is appended.

    Raises:
        ConfigurationError: a parameter or a gain that its node would refuse.
    """
    settings: NodeSettings = params_file.load(file, SUITE, options.namespace, notices)
    if by_rule:
        _take_rule(settings, model, notices)
        if options.params is None:
            notices.append(f"{model.name}: gains by the rule of docs/tuning.md; its file names no params")
    lockstep = options.simulator and options.speed is None
    for name in settings:
        if name != topics.DISPLAY:  # for which no node waits
            change(settings, name, lockstep=lockstep, recorded=lockstep)
    try:
        HeadingAutopilot(model, settings[topics.AUTOPILOT].autopilot)
        if model.dives:
            steering = settings[topics.AUTOPILOT]
            diving_autopilot.prepare(steering.autopilot, steering.pitch, model)
    except ConfigurationError as error:
        place = f"{file}: {topics.AUTOPILOT}: {error.where}"
        raise ConfigurationError(place, error.found, error.expected) from None
    return settings


def _take_rule(settings: NodeSettings, model: Vehicle, notices: list[str]) -> None:
    """Replace gains and look-aheads by those of the rule; append its notices."""
    gains = gains_for(model, step=settings[topics.PLANT].step)
    guidance = with_gains(settings[topics.GUIDANCE].guidance, gains)
    change(settings, topics.GUIDANCE, guidance=guidance)
    change(settings, topics.AUTOPILOT, autopilot=gains.heading.autopilot)
    if gains.pitch is not None:
        change(settings, topics.AUTOPILOT, pitch=gains.pitch.autopilot)
    notices.extend(gains.notices)


def set_mission(
    settings: NodeSettings, options: Options, mission: Mission, sources: Sources, directory: Path,
    hull: Vehicle, begin: float = 0.0,
) -> None:  # fmt: skip
    """Set the files, the mission's overrides, the initial state and the bag; change `settings` in place.

    Args:
        settings: of all nodes.
        options: the command line.
        mission: as read from `sources`.
        sources: the input files.
        directory: the run directory.
        hull: the vehicle.
        begin: s of Eq. (1) at which the mission begins.
    """
    overridden = settings[topics.GUIDANCE].with_mission_overrides(mission).guidance
    model_file = str(sources.get("controller_model", sources["vehicle"]))
    change(settings, topics.GUIDANCE, guidance=overridden, mission_switching=False)
    change(settings, topics.GUIDANCE, mission=str(sources["mission"]))
    if options.force:
        change(settings, topics.GUIDANCE, check_mission=False)
    for node in (topics.GUIDANCE, topics.OBSERVER, topics.AUTOPILOT):
        change(settings, node, vehicle=model_file)
    change(settings, topics.DISPLAY, mission=str(sources["mission"]), vehicle=str(sources["vehicle"]))
    initial = _initial(options, mission, settings, begin)
    if hull.dives:
        initial = _at_depth(initial, options, mission, hull, begin)
    plant_file = str(sources["vehicle"])
    change(settings, topics.PLANT, vehicle=plant_file, initial=initial, publish_at_rest=False)
    change(settings, topics.RECORDER, directory=str(directory / "bag"), sternplanes=hull.dives)


def set_options(settings: NodeSettings, options: Options, sources: Sources) -> Pair:
    """Apply speed, sea, current and switching from the command line; change `settings` and `sources`.

    Returns:
        The sea's mean current, north and east, m/s; zero without a sea.

    Raises:
        ConfigurationError: the sea cannot be read, or there is a seed without a sea.
    """
    if options.speed is not None:
        change(settings, topics.PLANT, speed=options.speed)
    mean = _set_sea(settings, options, sources)
    if options.current is not None:
        Vx, Vy = options.current
        current = dataclasses.replace(settings[topics.PLANT].current, Vx=Vx, Vy=Vy)
        change(settings, topics.PLANT, current=current)
    if options.upwelling is not None:
        current = dataclasses.replace(settings[topics.PLANT].current, Vz=-options.upwelling)
        change(settings, topics.PLANT, current=current)
    if options.switching is not None:
        guidance = settings[topics.GUIDANCE].guidance
        switching = dataclasses.replace(guidance.switching, mode=options.switching)
        change(settings, topics.GUIDANCE, guidance=dataclasses.replace(guidance, switching=switching))
    return mean


def change(settings: NodeSettings, node: str, **changes: Any) -> None:
    """Replace fields of one node's settings."""
    settings[node] = dataclasses.replace(settings[node], **changes)


def _set_sea(settings: NodeSettings, options: Options, sources: Sources) -> Pair:
    name = options.sea if options.sea is not None else settings[topics.PLANT].sea
    if not name or not options.simulator:
        if options.seed is not None:
            raise ConfigurationError("--seed", "no sea", "a sea as well: nothing else is random")
        return 0.0, 0.0
    sources["sea"] = config_files.find("seas", name).absolute()
    seed = options.seed if options.seed is not None else settings[topics.PLANT].seed
    change(settings, topics.PLANT, sea=str(sources["sea"]), seed=seed)
    return sea.load(str(sources["sea"])).current.mean


def _initial(options: Options, mission: Mission, settings: NodeSettings, begin: float) -> Any:
    """Return the vehicle's initial state: as configured, else where the mission begins, heading along it."""
    initial = settings[topics.PLANT].initial
    if options.initial is not None:
        x, y, psi = options.initial[0], options.initial[1], math.radians(options.initial[2])
    elif initial == type(initial)():
        point = mission.path.at(begin)
        x, y, psi = point.x, point.y, point.chi
    else:
        return initial
    return dataclasses.replace(initial, x=x, y=y, psi=psi)


def _at_depth(initial: Any, options: Options, mission: Mission, hull: Vehicle, begin: float) -> Any:
    """Return the initial state with depth and pitch.

    Without `--depth` a vehicle that starts on the path has the path's depth and elevation there; but none
    starts higher than it floats.
    """
    if options.depth is not None:
        return dataclasses.replace(initial, depth=options.depth, theta=0.0)
    if initial.depth > 0.0:
        return initial
    if mission.spatial is None:
        return dataclasses.replace(initial, depth=hull.depth.surface)
    start, floating = mission.spatial.pose_at(begin), hull.shallowest
    is_on_path = options.initial is None and start.z >= floating
    theta = start.gamma if is_on_path else 0.0
    return dataclasses.replace(initial, depth=max(start.z, floating), theta=theta)
