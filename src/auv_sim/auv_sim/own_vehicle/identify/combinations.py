"""The 14 combinations of planar coefficients that motion data can show: Eqs. (18), (19) by their masses.

Dividing Eq. (19) by the mass matrix of Eq. (18) gives accelerations. Masses and added masses are not
separable from them, so a hull is written back with assumed masses and moves the same.
"""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import Hull

#: Where a vehicle's file has no coefficients, they are those of this vehicle, scaled.
REFERENCE = "remus100"
Numbers = NDArray[np.float64]


class Combinations(NamedTuple):
    """Accelerations for each unit of a product of velocities; `mx` is m - Xud.

    Attributes:
        X1: 1/mx, m/s^2 for each unit of thrust.
        Xuu: Xuu/mx, 1/m.
        Xvr: (Xvr + m)/mx.
        Xrr: Xrr/mx, m.
        Yvv, Yrr, Yur, Yuv, Yuud: sway acceleration by v|v| (1/m), r|r| (m), u r, u v (1/m), u^2 delta (1/m).
        Nvv, Nrr, Nur, Nuv, Nuud: yaw acceleration by the same: 1/m^2, 1, 1/m, 1/m^2, 1/m^2.
    """

    X1: Any
    Xuu: Any
    Xvr: Any
    Xrr: Any
    Yvv: Any
    Yrr: Any
    Yur: Any
    Yuv: Any
    Yuud: Any
    Nvv: Any
    Nrr: Any
    Nur: Any
    Nuv: Any
    Nuud: Any


#: How many.
COUNT = len(Combinations._fields)
#: As they are printed.
SYMBOLS = (
    "1/mx", "Xuu/mx", "(Xvr+m)/mx", "Xrr/mx", "Yvv'", "Yrr'", "Yur'", "Yuv'", "Yuud'",
    "Nvv'", "Nrr'", "Nur'", "Nuv'", "Nuud'",
)  # fmt: skip
UNITS = (
    "1/kg", "1/m", "-", "m", "1/m", "m", "-", "1/m", "1/m", "1/m^2", "-", "1/m", "1/m^2", "1/m^2",
)  # fmt: skip
#: Powers of the log's scale by which the combinations are multiplied when u and v are read too large by it.
SCALE_POWERS = np.array([1, -1, 0, 1, -1, 1, 0, -1, -1, -2, 0, -1, -2, -2], float)


def combinations_of(hull: Hull) -> Combinations:
    """Return the combinations of a hull."""
    values = {field.name: getattr(hull, field.name) for field in dataclasses.fields(hull)}
    return _combined(values, hull.surge_coupling)


def _combined(c: dict[str, Any], surge_coupling: bool) -> Combinations:
    """Return the combinations of coefficients by name: numbers, or arrays of many hulls."""
    mx = c["m"] - c["Xud"]
    sway, yaw = c["m"] - c["Yvd"], c["Izz"] - c["Nrd"]
    determinant = sway * yaw - c["Yrd"] * c["Nvd"]
    Y = [c["Yvv"], c["Yrr"], c["Yur"] - c["m"], c["Yuv"], c["Yuud"]]
    N = [c["Nvv"], c["Nrr"], c["Nur"], c["Nuv"], c["Nuud"]]
    return Combinations(
        1.0 / mx,
        c["Xuu"] / mx,
        (c["Xvr"] + (c["m"] if surge_coupling else 0.0)) / mx,
        c["Xrr"] / mx,
        *((yaw * y + c["Yrd"] * n) / determinant for y, n in zip(Y, N, strict=True)),
        *((c["Nvd"] * y + sway * n) / determinant for y, n in zip(Y, N, strict=True)),
    )


