"""The vertical plane of a hull as a planar hull, so that one autopilot serves heading and pitch.

Seen from the side a torpedo is what it is from above: up takes the place of starboard, pitch that of heading,
stern planes that of the rudder. A positive fin lowers the angle in both planes. The weight's restoring moment
is left out; to the controller it is a disturbance.
"""

from __future__ import annotations

import dataclasses

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.abilities import Cruise, Turning
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.nism import NismConfig
from auv_path_following.control.reference_model import ReferenceConfig
from auv_path_following.vehicle import Hull, Vehicle
from auv_path_following.vertical_hull import VerticalHull


def pitch_gains() -> AutopilotConfig:
    """Return the gains of the pitch autopilot that suit the REMUS 100."""
    gains = NismConfig(k1=0.4, k3=0.4, kp_from_rudder=True)
    return AutopilotConfig(nism=gains, reference=ReferenceConfig(enabled=True, bandwidth=1.0))


def pitch_plane_of(vehicle: Vehicle) -> Vehicle:
    """Return the vehicle as its pitch autopilot sees it.

    What was measured under `pitching` takes the place of a measured turn; its radius is that of a loop at the
    speed of cruise.

    Raises:
        ConfigurationError: the vehicle file has no stern planes.
    """
    if vehicle.sternplanes is None:
        raise ConfigurationError(f"{vehicle.name}: sternplanes", "nothing", "their largest angle and rate")
    hull, turning, measured = vehicle.hull, None, vehicle.pitching
    cruise = vehicle.cruise or Cruise(thrust=vehicle.thrust_max, speed=vehicle.top_speed)
    if measured is not None:
        turning = Turning(
            radius=cruise.speed / measured.rate,
            effect=measured.effect,
            divergence=measured.divergence,
            drift_time=measured.drift_time,
        )
    side = None if hull is None or hull.vertical is None else _seen_from_the_side(hull, hull.vertical)
    return dataclasses.replace(
        vehicle,
        rudder=vehicle.sternplanes,
        sternplanes=None,
        hull=side,
        cruise=cruise,
        turning=turning,
        pitching=None,
    )


def _seen_from_the_side(hull: Hull, c: VerticalHull) -> Hull:
    """Return the planar hull whose sway and yaw are heave and pitch."""
    return Hull(
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
