"""Messages that look like known ones, that are damaged, or that are no recording of what is asked for."""

from __future__ import annotations

import sqlite3
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys import get_types_from_msg

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.recorded_manoeuvres import manoeuvres_in
from auv_sim.own_vehicle.verbs.reading.recordings_read import frames_with
from foreign_bag import COUNT, STORE, header, made, odometry, vector, write_foreign

for kind, text in {
    "odd_msgs/msg/OneFin": "string name\nfloat64 position",
    "odd_msgs/msg/Fins": "string[] name\nfloat64[] position",
    "odd_msgs/msg/Columns": "float64[] x\nfloat64[] y\nfloat64[] z",
    "odd_msgs/msg/Named": "string header\ngeometry_msgs/Vector3 speed",
}.items():
    STORE.register(get_types_from_msg(text, kind))


def test_a_message_with_one_name_and_position_is_no_set_of_joints(tmp_path: Path) -> None:
    bag = write_foreign(
        tmp_path / "bag", {"/fin": lambda k: made("odd_msgs/OneFin", "top", 0.01 * k)}, ["/auv/rudder_cmd"]
    )
    found = manoeuvres_in(bag, {"rudder_cmd": "/fin:position"}).rudder
    assert found.value == pytest.approx(0.01 * np.arange(COUNT))


def joints(*angles: float) -> Any:
    return made("odd_msgs/Fins", ["top"], np.array(angles))


def image(k: int) -> Any:
    return made("sensor_msgs/Image", header(k, ""), 20, 30, "mono8", 0, 30, np.zeros(600, np.uint8))


@pytest.mark.parametrize(
    ("make", "topic", "option", "message"),
    [
        (lambda k: joints(0.1), "rudder_cmd", ":top.velocity", "Fins without 'top.velocity'.* one of top"),
        (lambda k: joints(np.nan), "rudder_cmd", ":top", "no rudder_cmd"),
        (
            lambda k: made("odd_msgs/Columns", *[np.array([1.0])] * 3), "velocity_through_water", "",
            "expected a type with a vector as velocity_through_water",
        ),
        (image, "rudder_cmd", "", r"data\.0, .*, \.\.\."),
    ],
)  # fmt: skip
def test_it_is_refused_in_a_line(tmp_path: Path, make: Any, topic: str, option: str, message: str) -> None:
    bag = write_foreign(tmp_path / "bag", {"/odd": make}, [f"/auv/{topic}"])
    with pytest.raises(ConfigurationError, match=message):
        manoeuvres_in(bag, {topic: f"/odd{option}"})


def test_few_elements_of_an_array_are_named() -> None:
    from auv_sim.bags.reading.other_makers.message_parts import numbers_in

    assert len([name for name in numbers_in(image(0)) if name.startswith("data.")]) == 13


def test_a_header_of_another_kind_has_no_stamp(tmp_path: Path) -> None:
    def message(k: int) -> Any:
        return made("odd_msgs/Named", "text", vector(1.5 + 0.001 * k, 0.0))

    bag = write_foreign(tmp_path / "bag", {"/odd": message}, ["/auv/velocity_through_water"])
    found = manoeuvres_in(bag, {"velocity_through_water": "/odd:speed"}, frames=frames_with(["=flu"]))
    assert found.water[:, 0] == pytest.approx(1.5 + 0.001 * np.arange(found.water_t.size))


def test_a_damaged_command_costs_a_line(tmp_path: Path) -> None:
    bag = write_foreign(tmp_path / "bag", {"/fins": lambda k: joints(0.01 * k)}, ["/auv/rudder_cmd"])
    (file,) = bag.glob("*.db3")
    with sqlite3.connect(file) as database:
        (at,) = database.execute("SELECT id FROM topics WHERE name = '/fins'").fetchone()
        (last,) = database.execute("SELECT max(id) FROM messages WHERE topic_id = ?", (at,)).fetchone()
        database.execute("UPDATE messages SET data = substr(data, 1, 14) WHERE id = ?", (last,))
    with pytest.raises(ConfigurationError, match="/fins: found a damaged message"):
        manoeuvres_in(bag, {"rudder_cmd": "/fins:top"})


@pytest.mark.parametrize(
    ("world", "child", "axes", "option"),
    [
        ("", "base_link", ["=enu"], "=enu or =ned"),
        ("odom", "", ["=flu"], "=flu or =frd"),
        ("", "", ["=enu", "=flu"], "=enu --frame =flu or"),
    ],
)
def test_the_option_for_an_empty_frame_id_is_that_of_its_place(
    tmp_path: Path, world: str, child: str, axes: list[str], option: str
) -> None:
    bag = write_foreign(tmp_path / "bag", {"/auv/odom": lambda k: odometry(k, world, child)})
    with pytest.raises(ConfigurationError, match=f"--frame {option}"):
        manoeuvres_in(bag)
    if len(axes) == 2:  # the world alone must not make a world of the body
        with pytest.raises(ConfigurationError, match="child_frame_id ''"):
            manoeuvres_in(bag, frames=frames_with(axes[:1]))
    assert manoeuvres_in(bag, frames=frames_with(axes)).over[:, 0] == pytest.approx(np.full(COUNT, 1.5))


def test_an_orientation_counts_by_its_direction_alone(tmp_path: Path) -> None:
    def scaled(factor: float) -> Path:
        def message(k: int) -> Any:
            found = odometry(k, "odom", "odom", vector(1.5, 0.0))
            q = found.pose.pose.orientation
            q.x, q.y, q.z, q.w = (factor * value for value in (q.x, q.y, q.z, q.w))
            return found

        return write_foreign(tmp_path / str(factor), {"/auv/odom": message})

    expected = manoeuvres_in(scaled(1.0)).over
    assert manoeuvres_in(scaled(1.004)).over == pytest.approx(expected)
    with pytest.raises(ConfigurationError, match="an orientation of length 0"):
        manoeuvres_in(scaled(0.0))


def test_the_odometry_is_no_velocity_through_the_water(tmp_path: Path) -> None:
    bag = write_foreign(tmp_path / "bag", {}, ["/auv/velocity_through_water"])
    with pytest.raises(ConfigurationError, match="the odometry itself, expected a velocity"):
        manoeuvres_in(bag, {"velocity_through_water": "/auv/odom"})
