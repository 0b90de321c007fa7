"""The gains that are searched, as dimensionless variables around those of the rule.

Each variable is a ratio that means the same on every hull; its logarithm is searched.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_msgs_py.settings.schema import leaves
from auv_path_following.comparators.mss_pilot import MssPilot
from auv_path_following.control import autopilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.nism import NismConfig
from auv_path_following.control.pid import PidConfig
from auv_path_following.control.pitch_plane import pitch_gains
from auv_path_following.control.reference_model import ReferenceConfig, ReferenceLimits
from auv_path_following.control.rule.fin_response import FinResponse, response_of
from auv_path_following.control.rule.gain_rule import RuledGains, gains_for
from auv_path_following.guidance.acceptance import cornering_within
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.vehicle import Vehicle

Vector = npt.NDArray[np.float64]

#: Largest acceleration of the reference over b times the full rudder angle, and its largest rate over u0/R of
#: the steady turn: a corner is over before the turn has cost speed, so this is more than the steady rate.
LARGEST_ACCELERATION, LARGEST_RATE = 0.8, 1.3


class GainSet(NamedTuple):
    """Settings that a flight takes.

    Attributes:
        guidance: laws, look-aheads, corners.
        autopilot: of the heading.
        pitch: of a vehicle that dives.
        peer: of the law of MSS, which then flies; `autopilot` is its equal near the path.
    """

    guidance: PathFollowerConfig
    autopilot: AutopilotConfig
    pitch: AutopilotConfig
    peer: MssPilot | None = None


#: Laws that are tuned alike: name -> guidance law, heading controller.
LAWS = {
    "AILOS, NISM": ("ailos", "nism"),
    "AILOS, PID": ("ailos", "pid"),
    "LOS, NISM": ("los", "nism"),
    "ILOS, NISM": ("ilos", "nism"),
    "vector field, NISM": ("vector_field", "nism"),
}
OWN_LAW = "AILOS, NISM"


class Variable(NamedTuple):
    """A ratio that is searched: its name, smallest and largest value."""

    name: str
    low: float
    high: float


#: In the order of a point. w_c is the crossover of the inner loop, w_r the bandwidth of the reference.
VARIABLES = (
    Variable("crossover w_c times delay", 0.1, 1.25),
    Variable("k1 k2 over w_c", 0.05, 0.5),
    Variable("k3 k4 over w_c", 0.01, 0.25),
    Variable("w_r over w_c", 0.02, 0.4),
    Variable("acceleration over b times full rudder", 0.03, LARGEST_ACCELERATION),
    Variable("rate over u0/R", 0.2, LARGEST_RATE),
    Variable("look-ahead times w_r over speed", 0.7, 12.0),
    Variable("turn rate at corners over rate", 0.5, 2.0),
    Variable("lead at corners over that of the limits", 0.3, 2.0),
)


class GainSpace:
    """Turns points into gains of one vehicle and back.

    Args:
        vehicle: whose response makes the ratios dimensionless.
        guidance: laws and gains; all but look-aheads and circles stay.
        delay: from a measurement to the arrival of its command, s; the dead time of the fins is added.
        step: between two odometries, s.
        law: of `LAWS`.
        whole: the diving vehicle of which `vehicle` is the planar part: its planes have the rule's gains.

    Attributes:
        model: the vehicle that guidance and autopilots assume in flight.
        fastest: u0/R of the steady turn, rad/s.
        ruled: gains of the rule.
        first: their point, within the bounds.
    """

    def __init__(
        self, vehicle: Vehicle, guidance: PathFollowerConfig, delay: float, step: float,
        law: str = OWN_LAW, whole: Vehicle | None = None,
    ) -> None:  # fmt: skip
        self.vehicle = self.model = vehicle
        self._guidance, self._law = guidance, LAWS[law]
        self.response: FinResponse = response_of(vehicle)
        self.delay = max(delay + vehicle.rudder.dead_time + 0.5 * step, 0.02)
        self.fastest = self.response.speed / tightest_turn(vehicle).radius
        self.ruled: RuledGains = gains_for(vehicle, delay, step)
        if whole is not None:
            both = gains_for(whole, delay, step)
            self.ruled = self.ruled._replace(pitch=both.pitch, notices=both.notices)
        self.first = self._clipped(self._point_of_rule())

    def _point_of_rule(self) -> Vector:
        heading, response = self.ruled.heading, self.response
        nism, reference = heading.autopilot.nism, heading.autopilot.reference
        w_c, w_r = heading.crossover, reference.bandwidth
        ratios = (
            w_c * self.delay,
            nism.k1 * nism.k2 / w_c,
            nism.k3 * nism.k4 / w_c,
            w_r / w_c,
            reference.max_acceleration / (response.effect * self.vehicle.rudder.max_angle),
            reference.max_rate / self.fastest,
            heading.lookahead * w_r / response.speed,
            1.0,
            1.0,
        )
        return np.log(ratios)

    def point_of(self, gains: GainSet) -> Vector:
        """Return the point whose gains are nearest to some, within the bounds; their controller is NISM.

        Raises:
            ConfigurationError: the gains need values that the vehicle's file does not have.
        """
        prepared, response = autopilot.prepare(gains.autopilot, self.vehicle), self.response
        nism, reference = prepared.controller.gains, prepared.reference
        steepness = nism.kp * nism.k5
        w_c = response.effect * steepness
        for _ in range(12):  # until |r/delta| at w_c is 1/steepness
            w_c *= math.sqrt(abs(response.gain(w_c)) * steepness)
        ratios = (
            w_c * self.delay,
            nism.k1 * nism.k2 / w_c,
            nism.k3 * nism.k4 / w_c,
            reference.bandwidth / w_c,
            reference.limits.acceleration / (response.effect * self.vehicle.rudder.max_angle),
            reference.limits.rate / self.fastest,
            gains.guidance.lookahead * reference.bandwidth / response.speed,
            1.0,
            1.0,
        )
        return self._clipped(np.log(np.maximum(ratios, 1e-9)))

    @staticmethod
    def bounds() -> tuple[Vector, Vector]:
        """Return the smallest and the largest point."""
        return bounds()

    @staticmethod
    def _clipped(point: Vector) -> Vector:
        return np.clip(point, *bounds())

    def rule(self) -> GainSet:
        """Return the gains of the rule."""
        guidance = with_gains(self._guidance, self.ruled)
        pitch = self.ruled.pitch
        return GainSet(
            guidance, self.ruled.heading.autopilot, pitch_gains() if pitch is None else pitch.autopilot
        )

    def gains(self, point: Sequence[float] | Vector) -> GainSet:
        """Return the gains at a point (logarithms of `VARIABLES`, clipped to their bounds)."""
        ratios = np.exp(self._clipped(np.asarray(point, float))).tolist()
        crossing, a, c, slower, pull, turn, ahead, corner_rate, corner_lead = ratios
        ruled, response = self.ruled.heading.autopilot, self.response
        w_c = crossing / self.delay
        w_r = slower * w_c
        kp = ruled.nism.kp
        acceleration = pull * response.effect * self.vehicle.rudder.max_angle
        rate = turn * self.fastest
        k1 = ruled.nism.k1 / ruled.reference.max_rate * rate
        k3 = ruled.nism.k3 / ruled.reference.max_acceleration * acceleration
        steepness = 1.0 / abs(response.gain(w_c))
        nism = allowed(
            NismConfig, k1=k1, k2=a * w_c / k1, k3=k3, k4=c * w_c / k3, k5=steepness / kp, kp=kp, ks=0.0
        )
        # Near the path NISM is this PID law.
        pid = allowed(PidConfig, kp=(a + c) * w_c * steepness, ki=a * c * w_c * w_c * steepness, kd=steepness)
        jerk = ruled.reference.max_jerk
        reference = allowed(
            ReferenceConfig, enabled=True, bandwidth=w_r, max_rate=rate, max_acceleration=acceleration,
            max_jerk=jerk,
        )  # fmt: skip
        base = self.rule()
        law, controller = self._law
        guidance = with_lookahead(base.guidance, ahead * response.speed / w_r, law=law)
        by_limits = cornering_within(ReferenceLimits(rate, acceleration, jerk))
        switching = dataclasses.replace(
            guidance.switching, radius=0.0, turn_rate=corner_rate * rate, lead=corner_lead * by_limits.lead
        )
        return GainSet(
            dataclasses.replace(guidance, switching=switching),
            AutopilotConfig(controller=controller, nism=nism, pid=pid, reference=reference),
            base.pitch,
        )


def allowed(cls: type[Any], **values: Any) -> Any:
    """Return settings whose numbers are cut to the largest that their class allows."""
    largest = {leaf.name: leaf.maximum for leaf in leaves(cls)}
    return cls(
        **{
            name: value if isinstance(value, bool) or largest[name] is None else min(value, largest[name])
            for name, value in values.items()
        }
    )


def with_lookahead(config: PathFollowerConfig, lookahead: float, **others: Any) -> PathFollowerConfig:
    """Return guidance with a look-ahead distance (m); the vector field gets the same slope on the path."""
    changes: dict[str, Any] = {
        name: dataclasses.replace(getattr(config, name), lookahead=lookahead)
        for name in (field.name for field in dataclasses.fields(config))
        if name != "vertical" and hasattr(getattr(config, name), "lookahead")
    }
    field = config.vector_field
    slope = 0.5 * math.pi / (math.radians(field.entry_angle_deg) * lookahead)
    changes["vector_field"] = dataclasses.replace(field, gain=slope)
    return dataclasses.replace(config, **changes, **others)


def bounds() -> tuple[Vector, Vector]:
    """Return the smallest and the largest point."""
    return np.log([v.low for v in VARIABLES]), np.log([v.high for v in VARIABLES])


def ratios_at(point: Vector) -> dict[str, float]:
    """Return the variables of a point by name."""
    names = [variable.name for variable in VARIABLES]
    return dict(zip(names, map(math.exp, np.clip(point, *bounds())), strict=True))
