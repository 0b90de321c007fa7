"""The text of a vehicle file, with the source and the uncertainty of every number as a comment."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

from auv_path_following.abilities import DepthRange
from auv_path_following.hull_coefficients import Hull
from auv_path_following.thrust_units import SYMBOLS, Rows
from auv_sim.own_vehicle.new.assumed_hull import Assumed, effect_of
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts

#: What is written where it is not given.
USUAL_RATE, USUAL_DELAY = 15.0, 0.05
#: Factors within which torpedoes of one length, speed and radius lie: the rudder's effect b, the damping of
#: sway, and any other coefficient.
EFFECT_FACTOR, SWAY_FACTOR, FACTOR = 2.0, 3.0, 2.0
#: Coefficients that turn with the rudder's effect, the divergence and the radii.
_BY_RUDDER = ("Yuud", "Nuud", "Zuud", "Muud")
_MASSES = ("m", "W", "B")


def text_of(facts: OwnerFacts, assumed: Assumed, hull: Hull, depth: DepthRange | None, advice: str) -> str:
    """Return the file's text.

    Args:
        facts: given by the owner.
        assumed: the hull by similarity.
        hull: the same with vertical coefficients where it dives.
        depth: range of depth of a vehicle that dives.
        advice: what is most worth measuring, one line.
    """
    return "\n".join(_lines(facts, assumed, hull, depth, advice)) + "\n"


def _lines(
    f: OwnerFacts, assumed: Assumed, hull: Hull, depth: DepthRange | None, advice: str
) -> Iterator[str]:
    yield f"# {f.name}, written by scripts/vehicle.py new. A number marked `assumed` was not given: it is"
    yield "# that of the REMUS 100 by similarity, bent to what was given; in brackets the factor within which"
    yield "# it may be wrong."
    yield f"# {advice}"
    yield f"name: {_quoted(f.name)}"
    yield f"length: {f.length:g}  # m"
    yield f"thrust_max: {f.thrust_max:g}  # {SYMBOLS[f.thrust_unit]}"
    if f.thrust_unit != "N":
        source = "" if f.thrust_table else f"; assumed (x{FACTOR:g}), from the drag of similar hulls"
        yield f"thrust_unit: {f.thrust_unit}"
        yield f"thrust_table: {_rows(assumed.table)}  # {SYMBOLS[f.thrust_unit]}, N{source}"
    yield from _fin("rudder", f.max_angle_deg, f.rate_deg_s, f.delay)
    if depth is not None and f.planes_deg is not None:
        yield from _fin("sternplanes", f.planes_deg, f.planes_rate_deg_s or f.rate_deg_s, f.delay)
        yield "depth:"
        yield f"  max: {depth.max:g}  # m; assumed: put in what your hull withstands"
        yield f"  surface: {depth.surface:g}  # m; assumed"
        yield f"  minimum_speed: {depth.minimum_speed:g}  # m/s; assumed: from there on planes hold the depth"
    yield from _measured(f)
    yield f"assumed_within: {EFFECT_FACTOR:g}  # the rule's gains allow for it; `identify` leaves it out"
    yield "hull:  # SI units, radians; names as in Table 2 of the paper"
    yield from _coefficients(f, hull, "  ")
    if hull.vertical is not None:
        yield "  vertical:  # all assumed (x2) unless marked otherwise"
        yield from _coefficients(f, hull.vertical, "    ")


def _fin(key: str, angle: float, rate: float | None, delay: float | None) -> Iterator[str]:
    yield f"{key}:"
    yield f"  max_angle_deg: {angle:g}"
    source = f"  # assumed (x{FACTOR:g})" if rate is None else ""
    yield f"  max_rate_deg_s: {USUAL_RATE if rate is None else rate:g}{source}"
    source = (
        "  # s; assumed: 0.02 to 0.3 s" if delay is None else "  # s, from a command to the start of the fin"
    )
    yield f"  dead_time: {USUAL_DELAY if delay is None else delay:g}{source}"


def _measured(f: OwnerFacts) -> Iterator[str]:
    thrust, speed = f.speeds[-1]
    yield "cruise:"
    yield f"  thrust: {thrust:g}  # {SYMBOLS[f.thrust_unit]}"
    yield f"  speed: {speed:g}  # m/s"
    if len(f.speeds) > 1:
        yield f"  speeds: {_rows(f.speeds)}  # {SYMBOLS[f.thrust_unit]}, m/s"
    if f.radii:
        angle, radius = f.radii[-1]
        is_full = abs(angle - f.max_angle_deg) < 1e-9
        less = f.radii[:-1] if is_full else f.radii
        if is_full:
            yield "turning:"
            yield f"  radius: {radius:g}  # m, with full rudder"
            if less:
                yield f"  radii: {_rows(less)}  # deg, m"


def _coefficients(f: OwnerFacts, hull: Any, indent: str) -> Iterator[str]:
    for field in dataclasses.fields(hull):
        value = getattr(hull, field.name)
        if field.name == "surge_coupling":
            yield f"{indent}{field.name}: {'true' if value else 'false'}"
        elif field.name != "vertical":
            number = f"{value:.6g}" if field.name in _MASSES else f"{value:.4g}"
            yield f"{indent}{field.name}: {number}  # {_source(field.name, f, hull)}"


def _source(name: str, f: OwnerFacts, hull: Any) -> str:
    """Return where a coefficient comes from."""
    if name == "m" and f.mass is not None:
        return "kg, given"
    if name == "diameter" and f.diameter is not None:
        return "m, given"
    if name == "Xuu" and (f.thrust_unit == "N" or f.thrust_table):
        return f"from {f.speed:g} m/s at {f.speeds[-1][0]:g} {SYMBOLS[f.thrust_unit]}"
    if name in _BY_RUDDER:
        if f.effect is not None and name in ("Yuud", "Nuud"):
            return f"from the given effect, {f.effect:g} 1/s^2"
        b = f": b = {effect_of(hull, f):.2f} 1/s^2 at {f.speed:g} m/s" if name == "Nuud" else ""
        return f"assumed (x{EFFECT_FACTOR:g}){b}"
    if name == "Nur":
        if f.divergence is not None:
            return f"from the given divergence, {f.divergence:g} 1/s"
        return (
            "from the radii at several angles"
            if len(f.radii) > 1
            else f"assumed (x{FACTOR:g}): stable and unstable hulls exist"
        )
    if name == "Nrr" and f.radii:
        return f"from the radius of {f.radii[-1][1]:g} m at {f.radii[-1][0]:g} deg"
    if name in ("Yvv", "Yuv"):
        return f"assumed (x{SWAY_FACTOR:g}): between hulls whose sideslip settles fast and slowly"
    if name == "zg" and f.dive_rate is not None:
        return f"from {f.dive_rate:g} m/s of dive"
    if name in ("m", "W", "B", "Izz", "Iyy"):
        return (
            "assumed (x1.3), from the water that the hull displaces"
            if f.mass is None
            else "by the given mass"
        )
    return f"assumed (x{FACTOR:g})"


def _rows(rows: Rows) -> str:
    return "[" + ", ".join(f"[{x:g}, {y:.5g}]" for x, y in rows) + "]"


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
