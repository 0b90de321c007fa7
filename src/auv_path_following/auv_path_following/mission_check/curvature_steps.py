"""Warns of joints at which the curvature steps further than the vehicle's yaw can follow."""

from __future__ import annotations

import math
from collections.abc import Iterator

from auv_path_following.control.nism import NismConfig, kp_of
from auv_path_following.control.reference_model import ReferenceConfig, limits_of
from auv_path_following.mission_check.finding import Finding, at
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle

#: Time in which guidance and heading reference recover a lost heading, s. Fitted to flights of the REMUS 100
#: in closed loop from one turn into the opposite one, at 1 to 2 m/s and radii of 8 and 12 m: within a fifth.
_RECOVERY = 6.2
#: Estimates above this are warned of, m. After several steps in a row the distance reached twice the
#: estimate, and a stretch counts as flown within 1 m.
_MOST = 0.65


def curvature_steps(mission: Mission, vehicle: Vehicle, speed: float) -> Iterator[Finding]:
    """Judge the steps of the curvature at joints where the course is continuous.

    At a step of kappa the yaw rate has to change by kappa U. With the acceleration a of the heading reference
    that takes kappa U/a, in which the vehicle loses (kappa U)^2/(2 a) of heading.

    Args:
        mission, vehicle: what is flown, and what flies it.
        speed: through the water, m/s.
    """
    if vehicle.hull is None:
        return
    joints = [joint for joint in mission.path.joints[: mission.once] if joint.geometric == "G1"]
    if not joints:
        return
    full = limits_of(ReferenceConfig(), vehicle, kp_of(NismConfig(kp_from_rudder=True), vehicle))
    # A rudder's moment grows with the square of the speed.
    acceleration = full.acceleration * min(1.0, (speed / vehicle.top_speed) ** 2)

    def distance(step: float) -> float:
        return (step * speed) ** 2 / (2.0 * acceleration) * speed * _RECOVERY

    wide = [joint for joint in joints if distance(joint.curvature_step) > _MOST]
    if not wide:
        return
    joint = max(wide, key=lambda one: abs(one.curvature_step))
    step, most = abs(joint.curvature_step), math.sqrt(_MOST / distance(1.0))
    others = f" (likewise at {len(wide) - 1} more)" if len(wide) > 1 else ""
    found = f"a step of the curvature by {step:.3f} 1/m (G1){others}"
    expected = (
        f"at most {most:.3f} 1/m at {speed:.2f} m/s, or the vehicle leaves the path by"
        f" {distance(step):.1f} m or more: a larger radius, a line between turns, clothoid or fermat"
    )
    yield Finding("warning", f"joint {joint.index} {at(joint.x, joint.y)}", found, expected)
