"""The hulls of the study: those shipped, one that is stable in yaw, and drawn ones."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.vehicle import Hull, Vehicle

#: Delay of hulls whose files have no dead time, s: that of the sea `moderate`.
USUAL_DELAY = 0.05
#: Delays (s) and factors of the rudder's rate of drawn hulls, drawn evenly.
DELAYS, RATES = (0.025, 0.2), (0.5, 2.0)
#: Draws after which a number has no hull.
_MOST = 50


def shipped() -> dict[str, Vehicle]:
    """Return the hulls of `config/vehicles`, with `USUAL_DELAY` as their dead time."""
    return {name: late(vehicle.load(name), USUAL_DELAY) for name in config_files.shipped("vehicles")}


def late(hull: Vehicle, dead_time: float) -> Vehicle:
    """Return a vehicle with another dead time of its fins, s."""
    planes = hull.sternplanes
    return dataclasses.replace(
        hull,
        rudder=dataclasses.replace(hull.rudder, dead_time=dead_time),
        sternplanes=planes and dataclasses.replace(planes, dead_time=dead_time),
    )


def stable_hull() -> Vehicle:
    """Return a hull in the plane like that of MSS: stable in yaw, slow in sway, with a fast servo."""
    remus = vehicle.load("remus100")
    hull = dataclasses.replace(
        remus.coefficients, m=31.9, Yvd=-31.9, Xvr=31.9, Yvv=-155.0, Yuv=-1.0, Yur=-0.93, Yuud=4.8, Yrd=0.0,
        Nrr=-20.0, Nur=-4.165, Nuv=0.0, Nvv=0.0, Nvd=0.0, Nuud=-3.33,
    )  # fmt: skip
    rudder = dataclasses.replace(remus.rudder, max_angle_deg=20.0, max_rate_deg_s=300.0)
    stable = dataclasses.replace(remus, name="stable in yaw", rudder=rudder, hull=hull, params=None)
    return late(stable, USUAL_DELAY)


def drawn_hull(number: int) -> Vehicle:
    """Draw a hull; every second one is drawn around the one that is stable in yaw.

    Every coefficient is between half and twice that of its model; the rudder's rate and the dead time lie
    within `RATES` and `DELAYS`. Draws without a steady turn are drawn again.
    """
    model = (vehicle.load("remus100"), stable_hull())[number % 2]
    names = [field.name for field in dataclasses.fields(Hull) if field.type == "float"]
    random = np.random.default_rng([11, number])
    for _ in range(_MOST):
        factors = dict(zip(names, 2.0 ** random.uniform(-1.0, 1.0, len(names)), strict=True))
        rate = min(model.rudder.max_rate_deg_s, 30.0) * 2.0 ** random.uniform(-1.0, 1.0)
        dead_time = random.uniform(*DELAYS)
        try:
            hull = dataclasses.replace(
                model.coefficients, **{k: getattr(model.coefficients, k) * f for k, f in factors.items()}
            )
            rudder = dataclasses.replace(model.rudder, max_rate_deg_s=rate)
            drawn = dataclasses.replace(model, name=f"drawn {number}", hull=hull, rudder=rudder, params=None)
            response_of(drawn)
        except (ConfigurationError, ValueError):
            continue
        return late(drawn, dead_time)
    raise ConfigurationError(f"hull {number}", f"{_MOST} draws without a steady turn", "another number")


def study_hulls(drawn: int) -> dict[str, Vehicle]:
    """Return all hulls by name: shipped, stable in yaw, and `drawn` drawn ones."""
    return {**shipped(), "stable in yaw": stable_hull()} | {
        f"drawn {number}": drawn_hull(number) for number in range(drawn)
    }


def chosen(hulls: Mapping[str, Vehicle], names: Sequence[str] | None) -> dict[str, Vehicle]:
    """Return the hulls with the given names, in the order of the study; all without names.

    Raises:
        ConfigurationError: a name that none of the hulls has.
    """
    if names is None:
        return dict(hulls)
    unknown = [name for name in names if name not in hulls]
    if unknown:
        raise ConfigurationError("--hulls", ", ".join(unknown), f"some of: {', '.join(hulls)}")
    return {name: hull for name, hull in hulls.items() if name in names}
