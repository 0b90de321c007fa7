"""A rerun against the chain of the nodes where a limit ends a dive: its ascent is in no recorded word."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.values.types import SpatialNavigation, SpatialWater
from auv_path_following import pilots, vehicle
from auv_path_following.course import course_of
from auv_path_following.guidance.approach import empty_approach
from auv_path_following.guidance.guide import at_the_beginning
from auv_path_following.guidance.path_follower import distance_to_go
from auv_path_following.missions import mission_file
from auv_path_following.missions import mission_state as states
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.navigation import current_observer
from auv_path_following.parameters import AutopilotParameters, GuidanceParameters, ObserverParameters
from auv_sim.bags.content.rerun_chain import Chain, Sensed
from auv_sim.bags.content.rerun_phases import Phase, in_phase

DIVER = vehicle.load("remus100_6dof")
DIVE = mission_file.load(str(Path(__file__).parents[3] / "data" / "short_dive.yaml"), DIVER)
DT, STEPS, LIMIT = 0.05, 60, 1.0


def test_an_ascent_is_rerun_as_the_nodes_steered_it() -> None:
    mission = dataclasses.replace(DIVE, limits=LimitsConfig(duration=LIMIT))
    guidance, steering, observer = (
        GuidanceParameters(lockstep=True),
        AutopilotParameters(),
        ObserverParameters(),
    )
    guidance = dataclasses.replace(guidance, ascent=dataclasses.replace(guidance.ascent, when="always"))
    parameters = {topics.GUIDANCE: guidance, topics.AUTOPILOT: steering, topics.OBSERVER: observer}
    chain = Chain(parameters, guidance, mission, DIVER)
    chain.guiding = at_the_beginning(chain.guide, states.MissionStatus(states.RUNNING), empty_approach())
    course = course_of(mission, DIVER)
    config = pilots.prepare(
        current_observer.prepare(observer.observer), course.prepare(guidance),
        steering.autopilot, steering.pitch, DIVER, math.inf, True,
    )  # fmt: skip
    nodes = pilots.pilot_begins(config, empty_approach())
    to_go, pitch, thrust = course.path.length, [], []
    for k in range(STEPS):
        now = k * DT
        navigation = SpatialNavigation(1.9 * now, 0.1, 3.0 + 0.01 * k, 0.0, 0.02, 0.01, 0.0, 0.0)
        sensed = Sensed(navigation, SpatialWater(1.9, 0.0, 0.0), math.nan)
        dt = DT if k else 0.0
        nodes, out = pilots.pilot_step(config, course.rows, nodes, course.measured(sensed, to_go, now), dt)
        to_go = distance_to_go(course.path, config.guide.follower.progress, nodes.guide.follower)
        _, guided, reference, command = out
        chain.guiding = chain.guiding._replace(
            mission=in_phase(chain.guiding.mission, Phase(True, k == 0, False))
        )
        answer = chain.step(sensed, now, dt)
        assert answer == (*command, *chain.readings.sent(guided, reference.thrust)), k
        pitch.append(guided.theta_d)
        thrust.append(answer[chain.answered.index("thrust_cmd")])
    assert min(thrust) > 0.0
    assert states.is_surfacing(nodes.guide.mission)
    assert abs(pitch[int(LIMIT / DT) - 2]) < math.radians(10.0)
    assert pitch[-1] > math.radians(15.0), "bow up"
