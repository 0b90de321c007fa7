"""The chain of a rerun: the pilot of a planar vehicle or of one that dives, and its answers on the wire."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw
from auv_path_following.control import autopilot, diving_autopilot
from auv_path_following.curves.spatial.spatial_rows import spatial_rows
from auv_path_following.guidance import guide
from auv_path_following.guidance.approach import agility_of, empty_approach
from auv_path_following.guidance.guide import GuideState
from auv_path_following.guidance.measured import Measured, SpatialMeasured
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.guidance.spatial.spatial_follower import mode_of
from auv_path_following.missions.mission_file import Mission
from auv_path_following.navigation import current_observer
from auv_path_following.nodes.readings import PLANAR, SPATIAL, Readings
from auv_path_following.parameters import GuidanceParameters
from auv_path_following.pilot import Pilot, first_state, pilot
from auv_path_following.spatial_pilot import SpatialPilot, spatial_first_state, spatial_pilot
from auv_path_following.vehicle import Vehicle


class Answer(NamedTuple):
    """The pilot's commands for one odometry, as sent on the wire; the fields are names of topics."""

    rudder_cmd: float
    thrust_cmd: float
    desired_yaw: float
    desired_yaw_rate: float
    desired_thrust: float
    path_parameter: float


class SpatialAnswer(NamedTuple):
    """The same for a vehicle that dives."""

    rudder_cmd: float
    sternplane_cmd: float
    thrust_cmd: float
    desired_yaw: float
    desired_yaw_rate: float
    desired_pitch: float
    desired_pitch_rate: float
    desired_depth: float
    desired_thrust: float
    path_parameter: float


class PlanarChain:
    """The pilot of a planar vehicle: configuration and state.

    Args:
        parameters: node name -> settings.
        guidance: those of guidance, with what the mission overrides.
        mission, vehicle: of the flight.

    Attributes:
        readings: conversions of the vehicle's messages.
        answer: class of the answers.
        with_altitude: whether guidance needs the range to the bottom.
        guide: configuration of guidance.
    """

    readings: Readings = PLANAR
    answer: Any = Answer
    with_altitude = False

    def __init__(
        self,
        parameters: dict[str, Any],
        guidance: GuidanceParameters,
        mission: Mission,
        vehicle: Vehicle,
    ) -> None:
        steering = parameters[topics.AUTOPILOT]
        observer = current_observer.prepare(parameters[topics.OBSERVER].observer)
        # In lockstep a node's watchdogs rest, and so do these bounds.
        hold_after = math.inf if guidance.lockstep else guidance.holding.hold_after
        gap = math.inf if guidance.lockstep else steering.odometry_timeout
        self.guide = self._guide_of(guidance, mission, vehicle, hold_after)
        self._config = self._pilot_of(observer, steering, vehicle, gap)
        self._state: Any = None
        self.restart()

    def _guide_of(
        self, guidance: GuidanceParameters, mission: Mission, vehicle: Vehicle, hold_after: float
    ) -> guide.Guide:
        self._rows: Any = mission.path.rows
        return guide.prepare(
            guidance.guidance, agility_of(vehicle, mission.thrust), mission.thrust, hold_after
        )

    def _pilot_of(self, observer: Any, steering: Any, vehicle: Vehicle, gap: float) -> Any:
        return Pilot(observer, self.guide, autopilot.prepare(steering.autopilot, vehicle), gap, True)

    def restart(self) -> None:
        """Take the state before a mission."""
        self._state = first_state(self._config, empty_approach())

    @property
    def guiding(self) -> GuideState:
        """The state of guidance."""
        state: GuideState = self._state.guide
        return state

    @guiding.setter
    def guiding(self, state: GuideState) -> None:
        self._state = self._state._replace(guide=state)

    def step(self, navigation: Any, water: Any | None, altitude: float, now: float, dt: float) -> Any:
        """Return the answer to a measurement.

        Args:
            navigation: NED.
            water: velocity through the water, FRD; None where no fresh one is known.
            altitude: range to the bottom, m; NaN where none is known or needed.
            now: stamp of the measurement, s.
            dt: time since the last one, s.
        """
        measured = Measured(navigation, water or PLANAR.no_water, water is not None, False, 0.0, now)
        self._state, out = pilot(self._config, self._rows, self._state, measured, dt)
        _, guided, reference, (rudder, thrust) = out
        yaw = flip_yaw(guided.psi_d)
        return Answer(rudder, thrust, yaw, -guided.r_d, reference.thrust, guided.s)


class SpatialChain(PlanarChain):
    """The pilot of a vehicle that dives; a planar mission is flown at the vehicle's surface depth."""

    readings = SPATIAL
    answer = SpatialAnswer

    def _guide_of(
        self, guidance: GuidanceParameters, mission: Mission, vehicle: Vehicle, hold_after: float
    ) -> guide.Guide:
        self._rows = spatial_rows(flown_path(mission.path, mission.spatial, vehicle, mission.thrust))
        self.with_altitude = mission.altitude is not None
        mode = mode_of(mission, guidance.guidance, guidance.limits, vehicle)
        return guide.prepare_spatial(guidance.guidance, vehicle, mission.thrust, mode, hold_after)

    def _pilot_of(self, observer: Any, steering: Any, vehicle: Vehicle, gap: float) -> Any:
        both = diving_autopilot.prepare(steering.autopilot, steering.pitch, vehicle)
        return SpatialPilot(observer, self.guide, both, gap, True)

    def restart(self) -> None:
        self._state = spatial_first_state(self._config, empty_approach())

    def step(self, navigation: Any, water: Any | None, altitude: float, now: float, dt: float) -> Any:
        through, has_water = water or SPATIAL.no_water, water is not None
        measured = SpatialMeasured(navigation, through, has_water, False, 0.0, now, altitude)
        self._state, out = spatial_pilot(self._config, self._rows, self._state, measured, dt)
        _, guided, reference, (rudder, sternplanes, thrust) = out
        return SpatialAnswer(
            rudder, sternplanes, thrust, flip_yaw(guided.psi_d), -guided.r_d,
            -guided.theta_d, -guided.q_d, guided.depth, reference.thrust, guided.s,
        )  # fmt: skip


def chain_of(
    parameters: dict[str, Any], guidance: GuidanceParameters, mission: Mission, vehicle: Vehicle
) -> PlanarChain:
    """Return the chain of a vehicle; arguments as those of `PlanarChain`.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission, or the gains do not fit it.
    """
    if vehicle.dives:
        return SpatialChain(parameters, guidance, mission, vehicle)
    mission.require_planar()
    return PlanarChain(parameters, guidance, mission, vehicle)
