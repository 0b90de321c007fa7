"""Coefficients of a hull of which little is given: the REMUS 100 by similarity, bent to the given facts.

Forces scale with the water's mass and the length: with equal shape and equal lengths a second, all motions
are the same in lengths. Sway is damped less, as in the middle of torpedoes. Then drag takes the given speed,
the rudder the effect, given or that of hulls that turn alike, Nur the divergence, and the damping of turning
Nrr the given radii.
"""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.control.hull_model import HullModel, rudder_gain, slopes
from auv_path_following.hull_coefficients import Hull
from auv_path_following.thrust_units import Rows, interpolated, speed_between
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.new.owner_facts import (
    OwnerFacts,
    check_thrust_of_hull,
    displaced_mass,
    usual_diameter,
)

#: p L/u of a torpedo of which it is not measured.
DIVERGENCE = 1.2
#: b L^2/u^2 of a torpedo of which it is not measured: a factor times a power of L/(R delta), of a turn of
#: radius R with the rudder at delta (rad), and its range. A hull that turns wide has a weak rudder.
EFFECT, TURN_POWER, EFFECTS = 1.7, 0.7, (0.6, 2.0)
#: Sway damping over that of the REMUS 100 by similarity: sideslip of hulls that are stable in yaw settles
#: four times as slowly, so this is the middle.
SWAY_DAMPING = 0.4
#: Largest p times a given delay that is assumed, from this delay (s) on: what is unsteerable has no owner.
_STEERED, _FROM_DELAY = 0.2, 0.1
#: Drag over that of the REMUS 100 by similarity: beyond this range a thrust is taken for a slip.
_DRAG = (0.1, 12.0)
#: Powers of (mass, length) with which coefficients grow.
_POWERS: dict[tuple[float, float], tuple[str, ...]] = {
    (1.0, 0.0): ("m", "Xud", "Xvr", "Yvd", "Yur", "Nvv", "Nuv", "Nuud"),
    (1.0, 1.0): ("Xrr", "Yrr", "Yrd", "Nvd", "Nur"),
    (1.0, 2.0): ("Izz", "Nrr", "Nrd"),
    (1.0, -1.0): ("Xuu", "Yvv", "Yuv", "Yuud"),
}
#: Least damping of turning over that by similarity.
_LEAST_DAMPING = 0.05


class Assumed(NamedTuple):
    """Result.

    Attributes:
        hull: coefficients.
        table: thrust in the vehicle's unit, and N; empty where the unit is N.
        mass_ratio, length_ratio: over the REMUS 100.
    """

    hull: Hull
    table: Rows
    mass_ratio: float
    length_ratio: float


def assumed_hull(facts: OwnerFacts) -> Assumed:
    """Return coefficients for checked facts.

    Raises:
        ConfigurationError: no hull has this drag, or none turns like this.
    """
    remus = vehicle.load("remus100")
    mass = facts.mass
    if mass is None:
        stout = usual_diameter(facts.length) if facts.diameter is None else facts.diameter
        mass = displaced_mass(facts.length, stout)
    mu, size = mass / remus.coefficients.m, facts.length / remus.length
    hull = scaled(remus.coefficients, mu, size)
    hull = dataclasses.replace(hull, Yvv=SWAY_DAMPING * hull.Yvv, Yuv=SWAY_DAMPING * hull.Yuv)
    drag, table = _drag(facts, -hull.Xuu)
    hull = dataclasses.replace(hull, Xuu=-drag)
    hull = _with_effect(hull, facts)
    hull = _with_divergence(hull, facts)
    return Assumed(_with_radii(hull, facts), table, mu, size)


def scaled(hull: Hull, mu: float, size: float) -> Hull:
    """Return a hull by similarity; `mu` is the ratio of masses, `size` that of lengths."""
    changes = {
        name: getattr(hull, name) * mu**mass * size**length
        for (mass, length), names in _POWERS.items()
        for name in names
    }
    return dataclasses.replace(hull, **changes)


