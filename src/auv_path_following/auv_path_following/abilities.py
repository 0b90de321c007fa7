"""Abilities of a vehicle as its owner measures them, limits of its fins, and the depths that it may use."""

from __future__ import annotations

import math

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import increasing, unfit
from auv_path_following.thrust_units import Rows, interpolated

#: Largest dead time of a fin, s.
LONGEST_DEAD_TIME = 2.0


@settings
class Rudder:
    """Limits of the rudder, or of the stern planes, equal to both sides."""

    max_angle_deg: float = setting(doc="largest angle", unit="deg", gt=0.0, lt=90.0)
    max_rate_deg_s: float = setting(doc="largest rate", unit="deg/s", gt=0.0)
    dead_time: float = setting(
        0.0,
        "time from a command to the start of the fin: of the link and of the servo",
        unit="s",
        ge=0.0,
        le=LONGEST_DEAD_TIME,
    )

    @property
    def max_angle(self) -> float:
        """Largest angle, rad."""
        return math.radians(self.max_angle_deg)

    @property
    def max_rate(self) -> float:
        """Largest rate, rad/s."""
        return math.radians(self.max_rate_deg_s)


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

    thrust: float = setting(doc="steady thrust, in the vehicle's unit", unit="N", gt=0.0)
    speed: float = setting(doc="steady speed through the water at this thrust", unit="m/s", gt=0.0)
    speeds: tuple[Pair, ...] = setting(
        (),
        "steady speeds at several thrusts: rows of thrust and speed, both increasing",
    )

    @pydantic.model_validator(mode="after")
    def _speeds_increase(self) -> Cruise:
        increasing(self.speeds)
        increasing(tuple((speed, thrust) for thrust, speed in self.speeds))
        if self.speeds and not min(self.speeds[0]) > 0.0:
            raise unfit(f"speeds that begin with {self.speeds[0]}", "thrusts and speeds greater than 0")
        if self.speeds and abs(interpolated(self.rows, self.thrust) - self.speed) > 0.1 * self.speed:
            by_rows = interpolated(self.rows, self.thrust)
            raise unfit(
                f"{self.speed:g} m/s at {self.thrust:g}, with {by_rows:.3g} m/s by speeds",
                "the same within 10 %",
            )
        return self

    @property
    def rows(self) -> Rows:
        """Rows of thrust and speed that are interpolated: `speeds`, else the one speed."""
        return self.speeds or ((self.thrust, self.speed),)


@settings
class Turning:
    """Measured turning ability, used instead of the hull's coefficients.

    All but the radius are optional. The last three are measured at the speed of `Cruise`; the rule of
    docs/tuning.md makes gains of them.
    """

    radius: float = setting(doc="radius of a steady turn with full rudder", unit="m", gt=0.0)
    radii: tuple[Pair, ...] = setting(
        (), "radii of steady turns with less rudder: rows of angle (deg) and radius (m)"
    )
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

    @pydantic.model_validator(mode="after")
    def _less_rudder_turns_wider(self) -> Turning:
        increasing(self.radii)
        last = math.inf
        for angle, radius in (*self.radii, (90.0, self.radius)):
            if not (angle > 0.0 and self.radius <= radius <= last):
                raise unfit(
                    f"radii: {radius:g} m at {angle:g} deg",
                    f"radii that fall while angles increase, down to {self.radius:g} m with full rudder",
                )
            last = radius
        return self


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
