"""Commands and velocities of other makers, as their vehicles record them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.contract.frames import FrameIds
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.recorded_manoeuvres import manoeuvres_in
from auv_sim.own_vehicle.verbs.reading.recordings_read import frames_with
from foreign_bag import (
    COUNT,
    FINS,
    RATE,
    STEP,
    covered,
    header,
    made,
    number,
    odometry,
    twist,
    vector,
    write_foreign,
)

ANGLES = 0.01 * np.arange(COUNT)
EXPECTED_T = 5.0 + STEP * 1e-9 * np.arange(COUNT)


def joints(k: int) -> Any:
    """Return two fins, of which the first is missing in every second message, as where two nodes publish."""
    names = ["fin_top", "fin_port"] if k % 2 == 0 else ["fin_port"]
    angles = np.array([ANGLES[k], -1.0])[-len(names) :]
    return made("sensor_msgs/JointState", header(k, ""), names, angles, 2.0 * angles, np.zeros(0))


def array(*values: float) -> Any:
    layout = made("std_msgs/MultiArrayLayout", [], 0)
    return made("std_msgs/Float32MultiArray", layout, np.array(values, np.float32))


def fins(k: int) -> Any:
    setpoint = made("auv/msg/Setpoint", 7.5, True)
    return made(FINS, np.array([ANGLES[k], 0.0, 0.0, 0.0]), setpoint, "auto")


@pytest.mark.parametrize(
    ("make", "part", "step", "factor"),
    [
        (joints, ":fin_top", 2, 1.0),
        (joints, ":fin_top.velocity", 2, 2.0),
        (lambda k: array(0.5, ANGLES[k], 0.5), ":1", 1, 1.0),
        (lambda k: array(ANGLES[k]), "", 1, 1.0),
        (lambda k: made("std_msgs/Float32", float(ANGLES[k])), "", 1, 1.0),
        (
            lambda k: made("geometry_msgs/Vector3Stamped", header(k, ""), vector(0, 0, ANGLES[k])),
            ":vector.z",
            1,
            1.0,
        ),
        (lambda k: twist(vector(1, 0), ANGLES[k]), ":angular.z", 1, 1.0),
        (fins, ":fins.0", 1, 1.0),
    ],
)
def test_a_command_is_a_part_of_a_message_of_any_type(
    tmp_path: Path, make: Any, part: str, step: int, factor: float
) -> None:
    bag = write_foreign(tmp_path / "bag", {"/fins": make}, ["/auv/rudder_cmd"])
    found = manoeuvres_in(bag, {"rudder_cmd": f"/fins{part}"}).rudder
    assert found.value == pytest.approx(factor * ANGLES[::step], abs=1e-6)
    assert found.t == pytest.approx(EXPECTED_T[::step], abs=1e-3)  # the clocks of log and stamps differ


def test_rudder_and_thrust_may_be_parts_of_one_topic(tmp_path: Path) -> None:
    bag = write_foreign(tmp_path / "bag", {"/fins": fins}, ["/auv/rudder_cmd", "/auv/thrust_cmd"])
    found = manoeuvres_in(bag, {"rudder_cmd": "/fins:fins.0", "thrust_cmd": "/fins:setpoint.thrust"})
    assert found.rudder.value == pytest.approx(ANGLES)
    assert found.thrust.value == pytest.approx(np.full(COUNT, 7.5))


@pytest.mark.parametrize(
    ("make", "part", "found", "expected"),
    [
        (joints, "", "sensor_msgs/msg/JointState", "/fins:PART with PART one of fin_top, fin_port"),
        (joints, ":fin_low", "JointState without 'fin_low'", "one of fin_top, fin_port"),
        (lambda k: array(1, 2), "", "std_msgs/msg/Float32MultiArray", "with PART one of data.0, data.1"),
        (lambda k: array(1, 2), ":2", "Float32MultiArray without '2'", "with PART one of data.0, data.1"),
        (fins, ":mode", f"{FINS} without 'mode'", "fins.0, fins.1, fins.2, fins.3, setpoint.thrust"),
        (lambda k: made("std_msgs/String", "auto"), "", "std_msgs/msg/String", "a type with a number"),
    ],
)
def test_a_part_that_is_missing_costs_one_line_with_those_that_there_are(
    tmp_path: Path, make: Any, part: str, found: str, expected: str
) -> None:
    bag = write_foreign(tmp_path / "bag", {"/fins": make}, ["/auv/rudder_cmd"])
    with pytest.raises(ConfigurationError) as refused:
        manoeuvres_in(bag, {"rudder_cmd": f"/fins{part}"})
    assert refused.value.where == f"{bag}: /fins"
    assert refused.value.found.endswith(found)
    assert expected in refused.value.expected


def _water(k: int) -> Any:
    return vector(1.5 + 0.001 * k, 0.1)


@pytest.mark.parametrize(
    ("make", "part", "frame"),
    [
        (lambda k: made("geometry_msgs/TwistStamped", header(k, "base_link"), twist(_water(k))), "", ()),
        (lambda k: made("geometry_msgs/Vector3Stamped", header(k, "base_link"), _water(k)), "", ()),
        (lambda k: odometry(k, linear=_water(k)), "", ()),
        (lambda k: twist(_water(k)), "", ["=flu"]),
        (lambda k: covered(twist(_water(k))), "", ["=flu"]),
        (_water, "", ["=flu"]),
        (lambda k: made("geometry_msgs/AccelStamped", header(k, ""),
                        made("geometry_msgs/Accel", _water(k), vector(0, 0))), ":accel.linear", ["=flu"]),
    ],
)  # fmt: skip
def test_a_velocity_is_a_vector_of_a_message_of_any_type(
    tmp_path: Path, make: Any, part: str, frame: list[str]
) -> None:
    bag = write_foreign(tmp_path / "bag", {"/dvl": make}, ["/auv/velocity_through_water"])
    found = manoeuvres_in(
        bag, {"velocity_through_water": f"/dvl{part}"}, frames=frames_with(frame) if frame else None
    )
    kept = EXPECTED_T[: found.water_t.size]  # the last one without a stamp is logged after the odometry
    assert kept.size >= COUNT - 1
    assert found.water_t == pytest.approx(kept, abs=1e-3)
    assert found.water[:, 0] == pytest.approx((1.5 + 0.001 * np.arange(COUNT))[: kept.size])
    assert found.water[:, 1] == pytest.approx(np.full(kept.size, -0.1))  # FLU to FRD


def test_a_velocity_without_frame_id_is_refused_until_its_axes_are_given(tmp_path: Path) -> None:
    bag = write_foreign(tmp_path / "bag", {"/dvl": _water}, ["/auv/velocity_through_water"])
    with pytest.raises(ConfigurationError, match=r"frame_id '', .* or their axes by --frame =flu or =frd"):
        manoeuvres_in(bag, {"velocity_through_water": "/dvl"})


@pytest.mark.parametrize(
    ("world", "child", "frames"),
    [("odom", "odom", []), ("odom", "map", []), ("odom", "auv1/odom", []), ("map_ned", "map_ned", [])],
)
def test_a_twist_in_the_world_is_turned_by_the_attitude_of_its_message(
    tmp_path: Path, world: str, child: str, frames: list[str]
) -> None:
    def in_the_world(k: int) -> Any:
        yaw = 1.0 + RATE * k * STEP * 1e-9
        ahead, aside = 1.5, 0.1
        east = ahead * math.cos(yaw) - aside * math.sin(yaw)
        return odometry(k, world, child, vector(east, ahead * math.sin(yaw) + aside * math.cos(yaw)))

    bag = write_foreign(tmp_path / "bag", {"/auv/odom": in_the_world})
    found = manoeuvres_in(bag, frames=frames_with(frames))
    side = 1.0 if world == "map_ned" else -1.0
    assert found.over[:, 0] == pytest.approx(np.full(COUNT, 1.5))
    assert found.over[:, 1] == pytest.approx(np.full(COUNT, 0.1 * side))
    assert found.run.r == pytest.approx(np.full(COUNT, RATE * side))
    (note,) = found.notes
    assert f"/auv/odom: a twist in the world frame '{child}'" in note


def test_a_twist_in_another_world_is_refused_and_one_in_the_body_stays(tmp_path: Path) -> None:
    bag = write_foreign(tmp_path / "mixed", {"/auv/odom": lambda k: odometry(k, "odom", "map_ned")})
    with pytest.raises(ConfigurationError, match="child_frame_id 'map_ned'"):
        manoeuvres_in(bag)
    found = manoeuvres_in(write_foreign(tmp_path / "body", {}), frames=FrameIds())
    assert found.notes == () and found.over[:, 0] == pytest.approx(np.full(COUNT, 1.5))


def test_types_without_a_definition_do_not_matter_beside_those_that_are_read(tmp_path: Path) -> None:
    """As `ros2 bag record -a` of a vehicle whose packages are not installed here, before ROS 2 Iron."""
    import sqlite3

    bag = write_foreign(tmp_path / "bag", {"/fins": fins, "/x": lambda k: number(k)})
    (file,) = bag.glob("*.db3")
    with sqlite3.connect(file) as database:
        database.execute("DELETE FROM message_definitions")
    assert manoeuvres_in(bag).rudder.value.size == COUNT
    with pytest.raises(ConfigurationError, match=f"/fins: found the type {FINS}.*definition"):
        manoeuvres_in(bag, {"rudder_cmd": "/fins:fins.0"})
