"""Abilities of a vehicle as its owner measures them, and the range of depth that it may use."""

from __future__ import annotations

import math

from auv_msgs_py.settings.schema import setting, settings


@settings
class DepthRange:
    """Where and how slowly a vehicle with stern planes may go."""

    max: float = setting(100.0, "largest depth", unit="m", gt=0.0)
    surface: float = setting(0.5, "depth at which the propeller is still under water", unit="m", ge=0.0)
    minimum_speed: float = setting(
        0.9, "below it the planes cannot hold a depth against the buoyancy", unit="m/s", gt=0.0
    )
    max_pitch_deg: float = setting(30.0, "largest pitch that guidance requests", unit="deg", gt=0.0, lt=80.0)
    allow_sinking: bool = setting(False, "accept a hull heavier than water, which sinks without thrust")

    @property
    def max_pitch(self) -> float:
        """Largest pitch, rad."""
        return math.radians(self.max_pitch_deg)


@settings
class Cruise:
    """Measured speed straight ahead, used instead of the hull's drag."""

    thrust: float = setting(doc="steady thrust", unit="N", gt=0.0)
    speed: float = setting(doc="steady speed through the water at this thrust", unit="m/s", gt=0.0)


@settings
class Turning:
    """Measured turning ability, used instead of the hull's coefficients.

    The last three are optional. They are measured at the speed of `Cruise`; the rule of docs/tuning.md makes
    gains of them.
    """

    radius: float = setting(doc="radius of a steady turn with full rudder", unit="m", gt=0.0)
    effect: float | None = setting(
        None,
        "yaw acceleration for each radian of rudder, at once; deg/s^2 for each deg",
        unit="1/s^2",
        gt=0.0,
    )
    divergence: float | None = setting(
        None, "growth of a deviation from straight ahead, rudder neutral; below 0 it decays", unit="1/s"
    )
    drift_time: float | None = setting(
        None, "time constant with which sideslip settles in a turn with half the rudder", unit="s", gt=0.0
    )


@settings
class Pitching:
    """Measured ability to pitch, used instead of the coefficients of `hull.vertical`.

    The last three are as in `Turning`, for the stern planes.
    """

    rate_deg_s: float = setting(
        doc="largest pitch rate when the planes go to their stop", unit="deg/s", gt=0.0
    )
    climb_deg: float = setting(
        doc="steady pitch with the planes at their stop, at the speed of cruise", unit="deg", gt=0.0, le=90.0
    )
    effect: float | None = setting(
        None, "pitch acceleration for each radian of planes, at once; deg/s^2 for each deg",
        unit="1/s^2", gt=0.0,
    )  # fmt: skip
    divergence: float | None = setting(
        None, "growth of a deviation from level, planes neutral; below 0 it decays", unit="1/s"
    )
    drift_time: float | None = setting(
        None, "time constant with which the angle of attack settles", unit="s", gt=0.0
    )

    @property
    def rate(self) -> float:
        """Largest pitch rate, rad/s."""
        return math.radians(self.rate_deg_s)
