"""Topics of another maker's recording: other types of the same numbers, and refusals by their own names."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle as vehicle_file
from auv_sim.bags.content.recorded_commands import timed_commands
from auv_sim.bags.content.recorded_manoeuvres import manoeuvres_in
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import Manoeuvred, simulate
from auv_sim.vehicle import sea as sea_file
from manoeuvre_bag import NAMES, write_manoeuvres

OTHER = NAMES | {
    "odom": "/nav/filtered",
    "velocity_through_water": "/dvl/track",
    "rudder_cmd": "/fins/rudder",
}
GIVEN = {name: full for name, full in OTHER.items() if full != NAMES[name]}


@pytest.fixture(scope="module")
def flown() -> Manoeuvred:
    """Ten seconds of manoeuvres in a moderate sea."""
    program = program_file.load("two_minutes")
    short = dataclasses.replace(program, legs=program.legs[:1])
    return simulate(vehicle_file.load("remus100"), sea_file.load("moderate"), short, 3)


@pytest.mark.parametrize("ned", [False, True])
def test_a_velocity_without_covariance_is_read_as_one_with_it(
    flown: Manoeuvred, tmp_path: Path, ned: bool
) -> None:
    kind = "geometry_msgs/msg/TwistStamped"
    bag = write_manoeuvres(tmp_path / "bag", flown, OTHER, ned=ned, velocity=kind)
    found = manoeuvres_in(bag, GIVEN)
    assert found.water_t == pytest.approx(flown.water_t)
    assert found.water[:, 0] == pytest.approx(flown.water_u)
    assert found.water[:, 1] == pytest.approx(flown.water_v)


@pytest.mark.parametrize(
    ("name", "other", "expected"),
    [
        ("rudder_cmd", "/dvl/track", "one number as rudder_cmd: --topic rudder_cmd=/dvl/track:PART"),
        ("velocity_through_water", "/fins/rudder", "a type with a vector as velocity_through_water"),
        ("odom", "/fins/rudder", "nav_msgs/msg/Odometry as odom"),
    ],
)
def test_a_topic_of_another_type_is_refused_by_its_name_in_the_recording(
    flown: Manoeuvred, tmp_path: Path, name: str, other: str, expected: str
) -> None:
    bag = write_manoeuvres(tmp_path / "bag", flown, OTHER)
    with pytest.raises(ConfigurationError) as refused:
        manoeuvres_in(bag, {name: other})
    assert refused.value.where == f"{bag}: {other}"
    assert "/msg/" in refused.value.found and refused.value.expected.startswith(expected)


def test_one_of_several_odometries_is_chosen_by_the_option_that_exists(
    flown: Manoeuvred, tmp_path: Path
) -> None:
    bag = write_manoeuvres(tmp_path / "bag", flown, OTHER | {"second": "/nav/raw"}, second="odom")
    names = {name: full for name, full in GIVEN.items() if name != "odom"}
    with pytest.raises(ConfigurationError, match="/nav/filtered and /nav/raw, expected --topic odom=NAME"):
        manoeuvres_in(bag, names)


def test_a_command_before_the_first_odometry_holds_until_the_next_one(
    flown: Manoeuvred, tmp_path: Path
) -> None:
    """Where commands are logged when they change, the thrust of a minute may stand before the odometry."""
    bag = read_bag(write_manoeuvres(tmp_path / "bag", flown))
    topic, odom = bag.find("thrust_cmd"), bag.find("odom")
    assert topic is not None and odom is not None
    stamps = np.array(odom.log_ns[60:], np.int64)
    once = dataclasses.replace(topic, log_ns=topic.log_ns[:1], messages=topic.messages[:1])
    found = timed_commands(once, stamps, stamps)
    assert found is not None
    assert found.value == pytest.approx(flown.thrust[:1])
    assert found.t == pytest.approx(flown.t[:1] + 0.001)


def test_stamps_that_are_no_times_are_refused(flown: Manoeuvred, tmp_path: Path) -> None:
    bag = write_manoeuvres(tmp_path / "bag", flown._replace(t=0.0 * flown.t, water_t=0.0 * flown.water_t))
    with pytest.raises(ConfigurationError, match="odom: found the stamp 0 s in every message"):
        manoeuvres_in(bag)
