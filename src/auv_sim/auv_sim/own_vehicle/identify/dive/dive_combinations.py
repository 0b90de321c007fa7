"""The 14 combinations of heave and pitch that motion data can show: Eqs. (3D-3), (3D-4) near level roll."""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple

import numpy as np

from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import GRAVITY, Hull
from auv_path_following.vertical_hull import VerticalHull
from auv_sim.own_vehicle.identify.combinations import Prior

#: Where a vehicle's file has no coefficient of heave or pitch, it is that of this vehicle, scaled.
DIVING_REFERENCE = "remus100_6dof_corrected"


class DiveCombinations(NamedTuple):
    """Accelerations of heave (Z) and pitch (M) for each unit of a product.

    Attributes:
        Zww, Zqq, Zuq, Zuw, Zuud: heave acceleration by w|w| (1/m), q|q| (m), u q, u w (1/m), u^2 delta (1/m).
        Zcos, Zsin: by the cosine and the sine of the pitch, m/s^2: buoyancy.
        Mww, Mqq, Muq, Muw, Muud: pitch acceleration by the same: 1/m^2, 1, 1/m, 1/m^2, 1/m^2.
        Mcos, Msin: 1/s^2: centre of gravity ahead and below, the righting moment.
    """

    Zww: Any
    Zqq: Any
    Zuq: Any
    Zuw: Any
    Zuud: Any
    Zcos: Any
    Zsin: Any
    Mww: Any
    Mqq: Any
    Muq: Any
    Muw: Any
    Muud: Any
    Mcos: Any
    Msin: Any


DIVE_SYMBOLS = tuple(f"{name}'" for name in DiveCombinations._fields)
DIVE_UNITS = (
    "1/m", "m", "-", "1/m", "1/m", "m/s^2", "m/s^2", "1/m^2", "-", "1/m", "1/m^2", "1/m^2", "1/s^2", "1/s^2",
)  # fmt: skip
#: Powers of the log's scale by which the combinations are multiplied when u and w are read too large by it.
DIVE_SCALE_POWERS = np.array([-1, 1, 0, -1, -1, 1, 1, -2, 0, -1, -2, -2, 0, 0], float)

_NEEDED = (
    "Zww", "Zqq", "Zuw", "Zuq", "Zwd", "Zqd", "Zuud", "Mww", "Mqq", "Muw", "Muq", "Mwd", "Mqd", "Muud", "Iyy",
    "W", "B", "xg", "zg",
)  # fmt: skip


def dive_combinations_of(m: float, vertical: VerticalHull) -> DiveCombinations:
    """Return the combinations of a hull of this mass (kg)."""
    return _combined({name: getattr(vertical, name) for name in _NEEDED} | {"m": m})


def _combined(c: dict[str, Any]) -> DiveCombinations:
    heave, pitch = c["m"] - c["Zwd"], c["Iyy"] - c["Mqd"]
    upper, lower = -c["m"] * c["xg"] - c["Zqd"], -c["m"] * c["xg"] - c["Mwd"]
    determinant = heave * pitch - upper * lower
    zero = 0.0 * c["m"]
    Z = [c["Zww"], c["Zqq"], c["Zuq"] + c["m"], c["Zuw"], c["Zuud"], c["W"] - c["B"], zero]
    M = [
        c["Mww"], c["Mqq"], c["Muq"] - c["m"] * c["xg"], c["Muw"], c["Muud"], -c["xg"] * c["W"],
        -c["zg"] * c["W"],
    ]  # fmt: skip
    return DiveCombinations(
        *((pitch * z - upper * m) / determinant for z, m in zip(Z, M, strict=True)),
        *((heave * m - lower * z) / determinant for z, m in zip(Z, M, strict=True)),
    )


