"""Programs of manoeuvres: the shipped ones, and wrong ones."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_sim.own_vehicle.manoeuvres import legs, program_file

HEAD = "version: 1\nname: p\nlegs:\n"


@pytest.mark.parametrize("name", config_files.shipped("manoeuvres"))
def test_shipped_programs_last_as_long_as_their_names_say(name: str) -> None:
    program = program_file.load(name)
    seconds = {"two": 120.0, "eight": 480.0}[name.split("_")[0]]
    assert seconds - 5.0 <= program.duration <= seconds
    assert program.name == name
    assert program.needs_planes == name.endswith("_dive")
    # Both sides: a program that turns one way only does not show what is unlike to port and starboard.
    config = legs.manoeuvres_of(program, vehicle.load("remus100_6dof"))
    sides = {leg.fin > 0.0 for leg in config.legs if leg.fin}
    assert sides == {True, False}


@pytest.mark.parametrize(
    ("text", "where", "found"),
    [
        ("  - straight: {seconds: 0}\n", "legs[0]", "0"),
        ("  - straight: {seconds: 5, course_deg: 3, towards_start: true}\n", "legs[0]", "one of the two"),
        ("  - {}\n", "legs[0]", "0 manoeuvres"),
        ("  - {straight: {seconds: 5}, circle: {seconds: 5, rudder_deg: 3}}\n", "legs[0]", "2 manoeuvres"),
        ("  - zigzag: {seconds: 5, rudder_deg: 10}\n", "legs[0].zigzag.heading_deg", "found nothing"),
        ("  - circle: {seconds: 5, rudder_deg: 10, thrust: 1.5}\n", "thrust", "1.5"),
        ("".join(["  - straight: {seconds: 600}\n"] * 7), "p.yaml", "4200 s"),
        ("  []\n", "p.yaml", "no legs"),
    ],
)
def test_a_wrong_program_costs_one_line(tmp_path: Path, text: str, where: str, found: str) -> None:
    file = tmp_path / "p.yaml"
    file.write_text(HEAD + text)
    with pytest.raises(ConfigurationError) as error:
        program_file.load(str(file))
    assert where in str(error.value) and found in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("name", "text", "found"),
    [
        ("remus100", "  - plane_step: {seconds: 3, planes_deg: 5, pitch_deg: 10}\n", "in the plane"),
        ("remus100", "  - straight: {seconds: 3, depth_step: 2}\n", "in the plane"),
        ("remus100", "  - circle: {seconds: 3, rudder_deg: 36}\n", "36 deg"),
        ("remus100", "  - circle: {seconds: 3, rudder_deg: 0}\n", "0 deg"),
        ("remus100_6dof", "  - plane_step: {seconds: 3, planes_deg: -21, pitch_deg: 10}\n", "-21 deg"),
    ],
)
def test_a_program_that_a_vehicle_cannot_fly_is_refused(
    tmp_path: Path, name: str, text: str, found: str
) -> None:
    file = tmp_path / "p.yaml"
    file.write_text(HEAD + text)
    with pytest.raises(ConfigurationError, match=r"p: legs\[0\]") as error:
        legs.manoeuvres_of(program_file.load(str(file)), vehicle.load(name))
    assert found in str(error.value)


@pytest.mark.parametrize("name", config_files.shipped("manoeuvres"))
def test_shipped_programs_fit_small_fins(name: str) -> None:
    """All angles of a fin in one proportion, so that a smaller one stays smaller."""
    program, diver = program_file.load(name), vehicle.load("remus100_6dof")
    assert diver.sternplanes is not None
    small = dataclasses.replace(
        diver,
        rudder=dataclasses.replace(diver.rudder, max_angle_deg=7.0),
        sternplanes=dataclasses.replace(diver.sternplanes, max_angle_deg=8.0),
        depth=dataclasses.replace(diver.depth, minimum_speed=1.5),
    )
    full, less = legs.manoeuvres_of(program, diver).legs, legs.manoeuvres_of(program, small).legs
    for kinds, largest in (((legs.ZIGZAG, legs.CIRCLE), 7.0), ((legs.PITCH_ZIGZAG, legs.PLANE_STEP), 8.0)):
        whole = [leg.fin for leg in full if leg.kind in kinds]
        reduced = [leg.fin for leg in less if leg.kind in kinds]
        if whole:
            assert max(map(abs, reduced)) == pytest.approx(math.radians(largest))
            share = max(map(abs, reduced)) / max(map(abs, whole))
            assert reduced == pytest.approx([share * fin for fin in whole])
    assert [leg.fin for leg in less if leg.kind == legs.DEPTH_ZIGZAG] == [
        leg.fin for leg in full if leg.kind == legs.DEPTH_ZIGZAG
    ]
