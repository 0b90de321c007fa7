"""Vehicle files: the shipped ones, and wrong ones."""

from __future__ import annotations

import dataclasses
import math
import re

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle

GOOD = config_files.find("vehicles", "remus100").read_text(encoding="utf-8")


def _differences(one: str, other: str) -> dict[str, tuple[object, object]]:
    a, b = (dataclasses.asdict(vehicle.load(name).hull) for name in (one, other))
    return {key: (a[key], b[key]) for key in a if a[key] != b[key]}


def test_default_vehicle_has_the_values_of_its_source():
    remus = vehicle.load("remus100")
    hull = remus.hull
    assert (hull.m, hull.Izz, hull.Nuud, hull.surge_coupling) == (30.48, 3.45, -6.15, True)
    assert (hull.Xrr, hull.Yuv, hull.Nrr) == (-1.93, -28.6, -94.0)
    assert (remus.length, remus.thrust_max) == (1.6, 6.48)


def test_limits_are_offered_in_radians():
    rudder = vehicle.load("remus100").rudder
    assert rudder.max_angle == pytest.approx(35.0 * math.pi / 180.0)
    assert rudder.max_rate == pytest.approx(0.2618, abs=5e-5)


def test_table2_differs_where_it_is_misprinted():
    assert _differences("remus100", "remus100_table2") == {
        "Xrr": (-1.93, 1.93),
        "Yuv": (-28.6, 28.6),
        "Nrr": (-94.0, -9.4),
        "surge_coupling": (True, False),
    }


def test_mismatch_differs_in_the_rudder_only():
    assert _differences("remus100", "remus100_mismatch") == {"Nuud": (-6.15, -4.15)}


@pytest.mark.parametrize(
    "name", [name for name in config_files.shipped("vehicles") if name != "mss_remus100"]
)
def test_every_shipped_vehicle_has_the_same_limits(name):
    remus, other = vehicle.load("remus100"), vehicle.load(name)
    assert (other.rudder, other.thrust_max, other.length) == (remus.rudder, remus.thrust_max, remus.length)


def test_a_vehicle_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        vehicle.load("remus100").hull.m = 1.0


WRONG = {
    "empty file": (GOOD, "", "", "empty file"),
    "missing key": ("  m: 30.48\n", "", "hull.m", "nothing"),
    "misspelt key": ("Izz", "izz", "hull.izz", "unknown key"),
    "unknown key": ("hull:", "hull:\n  Kpp: 1", "hull.Kpp", "unknown key"),
    "text": ("Xuu: -1.62", "Xuu: lots", "hull.Xuu", "'lots', expected a number"),
    "NaN": ("Yvv: -1310", "Yvv: .nan", "hull.Yvv", "finite"),
    "mass of zero": ("m: 30.48", "m: 0", "hull.m", "greater than 0"),
    "drag that drives": ("Xuu: -1.62", "Xuu: 1.62", "hull.Xuu", "less than 0"),
    "rudder the wrong way": ("Nuud: -6.15", "Nuud: 6.15", "hull.Nuud", "less than 0"),
    "added inertia with the wrong sign": (
        "Nrd: -4.88",
        "Nrd: 4.88",
        "hull",
        "Izz - Nrd = -1.43, expected greater than 0",
    ),
    "sway and yaw locked together": ("Yrd: 1.93", "Yrd: 500", "hull", "Yrd Nvd = -415.387"),
    "coupling is a text": (
        "surge_coupling: true",
        "surge_coupling: yes",
        "hull.surge_coupling",
        "true or false",
    ),
    "no hull": (GOOD[GOOD.index("hull:") :], "", "", "nothing under hull"),
    "empty hull": (GOOD[GOOD.index("hull:") :], "hull:\n", "", "a mapping under hull"),
    "negative length": ("length: 1.6", "length: -1.6", "length", "found -1.6"),
    "rudder beyond a right angle": (
        "max_angle_deg: 35",
        "max_angle_deg: 135",
        "rudder.max_angle_deg",
        "less than 90",
    ),
    "rudder that cannot move": (
        "max_rate_deg_s: 15",
        "max_rate_deg_s: 0",
        "rudder.max_rate_deg_s",
        "greater than 0",
    ),
    "angle without its unit": ("max_angle_deg", "max_angle", "rudder.max_angle", "unknown key"),
}