def vertical_with(combinations: DiveCombinations, m: float, assumed: VerticalHull) -> VerticalHull:
    """Return coefficients of a hull that moves by these combinations, with the masses of another one.

    Weight, inertia and added masses are assumed; buoyancy and the place of the centre of gravity follow. A
    coefficient whose sign the vehicle file prescribes and the data contradict is held at a thousandth of the
    assumed one.

    Args:
        combinations: of the hull.
        m: its mass, kg.
        assumed: the source of the masses.
    """
    c, v = combinations, assumed
    # xg has a share in the mass matrix: a few steps settle it.
    xg = v.xg
    for _ in range(5):
        heave, pitch = m - v.Zwd, v.Iyy - v.Mqd
        upper, lower = -m * xg - v.Zqd, -m * xg - v.Mwd
        Z = [heave * z + upper * y for z, y in zip(c[:7], c[7:], strict=True)]
        M = [lower * z + pitch * y for z, y in zip(c[:7], c[7:], strict=True)]
        xg = -M[5] / v.W
    found = {
        "Zww": Z[0], "Zqq": Z[1], "Zuq": Z[2] - m, "Zuw": Z[3], "Zuud": Z[4], "B": v.W - Z[5],
        "Mww": M[0], "Mqq": M[1], "Muq": M[2] + m * xg, "Muw": M[3], "Muud": M[4],
        "xg": xg, "zg": -M[6] / v.W,
    }  # fmt: skip
    for name in ("Zww", "Zuud", "Mqq", "Muud"):
        found[name] = min(found[name], 1e-3 * getattr(v, name))
    found["zg"] = max(found["zg"], 1e-3 * v.zg)
    values: dict[str, Any] = {name: float(value) for name, value in found.items()}
    return dataclasses.replace(v, **values)


#: Standard deviations before any data: of the buoyancy, a share of the weight (from fresh water to the sea it
#: grows by 2.6 %), and of the centre of gravity ahead, a share of its depth below.
BUOYANCY, AHEAD = 0.03, 0.3
#: Draws of a prior, and the factor on their spread. It is wide so that the data decide: half of it changes
#: the median errors of six drawn divers in two minutes by less than 3 %.
_DRAWS, _WIDENED = 3000, 3.0


#: Powers of length with which the coefficients of similar hulls grow.
_POWERS = {
    "diameter": 1, "W": 3, "B": 3, "xg": 1, "zg": 1, "Ixx": 5, "Iyy": 5,
    "Xwq": 3, "Xqq": 4, "Ywp": 3, "Ypq": 4,
    "Zww": 2, "Zqq": 4, "Zuw": 2, "Zuq": 3, "Zvp": 3, "Zrp": 4, "Zwd": 3, "Zqd": 4, "Zuud": 2,
    "Kpp": 5, "Kup": 4, "Kpd": 5, "Kprop": 1,
    "Mww": 3, "Mqq": 5, "Muw": 3, "Muq": 4, "Mvp": 4, "Mrp": 5, "Mwd": 4, "Mqd": 5, "Muud": 3,
    "Nwp": 4, "Npq": 5,
}  # fmt: skip


def scaled_vertical(vertical: VerticalHull, ratio: float) -> VerticalHull:
    """Return a hull of the same shape and density.

    Args:
        vertical: a known one.
        ratio: of the lengths, the new one over the known one.
    """
    values: dict[str, Any] = {name: getattr(vertical, name) * ratio**power for name, power in _POWERS.items()}
    return dataclasses.replace(vertical, **values)


def _similar(vertical: VerticalHull) -> VerticalHull:
    """Return the REMUS 100 scaled to the weight of another hull."""
    reference = vehicle_file.load(DIVING_REFERENCE).coefficients.vertical
    assert reference is not None
    return scaled_vertical(reference, (vertical.W / reference.W) ** (1.0 / _POWERS["W"]))


def dive_prior_of(hull: Hull, vertical: VerticalHull, seed: int = 0) -> Prior:
    """Return what is assumed before any data: the combinations of a known hull, with a wide covariance.

    It is that of hulls with each coefficient within a factor of two, with three times their spread. A
    coefficient that a file leaves at 0 is drawn around that of the REMUS 100, scaled to the same weight.

    Args:
        hull, vertical: a known hull of about this size.
        seed: of the draws.
    """
    generator = np.random.default_rng(seed)
    similar = _similar(vertical)
    values: dict[str, Any] = {}
    for name in _NEEDED:
        largest = 0.3 if name in ("Iyy", "W") else 1.0
        value = getattr(vertical, name) or getattr(similar, name)
        values[name] = value * 2.0 ** generator.uniform(-largest, largest, _DRAWS)
    values["m"] = values["W"] / GRAVITY
    values["B"] = (
        values["W"] + (vertical.B - vertical.W) + BUOYANCY * vertical.W * generator.normal(size=_DRAWS)
    )
    values["xg"] = vertical.xg + AHEAD * vertical.zg * generator.normal(size=_DRAWS)
    drawn = np.array(_combined(values))
    root = np.linalg.cholesky(np.cov(drawn) * _WIDENED**2 + 1e-12 * np.eye(len(drawn)))
    return Prior(drawn.mean(axis=1), np.asarray(root, float))
