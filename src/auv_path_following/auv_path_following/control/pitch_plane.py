"""The vertical plane of a hull as a planar hull, so that one autopilot serves heading and pitch.

Seen from the side a torpedo is what it is from above: up takes the place of starboard, pitch that of heading,
stern planes that of the rudder. A positive fin lowers the angle in both planes. The weight's restoring moment
is left out; to the controller it is a disturbance.
"""

from __future__ import annotations

import dataclasses

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Hull, Vehicle


def pitch_plane_of(vehicle: Vehicle) -> Vehicle:
    """Return the vehicle as its pitch autopilot sees it.

    Raises:
        ConfigurationError: the vehicle file has no stern planes, or no coefficients of heave and pitch.
    """
    hull = vehicle.coefficients
    if vehicle.sternplanes is None:
        raise ConfigurationError(f"{vehicle.name}: sternplanes", "nothing", "their largest angle and rate")
    if hull.vertical is None:
        raise ConfigurationError(
            f"{vehicle.name}: hull.vertical", "nothing", "coefficients of heave and pitch"
        )
    c = hull.vertical
    planar = Hull(
        m=hull.m,
        Izz=c.Iyy,
        Xuu=hull.Xuu,
        Xud=hull.Xud,
        Xvr=-c.Xwq,
        Xrr=c.Xqq,
        Yvv=c.Zww,
        Yvd=c.Zwd,
        Yrr=-c.Zqq,
        Yrd=-c.Zqd,
        Yur=-c.Zuq,
        Yuv=c.Zuw,
        Yuud=-c.Zuud,
        Nvv=-c.Mww,
        Nvd=-c.Mwd,
        Nrr=c.Mqq,
        Nrd=c.Mqd,
        Nur=c.Muq,
        Nuv=-c.Muw,
        Nuud=c.Muud,
        surge_coupling=hull.surge_coupling,
    )
    return dataclasses.replace(vehicle, rudder=vehicle.sternplanes, hull=planar, turning=None)
