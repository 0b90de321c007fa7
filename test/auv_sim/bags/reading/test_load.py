from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.load import load, load_messages
from auv_sim.bags.writing.bag_writer import BagWriter, Channel, typestore
from auv_sim.flight.run_record import Run

STEP_NS = 50_000_000
FLOAT = "std_msgs/msg/Float64"
VECTOR = "geometry_msgs/msg/Vector3Stamped"
TWIST = "geometry_msgs/msg/TwistWithCovarianceStamped"
ODOMETRY = "nav_msgs/msg/Odometry"
PER_STEP = {
    "odom": ODOMETRY, "velocity_through_water": TWIST, "rudder_state": FLOAT, "true_current": VECTOR,
    "current_estimate": VECTOR, "desired_yaw": FLOAT, "desired_yaw_rate": FLOAT, "path_parameter": FLOAT,
    "path_error": VECTOR, "rudder_cmd": FLOAT, "thrust_cmd": FLOAT, "true_odom": ODOMETRY,
}  # fmt: skip
COVARIANCE, FRAMES = np.zeros(36), ("map", "auv/base_link")


def make(name: str, *values: Any) -> Any:
    return typestore().types[name](*values)


def header(stamp_ns: int, frame: str) -> Any:
    stamp = make("builtin_interfaces/msg/Time", *divmod(stamp_ns, 10**9))
    return make("std_msgs/msg/Header", stamp, frame)


def vector(x: float, y: float, z: float) -> Any:
    return make("geometry_msgs/msg/Vector3", x, y, z)


def stamped(stamp_ns: int, frame: str, x: float, y: float, z: float = 0.0) -> Any:
    return make(VECTOR, header(stamp_ns, frame), vector(x, y, z))


def number(value: float) -> Any:
    return make(FLOAT, value)


def odometry(stamp_ns: int, x: float, y: float, yaw: float, rate: float, frames: tuple[str, str]) -> Any:
    pose = make(
        "geometry_msgs/msg/Pose",
        make("geometry_msgs/msg/Point", x, y, 0.0),
        make("geometry_msgs/msg/Quaternion", 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)),
    )
    twist = make("geometry_msgs/msg/Twist", vector(1.5, 0.0, 0.0), vector(0.0, 0.0, rate))
    return make(
        ODOMETRY,
        header(stamp_ns, frames[0]),
        frames[1],
        make("geometry_msgs/msg/PoseWithCovariance", pose, COVARIANCE),
        make("geometry_msgs/msg/TwistWithCovariance", twist, COVARIANCE),
    )


def through_water(stamp_ns: int, u: float, v: float, frame: str = "base_link") -> Any:
    twist = make("geometry_msgs/msg/Twist", vector(u, v, 0.0), vector(0.0, 0.0, 0.0))
    return make(
        TWIST, header(stamp_ns, frame), make("geometry_msgs/msg/TwistWithCovariance", twist, COVARIANCE)
    )


class Bag:
    """Writes a bag message by message."""

    def __init__(self, directory: Path, namespace: str = "/auv") -> None:
        self.writer = BagWriter(directory)
        self.namespace = namespace
        self.channels: dict[str, Channel] = {}

    def put(self, topic: str, log_ns: int, message: Any) -> None:
        name = message.__msgtype__
        full = f"{self.namespace}/{topic}"
        if full not in self.channels:
            self.channels[full] = self.writer.add_topic(full, name, [])
        cdr = bytes(typestore().serialize_cdr(message, name))
        self.writer.write(self.channels[full], log_ns, log_ns, cdr)


def truth(n: int) -> Run:
    """Some values that are all different, angles within [-pi, pi)."""
    k = np.arange(n)
    columns = {field.name: (i + 1) * 0.1 + 0.001 * k for i, field in enumerate(dataclasses.fields(Run))}
    return Run.from_columns(columns | {"t": 1.0 + 0.05 * k, "s": 0.01 * k, "held": np.nan * k})