def _drag(facts: OwnerFacts, similar: float) -> tuple[float, Rows]:
    """Return the drag, kg/m, and the table of newtons; without given newtons both are by similarity."""
    thrust, speed = facts.speeds[-1]
    if facts.thrust_unit == "N" or facts.thrust_table:
        newtons = thrust if facts.thrust_unit == "N" else interpolated(facts.thrust_table, thrust)
        drag = newtons / speed**2
        check_thrust_of_hull(facts, newtons, *(share * similar * speed**2 for share in _DRAG))
        return drag, facts.thrust_table
    is_linear = facts.thrust_unit == "rpm"
    shares = sorted({0.25, 0.5, 0.75, 1.0} if is_linear else {1.0})
    thrusts = sorted({*(x for x, _ in facts.speeds), *(share * facts.thrust_max for share in shares)})
    rows = [(x, similar * speed_between(facts.speeds, x, is_linear) ** 2) for x in thrusts]
    return similar, tuple((round(x, 6), float(f"{newtons:.4g}")) for x, newtons in rows)


def _model(hull: Hull, facts: OwnerFacts) -> HullModel:
    rudder = vehicle.Rudder(max_angle_deg=facts.max_angle_deg, max_rate_deg_s=20.0)
    thrust, hull = -hull.Xuu * facts.speed**2, dataclasses.replace(hull, vertical=None)
    return HullModel(
        Vehicle(name=facts.name, length=facts.length, thrust_max=thrust, rudder=rudder, hull=hull)
    )


def effect_of(hull: Hull, facts: OwnerFacts) -> float:
    """Return b at the speed of design, 1/s^2."""
    return abs(rudder_gain(_model(hull, facts).sway_yaw, facts.speed)[1])


def divergence_of(hull: Hull, facts: OwnerFacts) -> float:
    """Return p at the speed of design, 1/s."""
    (vv, vr), (rv, rr) = slopes(_model(hull, facts).sway_yaw, facts.speed, 0.0, 0.0)
    middle, product = 0.5 * (vv + rr), vv * rr - vr * rv
    return middle + math.sqrt(max(middle * middle - product, 0.0))


def _with_effect(hull: Hull, facts: OwnerFacts) -> Hull:
    effect = facts.effect
    if effect is None:
        effect = _usual_effect(facts) * (facts.speed / facts.length) ** 2
    factor = effect / effect_of(hull, facts)
    return dataclasses.replace(hull, Yuud=factor * hull.Yuud, Nuud=factor * hull.Nuud)


def _usual_effect(facts: OwnerFacts) -> float:
    """Return b L^2/u^2 of torpedoes that turn like this."""
    if not facts.radii:
        return EFFECT
    angle, radius = facts.radii[-1]
    usual: float = EFFECT * (facts.length / (radius * math.radians(angle))) ** TURN_POWER
    return min(max(usual, EFFECTS[0]), EFFECTS[1])


def _with_divergence(hull: Hull, facts: OwnerFacts) -> Hull:
    """Return the hull with the Nur of the divergence, which grows with it."""
    aim = facts.divergence
    if aim is None:
        aim = DIVERGENCE * facts.speed / facts.length
        if facts.delay is not None and facts.delay > _FROM_DELAY:
            aim = min(aim, _STEERED / facts.delay)
    low, high = hull.Nur - 40.0 * abs(hull.Nur), hull.Nur + 20.0 * abs(hull.Nur)
    for _ in range(60):
        middle = 0.5 * (low + high)
        is_low = divergence_of(dataclasses.replace(hull, Nur=middle), facts) < aim
        low, high = (middle, high) if is_low else (low, middle)
    found = divergence_of(dataclasses.replace(hull, Nur=low), facts)
    if abs(found - aim) > 0.05 * max(abs(aim), facts.speed / facts.length):
        size = facts.speed / facts.length
        raise ConfigurationError(
            "--divergence", f"{aim:g} 1/s", f"a torpedo's, such as {-1.0 * size:.2g} to {2.0 * size:.2g} 1/s"
        )
    return dataclasses.replace(hull, Nur=low)


