"""The values of one parameter of a study: a distribution to draw from, or a grid."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import exactly_one, unfit

#: A value of a study: a number, a switch, or the name of a law, a mission, a file.
Value = float | bool | str

_KINDS = ("uniform", "log_uniform", "normal", "disc", "choice", "grid")
#: A normal distribution is cut here unless `within` says otherwise, standard deviations.
_CUT = 4.0
#: Least share that a cut normal distribution keeps: it is drawn from until a value falls inside.
_LEAST_SHARE = 1e-3


@settings
class Distribution:
    """One parameter's values; exactly one kind."""

    uniform: Pair | None = setting(None, "lowest and highest")
    log_uniform: Pair | None = setting(None, "lowest and highest; the logarithm is uniform")
    normal: Pair | None = setting(None, "mean and standard deviation, cut at four of these")
    disc: float | None = setting(
        None, "radius of a disc: the distance from its centre of a point uniform on it", gt=0.0
    )
    choice: tuple[Value, ...] | None = setting(None, "one of these, equally likely")
    grid: tuple[Value, ...] | None = setting(None, "each of these, with each of every other grid")
    within: Pair | None = setting(None, "with normal: where it is cut")
    factor: bool = setting(False, "the value multiplies what the file says")

    @pydantic.model_validator(mode="after")
    def _fits(self) -> Distribution:
        kind = exactly_one(self, _KINDS, "of " + ", ".join(_KINDS))
        if kind in ("uniform", "log_uniform"):
            low, high = getattr(self, kind)
            if not low < high:
                raise unfit(f"from {low:g} to {high:g}", "the lower end first")
            if kind == "log_uniform" and not low > 0.0:
                raise unfit(f"a logarithm of {low:g}", "ends greater than 0")
        if self.normal is not None and not self.normal[1] > 0.0:
            raise unfit(f"a standard deviation of {self.normal[1]:g}", "a number greater than 0")
        if self.within is not None and (self.normal is None or not self.within[0] < self.within[1]):
            raise unfit("within", "it only with normal, the lower end first")
        if self.normal is not None and _share(*self.normal, *self.extremes) < _LEAST_SHARE:
            raise unfit("bounds that leave next to nothing of it", "bounds around the mean")
        if kind in ("choice", "grid") and not getattr(self, kind):
            raise unfit("an empty list", "at least one value")
        if self.factor and not self.is_numeric:
            raise unfit("factor with something else than numbers", "numbers")
        return self

    @property
    def listed(self) -> tuple[Value, ...] | None:
        """The values of a choice or a grid."""
        return self.choice if self.choice is not None else self.grid

    @property
    def is_numeric(self) -> bool:
        """Whether its values are numbers."""
        return self.listed is None or all(type(value) is float for value in self.listed)

    @property
    def extremes(self) -> tuple[Value, ...]:
        """The values between which all others lie, or all values of a list."""
        if self.listed is not None:
            return self.listed
        if self.disc is not None:
            return 0.0, self.disc
        if self.normal is not None:
            mean, deviation = self.normal
            return self.within or (mean - _CUT * deviation, mean + _CUT * deviation)
        return self.uniform or self.log_uniform or ()

    def draw(self, generator: np.random.Generator) -> Any:
        """Draw one value; not for a grid."""
        if self.choice is not None:
            return self.choice[int(generator.integers(len(self.choice)))]
        if self.disc is not None:
            return self.disc * math.sqrt(generator.random())
        if self.normal is not None:
            low, high = self.extremes
            value = math.nan
            while not low <= value <= high:  # type: ignore[operator]
                value = self.normal[0] + self.normal[1] * float(generator.standard_normal())
            return value
        low, high = self.uniform or self.log_uniform or (0.0, 0.0)
        share = generator.random()
        if self.log_uniform is not None:
            return min(max(low * (high / low) ** share, low), high)
        return low + (high - low) * share


def _share(mean: float, deviation: float, low: Any, high: Any) -> float:
    """Return the share of a normal distribution between `low` and `high`."""
    scale = math.sqrt(2.0) * deviation
    return 0.5 * (math.erf((high - mean) / scale) - math.erf((low - mean) / scale))