def put_row(bag: Bag, truth: Run, k: int, log_ns: int, skip: tuple[str, ...] = ()) -> None:
    """Row k as the suite's nodes put it on the wire: ENU / FLU."""
    stamp = round(truth.t[k] * 1e9)
    row = {field.name: float(getattr(truth, field.name)[k]) for field in dataclasses.fields(Run)}
    yaw, yaw_true = math.pi / 2 - row["psi"], math.pi / 2 - row["psi_true"]
    messages = {
        "odom": odometry(stamp, row["y"], row["x"], yaw, -row["r"], FRAMES),
        "velocity_through_water": through_water(stamp, row["ur"], -row["vr"]),
        "rudder_state": number(row["rudder"]),
        "true_current": stamped(stamp, "map", row["Vy_true"], row["Vx_true"]),
        "current_estimate": stamped(stamp, "map", row["Vy_est"], row["Vx_est"]),
        "desired_yaw": number(math.pi / 2 - row["psi_d"]),
        "desired_yaw_rate": number(-row["r_d"]),
        "path_parameter": number(row["s"]),
        "path_error": stamped(stamp, "path_frd", row["xe"], row["ye"], row["psi_e"]),
        "rudder_cmd": number(row["rudder_cmd"]),
        "thrust_cmd": number(row["thrust_cmd"]),
        "true_odom": odometry(stamp, row["y_true"], row["x_true"], yaw_true, 0.0, FRAMES),
    }
    assert set(messages) == set(PER_STEP)
    for topic, message in messages.items():
        if topic not in skip:
            bag.put(topic, log_ns, message)


def assert_same(found: Run, expected: Run, skip: tuple[str, ...] = ()) -> None:
    for field in dataclasses.fields(Run):
        if field.name not in skip:
            np.testing.assert_allclose(
                getattr(found, field.name),
                getattr(expected, field.name),
                rtol=0.0,
                atol=1e-12,
                err_msg=field.name,
            )


@pytest.mark.parametrize("namespace", ["/auv", "", "/fleet/auv7"])
def test_every_column_comes_back_in_ned(tmp_path: Path, namespace: str) -> None:
    expected = truth(20)
    bag = Bag(tmp_path / "bag", namespace)
    for k in range(20):
        # A log time before the odometry's: only alignment by index gives the right rows.
        put_row(bag, expected, k, 5_000 + k)
    bag.writer.close()
    assert_same(load(tmp_path / "bag"), expected)


def test_free_running_topics_are_held_until_the_next_message(tmp_path: Path) -> None:
    expected = truth(10)
    bag = Bag(tmp_path / "bag")
    for k in range(10):
        put_row(bag, expected, k, 1000 * k, skip=("rudder_cmd", "current_estimate", "path_parameter"))
    for k in (3, 6):
        bag.put("rudder_cmd", 1000 * k - 500, number(float(k)))
        bag.put("current_estimate", 1000 * k + 500, stamped(10**9 + STEP_NS * k, "map", 0.2, 0.1 * k))
    bag.writer.close()
    run = load(tmp_path / "bag")
    nan = math.nan
    np.testing.assert_array_equal(run.rudder_cmd, [nan, nan, nan, 3, 3, 3, 6, 6, 6, 6])
    np.testing.assert_allclose(run.Vx_est, [nan, nan, nan, 0.3, 0.3, 0.3, 0.6, 0.6, 0.6, 0.6])
    assert np.isnan(run.s).all()
    assert run.steps == 10


def test_a_vehicle_that_speaks_ned_is_not_flipped(tmp_path: Path) -> None:
    bag = Bag(tmp_path / "bag")
    stamp = 10**9
    bag.put("odom", 1, odometry(stamp, 3.0, -4.0, 0.25, 0.05, ("odom_ned", "base_link_frd")))
    bag.put("velocity_through_water", 1, through_water(stamp, 1.5, 0.1, "base_link_frd"))
    bag.writer.close()
    run = load(tmp_path / "bag")
    found = [run.x[0], run.y[0], run.psi[0], run.r[0], run.ur[0], run.vr[0]]
    np.testing.assert_allclose(found, [3.0, -4.0, 0.25, 0.05, 1.5, 0.1], atol=1e-12)


def test_lone_older_stamps_are_left_out_and_a_backward_jump_ends_the_run(tmp_path: Path) -> None:
    bag = Bag(tmp_path / "bag")
    stamps = [10, 11, 12, 9, 13, 13, 14, 10, 11, 12, 13, 14, 15, 16]
    for k, stamp in enumerate(stamps):
        bag.put("odom", k, odometry(stamp * 10**9, 0.0, float(k), 0.0, 0.0, ("map", "base_link")))
        bag.put("current_estimate", k, stamped(stamp * 10**9, "map", 0.0, float(k)))
    bag.writer.close()
    run = load(tmp_path / "bag")
    assert list(run.t) == [10, 11, 12, 13, 14]
    assert list(run.x) == list(run.Vx_est) == [0, 1, 2, 4, 6]


def test_load_messages(tmp_path: Path) -> None:
    bag = Bag(tmp_path / "bag")
    for log_ns, state in ((1, "idle"), (5, "running"), (9, "complete")):
        bag.put("mission_state", log_ns, make("std_msgs/msg/String", state))
    bag.writer.close()
    found = load_messages(tmp_path / "bag", "mission_state")
    assert [(t, m.data) for t, m in found] == [(1, "idle"), (5, "running"), (9, "complete")]
    assert load_messages(tmp_path / "bag", "path") == []


