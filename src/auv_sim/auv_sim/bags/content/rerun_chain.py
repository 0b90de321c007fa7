"""The chain of a rerun: the pilot of a recorded mission, with its answers as on the wire."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_path_following import pilots
from auv_path_following.course import course_of
from auv_path_following.guidance.approach import empty_approach
from auv_path_following.guidance.guide import GuideState, at_the_beginning, reconfigured
from auv_path_following.guidance.path_follower import distance_to_go
from auv_path_following.missions.mission_file import Mission
from auv_path_following.navigation import current_observer
from auv_path_following.nodes.readings import readings_of
from auv_path_following.parameters import GuidanceParameters
from auv_path_following.vehicle import Vehicle


class Sensed(NamedTuple):
    """One odometry with what belongs to it; the fields as `PlanarCourse.measured` takes them."""

    navigation: Any
    water: Any | None
    altitude: float
    moved: bool = False


class Chain:
    """The pilot of one vehicle: configuration and state.

    Args:
        parameters: node name -> settings.
        guidance: those of guidance, with what the mission overrides.
        mission, vehicle: of the flight.

    Attributes:
        readings: conversions of the vehicle's messages.
        answered: names of the topics of an answer.
        with_altitude: whether guidance needs the range to the bottom.
        guide: configuration of guidance.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission, or the gains do not fit it.
    """

    def __init__(
        self,
        parameters: dict[str, Any],
        guidance: GuidanceParameters,
        mission: Mission,
        vehicle: Vehicle,
    ) -> None:
        self.readings = readings_of(vehicle)
        self.answered = tuple(topic.name for topic in (*self.readings.commands, *self.readings.references))
        self._prepare(parameters, guidance, mission, vehicle)
        self._state: Any = None
        self.restart()

    def _prepare(
        self, parameters: dict[str, Any], guidance: GuidanceParameters, mission: Mission, vehicle: Vehicle
    ) -> None:
        self._course = course_of(mission, vehicle)
        self.with_altitude = self._course.with_altitude
        # The recording says when a mission ran, but not that it ascended: to that, a limit of a dive leads.
        self.guide = self._course.prepare(guidance, is_limited=vehicle.dives)
        self._to_go: float = self._course.path.length
        steering = parameters[topics.AUTOPILOT]
        observer = current_observer.prepare(parameters[topics.OBSERVER].observer)
        # In lockstep a node's watchdogs rest, and so does this bound.
        gap = math.inf if guidance.lockstep else steering.odometry_timeout
        gains = steering.autopilot, steering.pitch
        self._config = pilots.prepare(observer, self.guide, *gains, vehicle, gap, by_wire=True)

    def change(
        self, parameters: dict[str, Any], guidance: GuidanceParameters, mission: Mission, vehicle: Vehicle
    ) -> None:
        """Take other parameters in flight, as the nodes do; arguments as for the class."""
        same = mission is self._course.mission
        self._prepare(parameters, guidance, mission, vehicle)
        before = self._state
        guiding, steering = before.guide, before.autopilot
        if same:
            guiding = reconfigured(self.guide, guiding)
        else:
            guiding = at_the_beginning(self.guide, guiding.mission, empty_approach())
            self._to_go = self._course.path.length
        steering = pilots.autopilot_kept(self._config.autopilot, steering)
        self._state = before._replace(guide=guiding, autopilot=steering)

    def restart(self) -> None:
        """Take the state before a mission."""
        self._state = pilots.pilot_waits(self._config, empty_approach())

    @property
    def guiding(self) -> GuideState:
        """The state of guidance."""
        state: GuideState = self._state.guide
        return state

    @guiding.setter
    def guiding(self, state: GuideState) -> None:
        self._state = self._state._replace(guide=state)

    def step(self, inputs: Sensed, now: float, dt: float) -> tuple[float, ...]:
        """Return the answer to a measurement, in the order of `answered`.

        Args:
            inputs: the measurement.
            now: its stamp, s.
            dt: time since the last one, s.
        """
        measured = self._course.measured(inputs, self._to_go, now)
        self._state, out = pilots.pilot_step(self._config, self._course.rows, self._state, measured, dt)
        self._to_go = distance_to_go(self._course.path, self.guide.follower.progress, self.guiding.follower)
        _, guided, reference, command = out
        return (*command, *self.readings.sent(guided, reference.thrust))
