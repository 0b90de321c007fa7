"""The identified vehicle as a file: planar coefficients and rudder with their intervals as comments."""

from __future__ import annotations

import dataclasses
import json
import math
from typing import Any

from auv_path_following.abilities import DepthRange
from auv_path_following.vehicle import Hull, Rudder, Vehicle
from auv_sim.own_vehicle.identify.combinations import hull_with
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.intervals import REACH, gradient_of
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, HALF_PLAY, RATE, typed

#: Coefficients that the data do not show, taken from the known hull.
_ASSUMED = ("m", "Izz", "Yvd", "Yrd", "Nvd", "Nrd")


def identified_text(vehicle: Vehicle, known: Hull, found: Identified, source: str) -> str:
    """Return the vehicle file.

    Args:
        vehicle: identified.
        known: the source of the masses.
        found: its identification.
        source: names of the recordings.
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
        "\n".join([*rows, *_rudder(vehicle.rudder, found), *_planes(vehicle), *_hull(vehicle, known, found)])
        + "\n"
    )


def _text(name: str) -> str:
    return json.dumps(name, ensure_ascii=False)


def _rudder(rudder: Rudder, found: Identified) -> list[str]:
    sd = found.spread.deviations
    play = 2.0 * math.degrees(max(found.physical[HALF_PLAY], 0.0))
    off = 2.0 * math.degrees(REACH * sd[HALF_PLAY])
    return [
        f"rudder:  # in a sea file: {{dead_band_deg: {math.degrees(found.dead_band):.2g}, "
        f"backlash_deg: {play:.2g}}}, the latter +- {off:.1g}",
        f"  max_angle_deg: {_value(rudder.max_angle_deg)}",
        f"  max_rate_deg_s: {_value(rudder.max_rate_deg_s)}  # +- {math.degrees(REACH * sd[RATE]):.2g}",
        f"  dead_time: {_value(rudder.dead_time)}  # s, +- {REACH * sd[DEAD_TIME]:.1g}",
    ]


def _planes(vehicle: Vehicle) -> list[str]:
    """Return stern planes, depth, and pitching with the speed at which it was measured."""
    rows: list[str] = []
    for name in ("sternplanes", "depth", "cruise", "pitching"):
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
    if hull.vertical is not None:
        rows += ["  vertical:  # masses as assumed", *_mapping(hull.vertical, "    ")]
    return rows


def _interval(name: str, value: float, known: Hull, found: Identified) -> str:
    """Return the 95 % interval of a coefficient, with the assumed masses."""
    gradient = gradient_of(
        lambda p: float(getattr(hull_with(typed(p), known), name)), found.physical, found.spread
    )
    off = REACH * found.spread.total(gradient)
    share = 100.0 * off / abs(value) if value else math.inf
    return f"+- {off:.2g}" + (f" ({share:.0f} %)" if share < 100.0 else " (x2): not known from these data")
