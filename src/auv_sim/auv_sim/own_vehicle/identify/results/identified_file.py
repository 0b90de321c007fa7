"""The identified vehicle as a file: coefficients and fins with their intervals as comments."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Callable
from functools import partial
from typing import Any

from auv_path_following.abilities import DepthRange
from auv_path_following.vehicle import Hull, Rudder, Vehicle
from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers, hull_with
from auv_sim.own_vehicle.identify.dive.dive_combinations import DiveCombinations, vertical_with
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.intervals import REACH, gradient_of
from auv_sim.own_vehicle.identify.results.dive_tables import weight_less_buoyancy
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, HALF_PLAY, RATE, typed

#: Coefficients that the data do not show, taken from the known hull.
_ASSUMED = ("m", "Izz", "Yvd", "Yrd", "Nvd", "Nrd")
#: Coefficients of heave and pitch that the data show.
_OF_DIVE = ("zg", "Zww", "Zqq", "Zuw", "Zuq", "Zuud", "Mww", "Mqq", "Muw", "Muq", "Muud")


def identified_text(
    vehicle: Vehicle, known: Hull, found: Identified, source: str, dive: Identified | None = None
) -> str:
    """Return the vehicle file.

    Args:
        vehicle: identified.
        known: the source of the masses.
        found: its identification.
        source: names of the recordings.
        dive: identification of heave and pitch, if there is one.
    """
    rows = [
        f"# Identified from {' '.join(source.split())}.",
        "# Comments are 95 % intervals. They include what no recording shows: the scale of the log, the bias",
        "# of the thrust. Masses are assumed; the hull moves by the identified accelerations in any case.",
        "# (x2) is the factor within which a coefficient is assumed that these data do not show.",
        f"name: {_text(vehicle.name)}",
        f"length: {_value(vehicle.length)}  # m",
        f"thrust_max: {_value(vehicle.thrust_max)}  # {vehicle.thrust_symbol}",
    ]
    if vehicle.thrust_unit != "N":
        rows += [
            f"thrust_unit: {vehicle.thrust_unit}",
            f"thrust_table: {_value(vehicle.thrust_table)}  # {vehicle.thrust_unit}, N",
        ]
    return (
        "\n".join(
            [
                *rows,
                *_rudder(vehicle.rudder, found),
                *_planes(vehicle, dive),
                *_hull(vehicle, known, found),
                *_vertical(vehicle.coefficients, known, dive),
            ]
        )
        + "\n"
    )


def _text(name: str) -> str:
    return json.dumps(name, ensure_ascii=False)


def _rudder(rudder: Rudder, found: Identified) -> list[str]:
    play = 2.0 * math.degrees(max(found.physical[HALF_PLAY], 0.0))
    off = 2.0 * math.degrees(REACH * found.spread.deviations[HALF_PLAY])
    return [
        f"rudder:  # in a sea file: {{dead_band_deg: {math.degrees(found.dead_band):.2g}, "
        f"backlash_deg: {play:.2g}}}, the latter +- {off:.1g}",
        f"  max_angle_deg: {_value(rudder.max_angle_deg)}",
        *_servo(rudder, found),
    ]


def _servo(fin: Rudder, found: Identified) -> list[str]:
    """Return rate and dead time of the fin that was identified."""
    sd = found.spread.deviations
    return [
        f"  max_rate_deg_s: {_value(fin.max_rate_deg_s)}  # +- {math.degrees(REACH * sd[RATE]):.2g}",
        f"  dead_time: {_value(fin.dead_time)}  # s, +- {REACH * sd[DEAD_TIME]:.1g}",
    ]


def _planes(vehicle: Vehicle, dive: Identified | None) -> list[str]:
    """Return stern planes, depth, and pitching with the speed at which it was measured."""
    rows: list[str] = []
    planes = vehicle.sternplanes
    if planes is not None and dive is not None:
        rows = ["sternplanes:", f"  max_angle_deg: {_value(planes.max_angle_deg)}", *_servo(planes, dive)]
    for name in ("depth", "cruise", "pitching") if rows else ("sternplanes", "depth", "cruise", "pitching"):
        part = getattr(vehicle, name)
        if part is not None and (vehicle.dives or part != DepthRange()):
            rows += [f"{name}:", *_mapping(part, "  ")]
    return rows


def _mapping(part: Any, indent: str) -> list[str]:
    values = ((field.name, getattr(part, field.name)) for field in dataclasses.fields(part))
    return [f"{indent}{name}: {_value(value)}" for name, value in values if value is not None]


def _value(value: Any) -> str:
    """Return a value as YAML that is read as the same value."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(value).removesuffix(".0")


def _hull(vehicle: Vehicle, known: Hull, found: Identified) -> list[str]:
    hull, rows = vehicle.coefficients, ["hull:  # SI units, radians"]
    for field in dataclasses.fields(hull):
        value = getattr(hull, field.name)
        if isinstance(value, float) and not isinstance(value, bool):
            note = "assumed" if field.name in _ASSUMED else _interval(field.name, value, known, found)
            rows.append(f"  {field.name}: {_value(value)}  # {note}")
    rows.append("  surge_coupling: true")
    return rows


def _vertical(hull: Hull, known: Hull, dive: Identified | None) -> list[str]:
    """Return the coefficients of heave, roll and pitch, with intervals where a dive was identified."""
    if hull.vertical is None:
        return []
    if dive is None or known.vertical is None:
        return ["  vertical:  # as assumed", *_mapping(hull.vertical, "    ")]
    buoyancy = weight_less_buoyancy(dive, known, known.vertical)
    rows = ["  vertical:"]
    for field in dataclasses.fields(hull.vertical):
        value, note = getattr(hull.vertical, field.name), "assumed"
        if field.name == "B":
            note = f"+- {REACH * math.hypot(buoyancy.statistical, buoyancy.systematic):.2g}"
        elif field.name == "xg":
            note = f"+- {_half_width(partial(_coefficient, field.name, known), dive):.2g}"
        elif field.name in _OF_DIVE:
            note = _noted(value, _half_width(partial(_coefficient, field.name, known), dive))
        rows.append(f"    {field.name}: {_value(value)}  # {note}")
    return rows


def _coefficient(name: str, known: Hull, physical: Numbers) -> float:
    """Return a coefficient of heave or pitch of identified combinations, with the assumed masses."""
    assert known.vertical is not None
    c = DiveCombinations(*map(float, physical[:COUNT]))
    return float(getattr(vertical_with(c, known.m, known.vertical), name))


def _interval(name: str, value: float, known: Hull, found: Identified) -> str:
    """Return the 95 % interval of a coefficient, with the assumed masses."""
    return _noted(value, _half_width(lambda p: float(getattr(hull_with(typed(p), known), name)), found))


def _half_width(function: Callable[[Numbers], float], found: Identified) -> float:
    """Return half the width of the 95 % interval of a function of the unknowns."""
    return REACH * found.spread.total(gradient_of(function, found.physical, found.spread))


def _noted(value: float, off: float) -> str:
    """Return half the width of an interval as a comment from which `tune` and `prove` draw."""
    share = 100.0 * off / abs(value) if value else math.inf
    return f"+- {off:.2g}" + (f" ({share:.0f} %)" if share < 100.0 else " (x2): not known from these data")
