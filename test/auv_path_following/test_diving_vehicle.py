"""Vehicle files of hulls that dive: the shipped ones, and what is refused."""

from __future__ import annotations

import dataclasses

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.vertical_hull import immersed_share

DIVES = config_files.find("vehicles", "remus100_6dof").read_text(encoding="utf-8")
PEER = config_files.find("vehicles", "mss_remus100").read_text(encoding="utf-8")
PLANES = DIVES[DIVES.index("sternplanes:") : DIVES.index("depth:")]
CANNOT_DIVE = {
    "weight": ("W: 299", "W: 320", "hull", "found W = 320 N under vertical"),
    "pitch inertia": (
        "Mqd: -4.88",
        "Mqd: 3.4",
        "hull",
        "pitch row of the mass matrix less its couplings",
    ),
    "roll inertia": (
        "Kpd: -0.0704",
        "Kpd: 0.2",
        "hull",
        "found Ixx - Kpd = -0.023",
    ),
    "sway and roll": (
        "zg: 0.0196",
        "zg: 0.2",
        "hull",
        "sway row of the mass matrix less its couplings",
    ),
    "heavy on top": (
        "zg: 0.0196",
        "zg: -0.0196",
        "hull.vertical.zg",
        "found -0.0196",
    ),
    "planes the wrong way": ("Muud: -6.15", "Muud: 6.15", "hull.vertical.Muud", "a number less than 0"),
    "planes lift the wrong way": (
        "Zuud: -9.64",
        "Zuud: 9.64",
        "hull.vertical.Zuud",
        "a number less than 0",
    ),
    "pitch without drag": ("Mqq: -188", "Mqq: 0", "hull.vertical.Mqq", "a number less than 0"),
    "roll without damping": ("Kpp: -0.130", "Kpp: 0", "hull.vertical", "found Kpp = 0 and Kup = 0"),
    "too slow for its planes": (
        "minimum_speed: 0.9",
        "minimum_speed: 0.5",
        "",
        "found depth.minimum_speed: 0.5 m/s, with planes that reverse at 0.372 m/s",
    ),
    "too light for its planes": (
        "B: 302.34",
        "B: 309",
        "",
        "found 26.1 deg of stern planes at depth.minimum_speed, 0.9 m/s",
    ),
    "sinks": (
        "B: 302.34",
        "B: 298",
        "",
        "found hull.vertical: B = 298 N below W = 299 N",
    ),
    "no planes": (PLANES, "", "", "found hull.vertical without sternplanes, expected sternplanes"),
    "no vertical half": (
        DIVES[DIVES.index("  vertical:") :],
        "",
        "",
        "found sternplanes without hull.vertical or pitching",
    ),
    "two hulls": (
        "hull:",
        "simulated_as: mss_remus100\nhull:",
        "",
        "found a hull, and simulated_as",
    ),
}


def test_the_diving_hull_is_the_planar_one_with_a_vertical_half():
    planar, diving = vehicle.load("remus100").coefficients, vehicle.load("remus100_6dof").coefficients
    assert dataclasses.replace(diving, vertical=None) == planar


def test_the_corrected_hull_differs_by_its_errata():
    printed, corrected = (vehicle.load(f"remus100_6dof{end}").coefficients for end in ("", "_corrected"))
    printed_sway = dataclasses.replace(corrected, Yvv=-1310.0, vertical=None)
    assert printed_sway == dataclasses.replace(printed, vertical=None)
    erratic = {"Kup": 0.0, "Mrp": 4.86, "Npq": -4.86}
    assert dataclasses.replace(corrected.vertical, **erratic) == printed.vertical
    assert (corrected.Yvv, corrected.vertical.Kup) == (-131.0, -0.7)


def test_the_corrected_coefficients_obey_their_definitions():
    hull = vehicle.load("remus100_6dof_corrected").coefficients
    c = hull.vertical
    assert c.Mrp == pytest.approx(c.Kpd - hull.Nrd, abs=5e-3)
    assert c.Npq == pytest.approx(c.Mqd - c.Kpd, abs=5e-3)
    assert hull.Yvv == c.Zww


@pytest.mark.parametrize(("old", "new", "key", "said"), CANNOT_DIVE.values(), ids=CANNOT_DIVE.keys())
def test_a_hull_that_cannot_dive_is_refused(tmp_path, old, new, key, said):
    assert old in DIVES
    file = tmp_path / "vehicle.yaml"
    file.write_text(DIVES.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        vehicle.load(str(file))
    assert caught.value.where == (f"{file}: {key}" if key else str(file))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_hull_that_sinks_may_be_allowed(tmp_path):
    file = tmp_path / "vehicle.yaml"
    file.write_text(DIVES.replace("B: 302.34", "B: 298").replace("depth:", "depth:\n  allow_sinking: true"))
    assert vehicle.load(str(file)).depth.allow_sinking


@pytest.mark.parametrize(
    ("old", "new", "key", "said"),
    [
        ("mss_remus100\ncruise", "remus6000\ncruise", "simulated_as", "'remus6000', expected 'mss_remus100'"),
        ("effect: 1.652", "effect: -1", "turning.effect", "greater than 0"),
        ("climb_deg: 66.5", "climb_deg: 95", "pitching.climb_deg", "at most 90"),
        (PEER[PEER.index("pitching:") :], "", "", "found sternplanes without hull.vertical or pitching"),
    ],
)
def test_a_measured_vehicle_that_is_wrong_is_refused(tmp_path, old, new, key, said):
    assert old in PEER
    file = tmp_path / "vehicle.yaml"
    file.write_text(PEER.replace(old, new), encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        vehicle.load(str(file))
    assert caught.value.where == (f"{file}: {key}" if key else str(file))
    assert said in str(caught.value)


def test_a_built_in_hull_has_no_coefficients():
    with pytest.raises(
        ConfigurationError, match=r"hull: found simulated_as: mss_remus100, expected the hull's"
    ):
        _ = vehicle.load("mss_remus100").coefficients


def test_a_hull_floats_where_its_buoyancy_is_its_weight():
    diver = vehicle.load("remus100_6dof")
    c = diver.hull.vertical
    floating = diver.shallowest
    assert 0.0 < floating < 0.5 * c.diameter
    assert c.B * immersed_share(floating, 0.5 * c.diameter) == pytest.approx(c.W)
    assert vehicle.load("remus100").shallowest == 0.0
