"""What the compiled flight reads: the fields of the suite's settings as plain numbers, by the same names.

A law that only reads `config.k1` cannot tell such a tuple from the settings object it was made from, so one
function serves both. Words (which law, which controller) become their index.
"""

from __future__ import annotations

import dataclasses
from collections import namedtuple
from typing import Any, NamedTuple

from auv_path_following.control.hull_model import HullModel
from auv_path_following.control.nism import NismConfig
from auv_path_following.control.pid import PidConfig
from auv_path_following.control.reference_model import Limits, ReferenceConfig
from auv_path_following.control.smc import SmcConfig
from auv_path_following.guidance.acceptance import Cornering
from auv_path_following.guidance.adaptive_lookahead import AdaptiveLookaheadConfig
from auv_path_following.guidance.ailos import AilosConfig
from auv_path_following.guidance.ilos import IlosConfig
from auv_path_following.guidance.los import LosConfig
from auv_path_following.vehicle import Hull
from auv_sim.plant.remus import RemusDynamics

LAWS = ("ailos", "ilos", "los")
CONTROLLERS = ("nism", "pid", "smc")
SWITCHING = ("off", "g0", "all")

_CLASSES: dict[type[Any], Any] = {}


def _numbers_class(settings: type[Any]) -> Any:
    """A named tuple with the fields of a settings class; its name is importable, so that it can be cached."""
    fields = [field.name for field in dataclasses.fields(settings)]
    made = namedtuple(f"{settings.__name__}Numbers", fields, module=__name__)  # type: ignore[misc]
    _CLASSES[settings] = made
    return made


HullNumbers = _numbers_class(Hull)
NismConfigNumbers = _numbers_class(NismConfig)
PidConfigNumbers = _numbers_class(PidConfig)
SmcConfigNumbers = _numbers_class(SmcConfig)
ReferenceConfigNumbers = _numbers_class(ReferenceConfig)
AdaptiveLookaheadConfigNumbers = _numbers_class(AdaptiveLookaheadConfig)
AilosConfigNumbers = _numbers_class(AilosConfig)
IlosConfigNumbers = _numbers_class(IlosConfig)
LosConfigNumbers = _numbers_class(LosConfig)


def numbers_of(settings: Any) -> Any:
    """A settings object as plain numbers; its classes have to be listed above."""
    values = []
    for field in dataclasses.fields(settings):
        value = getattr(settings, field.name)
        if dataclasses.is_dataclass(value):
            values.append(numbers_of(value))
        else:
            values.append(value if isinstance(value, bool) else float(value))
    return _CLASSES[type(settings)](*values)


class Configured(NamedTuple):
    """Stands for a law without state, in the place of `self`."""

    config: Any


class Dynamics(NamedTuple):
    """Stands for a `RemusDynamics`, in the place of `self`."""

    hull: Any
    inv_x: float
    inv_vv: float
    inv_vr: float
    inv_rv: float
    inv_rr: float
    Xvr: float

    @classmethod
    def of(cls, dynamics: RemusDynamics) -> Dynamics:
        """The same numbers."""
        names = cls._fields[1:]
        return cls(numbers_of(dynamics.hull), *(float(getattr(dynamics, name)) for name in names))


class Model(NamedTuple):
    """Stands for a `HullModel`, in the place of `self`; `cruise`: its speed at the mission's thrust, m/s."""

    hull: Any
    inv_vv: float
    inv_vr: float
    inv_rv: float
    inv_rr: float
    cruise: float

    @classmethod
    def of(cls, model: HullModel, thrust: float) -> Model:
        """The same numbers."""
        inverse = [float(getattr(model, name)) for name in cls._fields[1:5]]
        return cls(*[numbers_of(model.hull), *inverse, float(model.cruise(thrust))])


class Plant(NamedTuple):
    """The simulated vehicle: `RemusPlant` without its state. `thrust` is what it gives, N."""

    dynamics: Dynamics
    max_angle: float
    max_rate: float
    max_step: float
    thrust: float


class Guidance(NamedTuple):
    """`PathFollowerConfig` and `Agility`; `law` and `switching` are indices of `LAWS` and `SWITCHING`.

    `lookahead` is `PathFollowerConfig.lookahead`, which the law may not use at every distance.
    """

    law: int
    compensate_current: bool
    minimum_speed: float
    k: float
    saturation: float
    approach_radius: float
    turn_rate: float
    switching: int
    radius: float
    cornering: Cornering
    lookahead: float
    ailos: Configured
    ilos: Any
    los: Configured


class Observer(NamedTuple):
    """Eq. (35) over one step: the rows of its transition."""

    f11: float
    f12: float
    f21: float
    f22: float


class Autopilot(NamedTuple):
    """`HeadingAutopilot` without its state; `controller` is an index of `CONTROLLERS`.

    `bandwidth` is that of the filter behind dr/dt.
    """

    controller: int
    bandwidth: float
    nism: Any
    pid: Any
    smc: Any
    shaped: bool
    reference: Configured
    limits: Limits
    max_angle: float
    max_rate: float
    model: Model


class Flight(NamedTuple):
    """One flight: everything that decides its course but its path.

    Attributes:
        plant, guidance, observer, autopilot: as above.
        thrust: what the autopilot orders while the mission runs, N.
        Vx, Vy: current, m/s, NED.
        dt: between two odometries, s.
        steps: at most so many odometries.
    """

    plant: Plant
    guidance: Guidance
    observer: Observer
    autopilot: Autopilot
    thrust: float
    Vx: float
    Vy: float
    dt: float
    steps: int
