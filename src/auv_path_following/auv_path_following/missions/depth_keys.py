"""The keys of a mission file that give a depth, and its limits."""

from __future__ import annotations

from typing import Annotated

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_path_following.curves.spatial.depth_profile import DepthProfile, RampKind
from auv_path_following.missions.limits import LimitsConfig

#: A point in a file: two coordinates, and with a third one its depth (m, positive down).
Place = Annotated[tuple[float, ...], pydantic.Field(min_length=2, max_length=3)]


@settings
class DepthProfileSpec:
    """`depth_profile`: depth over the horizontal length of the route, before `reverse` and `repeat`."""

    kind: RampKind = setting("smooth", "ramps between the knots: smooth (level at each knot) or linear")
    knots: tuple[Pair, ...] = setting(
        doc="[horizontal length from the route's start, depth], the first at 0, the last at the route's end",
        unit="m",
    )

    def build(self) -> DepthProfile:
        """Return the profile.

        Raises:
            ConfigurationError: names the knot.
        """
        return DepthProfile(self.knots, self.kind)


@settings
class AltitudeSpec:
    """`altitude`: follow the bottom instead of a depth."""

    above_bottom: float = setting(doc="altitude to hold", unit="m", gt=0.0, le=1000.0)
    min: float = setting(0.0, "altitude below which the vehicle climbs at once; 0: none", unit="m", ge=0.0)

    @pydantic.model_validator(mode="after")
    def _holds_more_than_the_least(self) -> AltitudeSpec:
        if not self.above_bottom > self.min:
            found = f"above_bottom {self.above_bottom:g} m with min {self.min:g} m"
            raise unfit(found, "an above_bottom greater than min")
        return self


@settings
class LimitsSpec(LimitsConfig):
    """`limits` of a mission file: those of the run, and one of the path."""

    max_slope_deg: float = setting(
        0.0,
        "steepest slope that the path may have; 0: any that the vehicle can fly",
        unit="deg",
        ge=0.0,
        lt=90.0,
    )