def hull_with(combinations: Combinations, assumed: Hull) -> Hull:
    """Return a hull that moves by these combinations, with the masses of another one.

    Mass, moment of inertia and the added masses of sway and yaw are assumed. The added mass ahead follows
    from 1/mx. A coefficient whose sign the vehicle file prescribes and the data contradict is held at a
    thousandth of the assumed one.

    Args:
        combinations: of the hull.
        assumed: the source of the masses.
    """
    c, h = combinations, assumed
    mx = 1.0 / c.X1
    sway, yaw = h.m - h.Yvd, h.Izz - h.Nrd
    Y = [sway * y - h.Yrd * n for y, n in zip(c[4:9], c[9:14], strict=True)]
    N = [-h.Nvd * y + yaw * n for y, n in zip(c[4:9], c[9:14], strict=True)]
    found = {
        "Xud": h.m - mx, "Xuu": c.Xuu * mx, "Xvr": c.Xvr * mx - h.m, "Xrr": c.Xrr * mx,
        "Yvv": Y[0], "Yrr": Y[1], "Yur": Y[2] + h.m, "Yuv": Y[3], "Yuud": Y[4],
        "Nvv": N[0], "Nrr": N[1], "Nur": N[2], "Nuv": N[3], "Nuud": N[4],
    }  # fmt: skip
    for name in ("Xuu", "Yvv", "Nrr", "Nuud"):
        found[name] = min(found[name], 1e-3 * getattr(h, name))
    values: dict[str, Any] = {name: float(value) for name, value in found.items()}
    return dataclasses.replace(h, surge_coupling=True, **values)


#: Powers of length with which the coefficients of similar hulls grow.
_POWERS = {
    "m": 3, "Izz": 5, "Xuu": 2, "Xud": 3, "Xvr": 3, "Xrr": 4, "Yvv": 2, "Yvd": 3, "Yrr": 4, "Yrd": 4,
    "Yur": 3, "Yuv": 2, "Yuud": 2, "Nvv": 3, "Nvd": 4, "Nrr": 5, "Nrd": 5, "Nur": 4, "Nuv": 3, "Nuud": 3,
}  # fmt: skip


def scaled_hull(hull: Hull, ratio: float) -> Hull:
    """Return a planar hull of the same shape and density.

    Args:
        hull: a known one.
        ratio: of the lengths, the new one over the known one.
    """
    values: dict[str, Any] = {name: getattr(hull, name) * ratio**power for name, power in _POWERS.items()}
    return dataclasses.replace(hull, vertical=None, **values)


class Prior(NamedTuple):
    """A normal distribution of the combinations: mean (14,), and a root of the covariance (14, 14)."""

    mean: Numbers
    root: Numbers


#: Draws of hulls that make a prior, and the factor on their spread.
_DRAWS, _WIDENED = 3000, 1.5
#: Coefficients that inertia bounds: within the square root of the factor of two of all others.
_INERTIA = ("m", "Izz")


#: Coefficients of sway and yaw without inertia in them, and how many times as large as that of a similar
#: REMUS 100 each may be: where a known one is smaller, the prior has the difference as a further deviation.
#: REMUS 100 damps its yaw rate little: Nur of eight other makes is 2 to 27 times as large, the median 5.
_DAMPING = {"Yvv": 1.0, "Yrr": 1.0, "Yur": 1.0, "Yuv": 1.0, "Nvv": 1.0, "Nrr": 1.0, "Nur": 6.0, "Nuv": 1.0}


def prior_of(hull: Hull, seed: int = 0) -> Prior:
    """Return what is assumed before any data: each coefficient of a similar hull within a factor of two.

    A coefficient that a file leaves at 0 is drawn around that of the REMUS 100, scaled to the same mass. One
    of damping may also be as large as that one, and Nur six times as large.

    Args:
        hull: a known one of about this size: see `scaled_hull`.
        seed: of the draws.
    """
    reference = vehicle_file.load(REFERENCE).coefficients
    similar = scaled_hull(reference, (hull.m / reference.m) ** (1.0 / _POWERS["m"]))
    generator = np.random.default_rng(seed)
    values: dict[str, Any] = {}
    missing: dict[str, float] = {}
    for field in dataclasses.fields(hull):
        value = getattr(hull, field.name)
        if isinstance(value, float):
            usual = getattr(similar, field.name)
            value = value or usual
            exponent = 0.5 if field.name in _INERTIA else 1.0
            values[field.name] = value * 2.0 ** generator.uniform(-exponent, exponent, _DRAWS)
            largest = _DAMPING.get(field.name, 0.0) * abs(usual)
            if abs(value) < largest:
                missing[field.name] = largest - abs(value)
    for name, width in missing.items():
        values[name] = values[name] + width * generator.normal(size=_DRAWS)
    drawn = np.array(_combined(values, hull.surge_coupling))
    root = np.linalg.cholesky(np.cov(drawn) * _WIDENED**2)
    return Prior(drawn.mean(axis=1), np.asarray(root, float))
