"""Hulls beside the shipped ones, for tests of what is derived from a hull."""

from __future__ import annotations

import dataclasses

import numpy as np

from auv_path_following import vehicle
from auv_path_following.vehicle import Hull, Rudder, Vehicle
from auv_path_following.vertical_hull import VerticalHull
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

#: Heave, roll and pitch of the REMUS 100 as Prestero (2001) prints them; the buoyancy is DSTO's.
PRINTED = VerticalHull(
    diameter=0.19,
    W=299.0, B=302.34, zg=0.0196, Ixx=0.177, Iyy=3.45, Xwq=-35.5, Xqq=-1.93, Ywp=35.5, Ypq=1.93, Zww=-131.0,
    Zqq=-0.632, Zuw=-28.6, Zuq=-5.22, Zvp=-35.5, Zrp=1.93, Zwd=-35.5, Zqd=-1.93, Zuud=-9.64, Kpp=-0.130,
    Kpd=-0.0704, Kprop=-0.141, Mww=3.18, Mqq=-188.0, Muw=24.0, Muq=-2.0, Mvp=-1.93, Mrp=4.86, Mwd=-1.93,
    Mqd=-4.88, Muud=-6.15, Nwp=-1.93, Npq=-4.86,
)  # fmt: skip
RADIUS = 0.5 * PRINTED.diameter  # m
#: The REMUS 100 with stern planes.
DIVER = dataclasses.replace(
    REMUS,
    hull=dataclasses.replace(REMUS.coefficients, vertical=PRINTED),
    sternplanes=Rudder(max_angle_deg=20.0, max_rate_deg_s=15.0),
)
SIX_DOF = remus_6dof_of(REMUS.coefficients, PRINTED, RADIUS)


def drawn(number: int) -> Vehicle:
    """Draw a hull whose every coefficient is between half and twice that of the REMUS 100."""
    names = [field.name for field in dataclasses.fields(Hull) if field.type == "float"]
    factors = 2.0 ** np.random.default_rng([7, number]).uniform(-1.0, 1.0, len(names))
    hull = REMUS.coefficients
    changes = {name: getattr(hull, name) * factor for name, factor in zip(names, factors, strict=True)}
    return dataclasses.replace(REMUS, hull=dataclasses.replace(hull, **changes))