@pytest.mark.parametrize(("old", "new", "key", "said"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_file_gets_one_line_with_file_key_and_reason(tmp_path, old, new, key, said):
    assert old in GOOD
    file = tmp_path / "vehicle.yaml"
    file.write_text(GOOD.replace(old, new), encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        vehicle.load(str(file))
    message = str(caught.value)
    assert "\n" not in message
    assert caught.value.where == (f"{file}: {key}" if key else str(file))
    assert said in message


def test_a_missing_vehicle_names_the_shipped_ones():
    with pytest.raises(ConfigurationError, match=r"remus6000: .*mss_remus100, remus100, remus100_6dof, "):
        vehicle.load("remus6000")


MEASURED = """
name: unidentified
length: 2.0
thrust_max: 10
rudder: {max_angle_deg: 25, max_rate_deg_s: 10}
cruise: {thrust: 8, speed: 2}
turning: {radius: 9.5}
"""


def test_a_measured_vehicle_does_without_a_hull(tmp_path):
    path = tmp_path / "measured.yaml"
    path.write_text(MEASURED)
    measured = vehicle.load(str(path))
    assert measured.speed_at(8.0) == pytest.approx(2.0)
    assert measured.thrust_at(1.0) == pytest.approx(2.0)
    with pytest.raises(ConfigurationError, match="unidentified: hull: found nothing"):
        _ = measured.coefficients


PERCENT = MEASURED.replace("thrust_max: 10", "thrust_max: 100\nthrust_unit: percent").replace(
    "thrust: 8", "thrust: 60"
)


def test_thrust_may_be_known_in_per_cent(tmp_path):
    path = tmp_path / "percent.yaml"
    path.write_text(PERCENT)
    measured = vehicle.load(str(path))
    assert measured.speed_at(60.0) == pytest.approx(2.0)
    assert measured.thrust_at(1.0) == pytest.approx(15.0)
    assert measured.thrust_symbol == "%"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (PERCENT.replace("thrust_max: 100", "thrust_max: 90"), "percent with thrust_max: 90"),
        (
            GOOD.replace("thrust_max: 6.48", "thrust_max: 100\nthrust_unit: percent"),
            "percent with a hull, whose coefficients need N",
        ),
        (GOOD.replace("thrust_max: 6.48", "thrust_max: 900\nthrust_unit: rpm"), "rpm with a hull"),
        (GOOD + "\nthrust_table: [[6.48, 6.48]]\n", "thrust_table with thrust_unit: N"),
        (PERCENT + "thrust_table: [[50, 3], [90, 9]]\n", "thrust_table from 50 to 90 %"),
        (PERCENT + "thrust_table: [[50, 3], [100, 2]]\n", "2 after 3"),
        (PERCENT + "thrust_table: [[0, 0], [100, 2]]\n", "thrust_table from 0 to 100 %"),
    ],
)
def test_a_thrust_that_is_not_in_newtons_has_a_table_where_they_are_needed(tmp_path, text, found):
    path = tmp_path / "percent.yaml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=f"found {found}"):
        vehicle.load(str(path))


TABLE = GOOD.replace(
    "thrust_max: 6.48", "thrust_max: 1500\nthrust_unit: rpm\nthrust_table: [[750, 1.62], [1500, 6.48]]"
)


def test_a_hull_with_a_propeller_in_revolutions_flies_as_the_one_in_newtons(tmp_path):
    path = tmp_path / "rpm.yaml"
    path.write_text(TABLE)
    by_revolutions, remus = vehicle.load(str(path)), vehicle.load("remus100")
    assert by_revolutions.thrust_symbol == "rpm"
    assert by_revolutions.newtons(1125.0) == pytest.approx(4.05)
    assert by_revolutions.top_speed == pytest.approx(remus.top_speed)
    assert by_revolutions.speed_at(750.0) == pytest.approx(1.0)
    assert by_revolutions.thrust_at(1.0) == pytest.approx(750.0)
    assert by_revolutions.in_newtons.thrust_max == 6.48
    with pytest.raises(ConfigurationError, match="unidentified: thrust_table: found nothing"):
        path.write_text(PERCENT)
        vehicle.load(str(path)).newtons(50.0)


@pytest.mark.parametrize(
    ("unit", "thrust", "speed"),
    [("N", 4.0, 1.5**0.5), ("N", 6.5, 2.9375**0.5), ("rpm", 4.0, 1.1), ("rpm", 16.0, 4.0)],
)
def test_speeds_are_interpolated_as_thrust_makes_them(tmp_path, unit, thrust, speed):
    rows = "speeds: [[5, 1.3693063937629153], [8, 2]]" if unit == "N" else "speeds: [[5, 1.375], [8, 2]]"
    path = tmp_path / "speeds.yaml"
    path.write_text(MEASURED.replace("speed: 2}", f"speed: 2, {rows}}}\nthrust_unit: {unit}"))
    measured = vehicle.load(str(path))
    assert measured.speed_at(8.0) == pytest.approx(2.0)
    assert measured.speed_at(thrust) == pytest.approx(speed)
    assert measured.thrust_at(speed) == pytest.approx(thrust)


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        ("speed: 2}", "speed: 2, speeds: [[5, 2], [8, 1.9]]}", "1.9 after 2"),
        ("speed: 2}", "speed: 2, speeds: [[8, 1.2]]}", "2 m/s at 8, with 1.2 m/s by speeds"),
        ("speed: 2}", "speed: 2, speeds: [[0, 0], [8, 2]]}", "speeds that begin with"),
        ("radius: 9.5", "radius: 9.5, radii: [[10, 9]]", "radii: 9 m at 10 deg"),
        ("radius: 9.5", "radius: 9.5, radii: [[10, 12], [15, 13]]", "radii: 13 m at 15 deg"),
        ("radius: 9.5", "radius: 9.5, radii: [[15, 12], [10, 13]]", "10 after 15"),
    ],
)
def test_measurements_that_contradict_each_other_are_refused(tmp_path, old, new, found):
    path = tmp_path / "measured.yaml"
    path.write_text(MEASURED.replace(old, new))
    with pytest.raises(ConfigurationError, match=re.escape(found)):
        vehicle.load(str(path))


def test_what_was_measured_counts_before_the_hull(tmp_path):
    path = tmp_path / "both.yaml"
    path.write_text(GOOD + "\ncruise: {thrust: 6.48, speed: 1.8}\n")
    assert vehicle.load(str(path)).speed_at(6.48) == pytest.approx(1.8)