def test_two_vehicles_need_a_namespace(tmp_path: Path) -> None:
    expected = truth(3)
    bag = Bag(tmp_path / "bag", "/auv1")
    for k in range(3):
        put_row(bag, expected, k, k)
    bag.namespace = "/auv2"
    for k in range(3):
        put_row(bag, expected.select(slice(None, None, -1)), k, k, skip=("odom",))
        bag.put("odom", k, odometry(10**9 + k, 7.0, 7.0, 0.0, 0.0, ("map", "base_link")))
    bag.writer.close()
    with pytest.raises(ConfigurationError, match=r"/auv1/odom and /auv2/odom"):
        load(tmp_path / "bag")
    assert_same(load(tmp_path / "bag", namespace="auv1"), expected)
    assert list(load(tmp_path / "bag", namespace="/auv2").x) == [7.0] * 3


def nothing(_: Path) -> None: ...


def empty_directory(directory: Path) -> None:
    directory.mkdir()


def never_closed(directory: Path) -> None:
    bag = Bag(directory)
    bag.put("odom", 1, odometry(10**9, 0.0, 0.0, 0.0, 0.0, ("map", "base_link")))
    bag.writer.flush()


def no_odometry(directory: Path) -> None:
    bag = Bag(directory)
    bag.put("rudder_cmd", 1, number(0.0))
    bag.writer.close()


def odometry_without_messages(directory: Path) -> None:
    with BagWriter(directory) as writer:
        writer.add_topic("/auv/odom", ODOMETRY, [])


def unknown_frames(directory: Path) -> None:
    bag = Bag(directory)
    bag.put("odom", 1, odometry(10**9, 0.0, 0.0, 0.0, 0.0, ("utm", "base_link")))
    bag.writer.close()


def changing_frames(directory: Path) -> None:
    bag = Bag(directory)
    for k, world in enumerate(("map", "odom")):
        bag.put("odom", k, odometry(10**9 + k, 0.0, 0.0, 0.0, 0.0, (world, "base_link")))
    bag.writer.close()


def wrong_type(directory: Path) -> None:
    bag = Bag(directory)
    bag.put("odom", 1, number(1.0))
    bag.writer.close()


def cut_off(directory: Path) -> None:
    bag = Bag(directory)
    bag.put("odom", 1, odometry(10**9, 0.0, 0.0, 0.0, 0.0, ("map", "base_link")))
    bag.writer.close()
    bag.writer.file.write_bytes(bag.writer.file.read_bytes()[:-100])


def damaged_message(directory: Path) -> None:
    with BagWriter(directory) as writer:
        writer.write(writer.add_topic("/auv/odom", ODOMETRY, []), 1, 1, b"\0\1\0\0short")


def not_yaml(directory: Path) -> None:
    bag = Bag(directory)
    bag.put("odom", 1, odometry(10**9, 0.0, 0.0, 0.0, 0.0, ("map", "base_link")))
    bag.writer.close()
    (directory / "metadata.yaml").write_text("a: [")


@pytest.mark.parametrize("prepare", [never_closed, cut_off, not_yaml])
def test_what_a_damaged_bag_still_has_is_read(tmp_path: Path, prepare: Callable[[Path], None]) -> None:
    prepare(tmp_path / "bag")
    assert load(tmp_path / "bag").t.tolist() == [1.0]


@pytest.mark.parametrize(
    ("prepare", "says"),
    [
        (nothing, "found nothing, expected a rosbag2 directory"),
        (empty_directory, r"found no metadata\.yaml, expected"),
        (no_odometry, "found no odometry"),
        (odometry_without_messages, "found no odometry"),
        (unknown_frames, "odom: found frame_id 'utm' with child_frame_id 'base_link'"),
        (changing_frames, "odom: found frame ids .*'map'.* and .*'odom'"),
        (wrong_type, "found std_msgs/msg/Float64, expected nav_msgs/msg/Odometry"),
        (damaged_message, "odom: found a damaged message"),
    ],
)
def test_a_bag_that_cannot_be_used_gets_one_line(
    tmp_path: Path, prepare: Callable[[Path], None], says: str
) -> None:
    prepare(tmp_path / "bag")
    with pytest.raises(ConfigurationError, match=says) as caught:
        load(tmp_path / "bag")
    assert str(tmp_path / "bag") in str(caught.value)
    assert "\n" not in str(caught.value)