def _with_radii(hull: Hull, facts: OwnerFacts) -> Hull:
    """Return the hull with the damping of turning that gives the radii; Nur too where they are several.

    In a steady turn the yaw row is linear in Nrr and Nur: Nrr p^2 + Nur p = -(Nvv n|n| + Nuv n + Nuud delta).
    """
    if not facts.radii:
        return hull
    rows, rights = [], []
    for angle, radius in facts.radii:
        _, p, rest = _turn(hull, math.radians(angle), radius)
        rows.append((p * p, p))
        rights.append(-rest)
    A, y = np.array(rows), np.array(rights)
    similar = hull.Nrr
    if len(rows) > 1 and facts.divergence is None:
        weight = 1.0 / np.abs(y)
        Nrr, Nur = np.linalg.lstsq(A * weight[:, None], y * weight, rcond=None)[0].tolist()
        hull = dataclasses.replace(hull, Nrr=min(Nrr, _LEAST_DAMPING * similar), Nur=Nur)
    else:
        Nrr = float((y[-1] - A[-1, 1] * hull.Nur) / A[-1, 0])
        if Nrr > _LEAST_DAMPING * similar and facts.divergence is None:
            return _with_less_stability(hull, facts)
        hull = dataclasses.replace(hull, Nrr=min(Nrr, _LEAST_DAMPING * similar))
    _check_radii(hull, facts)
    return hull


def _with_less_stability(hull: Hull, facts: OwnerFacts) -> Hull:
    """Return a hull that turns tighter than its rudder alone would make it: least damping, another Nur."""
    hull = dataclasses.replace(hull, Nrr=_LEAST_DAMPING * hull.Nrr)
    angle, radius = facts.radii[-1]
    _, p, rest = _turn(hull, math.radians(angle), radius)
    hull = dataclasses.replace(hull, Nur=-(rest + hull.Nrr * p * p) / p)
    _check_radii(hull, facts)
    return hull


def _turn(hull: Hull, angle: float, radius: float) -> tuple[float, float, float]:
    """Return drift n, p = r/ur and the yaw moment over ur^2 without Nrr and Nur, in a turn to starboard."""
    h, p = hull, 1.0 / radius
    n = 0.0
    for _ in range(20):
        p = math.hypot(1.0, n) / radius
        SY = h.Yrr * p * p + (h.Yur - h.m) * p - h.Yuud * angle
        size = (h.Yuv + math.sqrt(h.Yuv * h.Yuv - 4.0 * h.Yvv * abs(SY))) / (-2.0 * h.Yvv)
        n = math.copysign(size, SY)
    return n, p, h.Nvv * n * abs(n) + h.Nuv * n - h.Nuud * angle


def _check_radii(hull: Hull, facts: OwnerFacts) -> None:
    """Check that the hull turns as it should, and is no more unstable than a torpedo can be.

    Raises:
        ConfigurationError: it does not.
    """
    size = facts.speed / facts.length
    angle, radius = facts.radii[-1]
    divergence = divergence_of(hull, facts)
    found = f"{radius:g} m at {angle:g} deg"
    if not -4.0 * size < divergence < 3.5 * size:
        before = "".join(f"{turn:g} m at {at:g} deg, " for at, turn in facts.radii[:-1])
        found = f"{before}{found}: a divergence of {divergence:.2g} 1/s"
        raise ConfigurationError("--radius", found, "turns of a torpedo of this length")
    ur, drift, rate = _model(hull, facts).steady_motion(-hull.Xuu * facts.speed**2, math.radians(angle))
    turned = math.hypot(ur, drift) / rate
    if abs(turned - radius) > 0.15 * radius:
        raise ConfigurationError("--radius", found, f"about {turned:.3g} m, by the other facts")
