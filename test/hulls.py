"""Hulls beside the shipped ones, for tests of what is derived from a hull."""

from __future__ import annotations

import dataclasses

import numpy as np

from auv_path_following import vehicle
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.vehicle.hulls.remus_6dof import remus_6dof_of

REMUS = vehicle.load("remus100")

#: A fast servo on a hull that is stable in yaw and whose sway settles slowly.
STABLE = dataclasses.replace(
    REMUS,
    rudder=dataclasses.replace(REMUS.rudder, max_angle_deg=20.0, max_rate_deg_s=300.0),
    hull=dataclasses.replace(
        REMUS.coefficients, m=31.9, Yvd=-31.9, Xvr=31.9, Yvv=-155.0, Yuv=-1.0, Yur=-0.93, Yuud=4.8, Yrd=0.0,
        Nrr=-20.0, Nur=-4.165, Nuv=0.0, Nvv=0.0, Nvd=0.0, Nuud=-3.33,
    ),
)  # fmt: skip

#: The REMUS 100 with stern planes, as Prestero (2001) prints it.
DIVER = vehicle.load("remus100_6dof")
PRINTED = DIVER.coefficients.vertical
assert PRINTED is not None
RADIUS = 0.5 * PRINTED.diameter  # m
SIX_DOF = remus_6dof_of(DIVER.coefficients)


def with_vertical(**changes: float) -> Hull:
    """Return the coefficients of `DIVER` with others of heave, roll and pitch."""
    return dataclasses.replace(DIVER.coefficients, vertical=dataclasses.replace(PRINTED, **changes))


def drawn(number: int) -> Vehicle:
    """Draw a hull whose every coefficient is between half and twice that of the REMUS 100."""
    names = [field.name for field in dataclasses.fields(Hull) if field.type == "float"]
    factors = 2.0 ** np.random.default_rng([7, number]).uniform(-1.0, 1.0, len(names))
    hull = REMUS.coefficients
    changes = {name: getattr(hull, name) * factor for name, factor in zip(names, factors, strict=True)}
    return dataclasses.replace(REMUS, hull=dataclasses.replace(hull, **changes))
