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
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.flight import closed_loop
from auv_sim.flight.loops import followed_path
from auv_sim.flight.metrics import summarise
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE

#: Radius of the turns: in tightest turns, and at least in hull lengths.
_TURNS, _LENGTHS = 2.5, 5.0
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


def trial_text(vehicle: Vehicle) -> str:
    """Return a mission file: a survey whose turns the vehicle can fly."""
    radius = math.ceil(max(_TURNS * tightest_turn(vehicle).radius, _LENGTHS * vehicle.length))
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
    return f"# A survey with turns of {radius} m, which the vehicle can fly.\n{yaml_file.text_of(mission)}"


def fly_trials(vehicle: Vehicle, mission: Mission) -> list[TrialFlight]:
    """Check a mission and fly it with gains by the rule, in still water and in a current.

    Raises:
        ConfigurationError: the mission is refused, or was not flown to its end.
    """
    gains = gains_for(vehicle)
    settings = params_file.load(config_files.find("params", "robust"), SUITE)
    guidance = with_gains(settings[topics.GUIDANCE].guidance, gains)
    findings = check(mission, vehicle, switching=guidance.switching, lookahead=guidance.lookahead)
    if findings.refusals:
        raise refusal(mission, findings, "give other facts")
    trials = []
    for speed in (0.0, _CURRENT * vehicle.speed_at(mission.thrust)):
        scenario = Scenario(
            path=mission.path, spatial=mission.spatial, vehicle=vehicle, thrust=mission.thrust,
            current=Current(speed * math.cos(_DIRECTION), speed * math.sin(_DIRECTION)),
            guidance=guidance, autopilot=gains.heading.autopilot,
            pitch=(gains.pitch or gains.heading).autopilot,
            time_limit=2.0 * findings.duration + 120.0,
        )  # fmt: skip
        flown = summarise(closed_loop.fly(scenario), followed_path(scenario))
        if flown.outcome() != "complete":
            why = gains.notices[0] if gains.notices else "check delay, rudder rate and radius"
            raise ConfigurationError(
                vehicle.name,
                f"a survey flown to {flown.flown_share:.0%} in {speed:.2f} m/s of current",
                f"{_FLYING} ({why.removeprefix(f'{vehicle.name}: ')})",
            )
        trials.append(TrialFlight(speed, flown.flown_share, flown.rms_distance, flown.largest_distance))
    return trials
