"""A survey for a vehicle of which little is given: planned, checked and flown on its own hull."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current
from auv_path_following import config_files
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.mission_check.flyable import check, refusal
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.flight import closed_loop
from auv_sim.flight.loops import followed_path
from auv_sim.flight.metrics import summarise
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE

#: Radius of the turns: in tightest turns, and at least in hull lengths; then wider by these factors.
_TURNS, _LENGTHS = 2.5, 5.0
_WIDER = (1.0, 1.5, 2.25)
#: Least flown share of the survey; with less the facts are doubted. Manoeuvres do not need all of it.
_LEAST_SHARE = 0.8
#: Current of the trial, as a share of the speed, and its direction, rad.
_CURRENT, _DIRECTION = 0.15, 0.8
#: Depths of a vehicle that dives, in shallowest depths of its range.
_DEPTHS = (3.0, 4.0, 5.0)

#: What is expected of facts.
_FLYING = "facts of a vehicle that flies one"


class TrialFlight(NamedTuple):
    """Result of one flight: current (m/s), flown share of the path, rms and largest distance to it (m)."""

    current: float
    share: float
    rms: float
    largest: float


class TrialSurvey(NamedTuple):
    """A survey as the text of its file and as a mission, and its flights; `is_flown`: all of it, by each."""

    text: str
    mission: Mission
    trials: list[TrialFlight]
    is_flown: bool


def trial_survey(vehicle: Vehicle, file: str) -> TrialSurvey:
    """Return a survey with the tightest turns that the vehicle flies, with gains by the rule.

    Args:
        vehicle: with the hull to fly.
        file: name of the mission file, for messages.

    Raises:
        ConfigurationError: the mission is refused, or less than `_LEAST_SHARE` of it is flown.
    """
    notices = gains_for(vehicle).notices
    for wider in _WIDER:
        text = trial_text(vehicle, wider)
        mission = mission_file.read_text(text, vehicle, file)
        trials, is_flown = fly_trials(vehicle, mission)
        if is_flown or notices:
            break
    worst = min(trials, key=lambda trial: trial.share)
    if worst.share < _LEAST_SHARE:
        why = notices[0] if notices else "check delay, rudder rate and radius"
        raise ConfigurationError(
            vehicle.name,
            f"a survey flown to {worst.share:.0%} in {worst.current:.2f} m/s of current",
            f"{_FLYING} ({why.removeprefix(f'{vehicle.name}: ')})",
        )
    return TrialSurvey(text, mission, trials, is_flown)


def trial_text(vehicle: Vehicle, wider: float = 1.0) -> str:
    """Return a mission file: a survey with turns of 2.5 tightest ones, or wider by a factor."""
    tightest = max(_TURNS * tightest_turn(vehicle).radius, _LENGTHS * vehicle.length)
    radius = math.ceil(wider * tightest)
    spacing = math.ceil(3.3 * radius)
    leg = 8 * radius
    survey = {
        "polygon": [[0, 0], [leg, 0], [leg, 3 * spacing], [0, 3 * spacing]],
        "spacing": spacing, "heading_deg": 0, "run_out": max(5, round(0.5 * radius)),
        "smoothing": {"kind": "fermat", "radius": radius},
    }  # fmt: skip
    if vehicle.dives:
        survey["leg_depths"] = [round(share * vehicle.depth.surface, 1) for share in _DEPTHS]
    thrust = float(f"{vehicle.thrust_max if vehicle.cruise is None else vehicle.cruise.thrust:g}")
    mission = {"version": 1, "name": "trial survey", "frame": "ned", "thrust": thrust, "survey": survey}
    return f"# A survey with turns of {radius} m, flown on the assumed hull.\n{yaml_file.text_of(mission)}"


def fly_trials(vehicle: Vehicle, mission: Mission) -> tuple[list[TrialFlight], bool]:
    """Check a mission and fly it with gains by the rule, in still water and in a current.

    Returns:
        The flights, and whether each flew all of the mission.

    Raises:
        ConfigurationError: the mission is refused.
    """
    gains = gains_for(vehicle)
    settings = params_file.load(config_files.find("params", "robust"), SUITE)
    guidance = with_gains(settings[topics.GUIDANCE].guidance, gains)
    findings = check(mission, vehicle, switching=guidance.switching, lookahead=guidance.lookahead)
    if findings.refusals:
        raise refusal(mission, findings, "give other facts")
    trials, is_flown = [], True
    for speed in (0.0, _CURRENT * vehicle.speed_at(mission.thrust)):
        scenario = Scenario(
            path=mission.path, spatial=mission.spatial, vehicle=vehicle, thrust=mission.thrust,
            current=Current(speed * math.cos(_DIRECTION), speed * math.sin(_DIRECTION)),
            guidance=guidance, autopilot=gains.heading.autopilot,
            pitch=(gains.pitch or gains.heading).autopilot,
            time_limit=2.0 * findings.duration + 120.0,
        )  # fmt: skip
        flown = summarise(closed_loop.fly(scenario), followed_path(scenario))
        is_flown = is_flown and flown.outcome() == "complete"
        trials.append(TrialFlight(speed, flown.flown_share, flown.rms_distance, flown.largest_distance))
    return trials, is_flown
