"""What an owner has at hand about a vehicle, and what in it contradicts itself."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.thrust_units import SYMBOLS, Rows, ThrustUnit

#: Density of sea water, kg/m^3.
DENSITY = 1025.0
#: Volume over that of the cylinder of the same length and diameter: that of the REMUS 100.
FULLNESS = 0.65
#: Ranges outside which a number is taken for a slip: length over diameter, mass over displaced mass,
#: lengths a second, radius in lengths.
_SLENDERNESS, _HEAVINESS, _SPEED, _RADIUS = (3.0, 30.0), (0.5, 1.6), (0.05, 6.0), (0.4, 40.0)
#: The same: length (m), angle (deg), rate (deg/s) and delay (s) of a fin, thrust in any unit, and effect of
#: the rudder over the square of lengths a second.
_LENGTH, _ANGLE, _RATE, _DELAY = (0.1, 100.0), (1.0, 89.0), (0.1, 1000.0), (0.0, 2.0)
_THRUST, _EFFECT = (1e-3, 1e6), (0.01, 100.0)


class OwnerFacts(NamedTuple):
    """Facts about one vehicle; None: not given.

    Attributes:
        name: of the vehicle.
        length: m.
        thrust_unit, thrust_max: of the driver.
        speeds: thrusts and steady speeds through the water, m/s; increasing.
        radii: rudder (deg) and radius of steady turns, m; the angles increase.
        max_angle_deg: largest rudder, deg.
        mass: kg, in air.
        diameter: m.
        rate_deg_s: of the rudder, deg/s.
        delay: from a command to the start of the fin, s.
        planes_deg, planes_rate_deg_s: of the stern planes; without their angle the vehicle does not dive.
        dive_rate: steady, with the planes at their stop at the largest of `speeds`, m/s.
        thrust_table: rows of the unit and N.
        effect, divergence, drift_time: as in `abilities.Turning`.
    """

    name: str
    length: float
    thrust_unit: ThrustUnit
    thrust_max: float
    speeds: Rows
    radii: Rows
    max_angle_deg: float
    mass: float | None = None
    diameter: float | None = None
    rate_deg_s: float | None = None
    delay: float | None = None
    planes_deg: float | None = None
    planes_rate_deg_s: float | None = None
    dive_rate: float | None = None
    thrust_table: Rows = ()
    effect: float | None = None
    divergence: float | None = None
    drift_time: float | None = None

    @property
    def speed(self) -> float:
        """Largest given speed, m/s: that of design."""
        return self.speeds[-1][1]


def displaced_mass(length: float, diameter: float) -> float:
    """Return the mass of the water that a torpedo displaces, kg."""
    return DENSITY * FULLNESS * 0.25 * math.pi * diameter * diameter * length


def usual_diameter(length: float) -> float:
    """Return the diameter of a hull as stout as the REMUS 100, m."""
    return length * 0.19 / 1.6


def check_facts(facts: OwnerFacts) -> None:
    """Check that facts can belong to one vehicle.

    Raises:
        ConfigurationError: they cannot; with the option, what was found and what was expected.
    """
    f = facts
    _check_size(f)
    _check_fins(f)
    for thrust, speed in f.speeds:
        if thrust > f.thrust_max * (1.0 + 1e-9):
            found = f"{speed:g} m/s at {thrust:g} {SYMBOLS[f.thrust_unit]}"
            raise ConfigurationError("--speed", found, f"a thrust up to --thrust-max, {f.thrust_max:g}")
        _within("--speed", speed / f.length, _SPEED, f"{speed:g} m/s with {f.length:g} m", "lengths a second")
    _check_growth("--speed", f.speeds, (1.0, 1.0), "speeds that grow with the thrust")
    for angle, radius in f.radii:
        if angle > f.max_angle_deg + 1e-9:
            found = f"{radius:g} m at {angle:g} deg"
            raise ConfigurationError("--radius", found, f"an angle up to --rudder, {f.max_angle_deg:g} deg")
        _within("--radius", radius / f.length, _RADIUS, f"{radius:g} m with {f.length:g} m", "lengths")
    _check_growth("--radius", f.radii, (1.0, -1.0), "radii that fall while the angle grows")
    if f.dive_rate is not None:
        if f.planes_deg is None:
            raise ConfigurationError("--dive-rate", f"{f.dive_rate:g} m/s without --planes", "both")
        if f.dive_rate > 0.95 * f.speed:
            found = f"{f.dive_rate:g} m/s down at {f.speed:g} m/s ahead"
            raise ConfigurationError("--dive-rate", found, "less than the speed through the water")
    _check_unit(f)


def _check_size(f: OwnerFacts) -> None:
    if not _LENGTH[0] <= f.length <= _LENGTH[1]:
        raise ConfigurationError("--length", f"{f.length:g} m", f"{_LENGTH[0]:g} to {_LENGTH[1]:g} m")
    if f.diameter is not None:
        size = f"{f.diameter:g} m with {f.length:g} m of length"
        _within("--diameter", f.length / f.diameter, _SLENDERNESS, size, "diameters of length")
    if f.mass is not None:
        slim, stout = (displaced_mass(f.length, f.length / share) for share in reversed(_SLENDERNESS))
        if f.diameter is not None:
            slim = stout = displaced_mass(f.length, f.diameter)
        least, most = _HEAVINESS[0] * slim, _HEAVINESS[1] * stout
        if not least <= f.mass <= most:
            found = f"{f.mass:g} kg with {f.length:g} m of length"
            found += "" if f.diameter is None else f" and {f.diameter:g} m of diameter"
            raise ConfigurationError(
                "--mass", found, f"{least:.3g} to {most:.3g} kg, the water that it displaces"
            )


def _check_fins(f: OwnerFacts) -> None:
    for option, value, bounds, unit in (
        ("--rudder", f.max_angle_deg, _ANGLE, "deg"),
        ("--planes", f.planes_deg, _ANGLE, "deg"),
        ("--rudder-rate", f.rate_deg_s, _RATE, "deg/s"),
        ("--planes-rate", f.planes_rate_deg_s, _RATE, "deg/s"),
        ("--delay", f.delay, _DELAY, "s"),
        ("--thrust-max", f.thrust_max, _THRUST, f.thrust_unit),
    ):
        if value is not None and not bounds[0] <= value <= bounds[1]:
            raise ConfigurationError(option, f"{value:g} {unit}", f"{bounds[0]:g} to {bounds[1]:g} {unit}")
    if f.effect is not None:
        share = f.effect / (f.speed / f.length) ** 2
        _within("--effect", share, _EFFECT, f"{f.effect:g} 1/s^2", "lengths a second squared")


def _check_unit(f: OwnerFacts) -> None:
    if f.thrust_unit == "percent" and f.thrust_max != 100.0:
        raise ConfigurationError("--thrust-max", f"{f.thrust_max:g} with per cent", "100")
    if f.thrust_unit == "N" and f.thrust_table:
        raise ConfigurationError("--thrust-table", "--thrust-unit N", "another unit, or no table")
    _check_growth("--thrust-table", f.thrust_table, (1.0, 1.0), "newtons that grow with the thrust")
    if f.thrust_table and f.thrust_table[-1][0] != f.thrust_max:
        found = f"a last row at {f.thrust_table[-1][0]:g}"
        raise ConfigurationError("--thrust-table", found, f"one at --thrust-max, {f.thrust_max:g}")


def check_thrust_of_hull(facts: OwnerFacts, newtons: float, least: float, most: float) -> None:
    """Check the thrust of the largest speed.

    Args:
        facts: given by the owner.
        newtons: the thrust, N.
        least, most: that hulls of this mass and length need, N.

    Raises:
        ConfigurationError: it does not fit; where it fits a mass usual for the length, the mass is named.
    """
    if least <= newtons <= most:
        return
    found, expected = f"{newtons:g} N at {facts.speed:g} m/s", f"{least:.2g} to {most:.2g} N"
    if facts.mass is not None:
        usual = displaced_mass(facts.length, usual_diameter(facts.length))
        if least <= newtons * facts.mass / usual <= most:
            found = f"{facts.mass:g} kg with {found}"
            raise ConfigurationError("--mass", found, f"{expected}, or a mass such as {usual:.3g} kg")
    raise ConfigurationError("--speed", found, f"{expected} for a hull of this size")


def _within(option: str, value: float, bounds: tuple[float, float], found: str, unit: str) -> None:
    if not bounds[0] <= value <= bounds[1]:
        raise ConfigurationError(
            option, f"{found}, which is {value:.3g} {unit}", f"{bounds[0]:g} to {bounds[1]:g} {unit}"
        )


def _check_growth(option: str, rows: Rows, signs: tuple[float, float], expected: str) -> None:
    for (x, y), (next_x, next_y) in itertools.pairwise(rows):
        if not (signs[0] * (next_x - x) > 0.0 and signs[1] * (next_y - y) > 0.0):
            raise ConfigurationError(option, f"{y:g} at {x:g}, then {next_y:g} at {next_x:g}", expected)
