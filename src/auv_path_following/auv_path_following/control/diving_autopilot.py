"""The autopilots of a vehicle that dives: heading by the rudder, pitch by the stern planes."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.attitude import euler_rates
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import (
    Navigation,
    Reference,
    SpatialCommand,
    SpatialNavigation,
    SpatialReference,
)
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import Autopilot, AutopilotConfig, AutopilotState, kept, steer
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.vehicle import Vehicle


class DivingAutopilot(NamedTuple):
    """Configuration: the autopilots of the two planes."""

    heading: Autopilot
    pitch: Autopilot


class DivingAutopilotState(NamedTuple):
    """States of the two autopilots."""

    heading: AutopilotState
    pitch: AutopilotState


def prepare(heading: AutopilotConfig, pitch: AutopilotConfig, vehicle: Vehicle) -> DivingAutopilot:
    """Return the configuration.

    Args:
        heading, pitch: controllers and gains.
        vehicle: hull and fins that the autopilots assume.

    Raises:
        ConfigurationError: the gains need values that the vehicle's file does not have.
    """
    side = pitch_plane_of(vehicle)
    return DivingAutopilot(autopilot.prepare(heading, vehicle), autopilot.prepare(pitch, side))


@pure
def first_state(config: DivingAutopilot) -> DivingAutopilotState:
    """Return the state before the first measurement: both fins are neutral."""
    return DivingAutopilotState(autopilot.first_state(config.heading), autopilot.first_state(config.pitch))


@pure
def steer_both(
    config: DivingAutopilot,
    state: DivingAutopilotState,
    navigation: SpatialNavigation,
    reference: SpatialReference,
    dt: float,
) -> tuple[DivingAutopilotState, SpatialCommand]:
    """Turn a reference into rudder, stern planes and thrust; in pitch by Eq. (3D-28).

    Both autopilots see the rates of the Euler angles, Eq. (3D-27), not those about the body axes: with the
    roll that the propeller causes, the difference is a standing error of the pitch in every turn.

    Args:
        config: of both planes.
        state: of the last step.
        navigation: measured attitude and rates, NED.
        reference: from guidance; thrust 0: no mission is running.
        dt: seconds since the last step (0 on the first one).
    """
    psi_rate, theta_rate = euler_rates(navigation.phi, navigation.theta, navigation.q, navigation.r)
    turning = Reference(reference.psi_d, reference.r_d, reference.thrust)
    level = Navigation(navigation.x, navigation.y, navigation.psi, psi_rate)
    heading, turned, _ = steer(config.heading, state.heading, level, turning, dt)
    pitching = Reference(reference.theta_d, reference.q_d, reference.thrust)
    tilt = Navigation(0.0, 0.0, navigation.theta, theta_rate)
    pitch, tilted, _ = steer(config.pitch, state.pitch, tilt, pitching, dt)
    return DivingAutopilotState(heading, pitch), SpatialCommand(turned.rudder, tilted.rudder, turned.thrust)


def both_kept(config: DivingAutopilot, state: DivingAutopilotState) -> DivingAutopilotState:
    """Return the state for a new configuration, see `autopilot.kept`."""
    return DivingAutopilotState(*(kept(one, was) for one, was in zip(config, state, strict=True)))


class SpatialAutopilot:
    """The autopilots of one vehicle that dives: configuration and state.

    Args:
        vehicle: for the limits of fins and thrust, and for models.
        heading, pitch: controllers and gains.

    Raises:
        ConfigurationError: the gains need values that the vehicle's file does not have.
    """

    def __init__(self, vehicle: Vehicle, heading: AutopilotConfig, pitch: AutopilotConfig) -> None:
        self.vehicle = vehicle
        self.config = prepare(heading, pitch, vehicle)
        self.state = first_state(self.config)

    def configure(self, heading: AutopilotConfig, pitch: AutopilotConfig) -> None:
        """Take new gains; the fins stay where they are unless a controller changes.

        Raises:
            ConfigurationError: as the constructor; nothing is changed.
        """
        self.config = prepare(heading, pitch, self.vehicle)
        self.state = both_kept(self.config, self.state)

    def reset(self) -> None:
        """Reset the state."""
        self.state = first_state(self.config)

    def update(self, navigation: SpatialNavigation, reference: SpatialReference, dt: float) -> SpatialCommand:
        """Take one step, see `steer_both`."""
        self.state, command = steer_both(self.config, self.state, navigation, reference, dt)
        return command
