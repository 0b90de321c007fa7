"""What is read of each topic: one place and one sign, whatever the frames of the vehicle."""

from __future__ import annotations

import math
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import Vector3Stamped
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import fill_odometry
from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.spatial_conversions import fill_spatial_odometry
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import Navigation, SpatialNavigation
from auv_sim.nodes.console.readings_of_topics import TopicReader
from auv_sim.views.console.record.track_columns import NAMES
from auv_sim.views.console.record.vehicle_record import VehicleRecord

ENU, NED = ("map", "base_link"), ("map_ned", "base_link_frd")
#: 30 m north, 10 m east, 5 m deep; bow 0.1 rad up, heading 0.5 rad from north towards east.
DIVER = SpatialNavigation(30.0, 10.0, 5.0, 0.0, 0.1, 0.5, 0.0, 0.0)


class Reading:
    def __init__(self) -> None:
        self.now = 100.0
        self.record = VehicleRecord(0, "/auv")
        self.readers = TopicReader(self.record, FrameTable(FrameIds()), lambda: self.now).readers()

    def hear(self, topic: Any, message: Any) -> None:
        self.readers[topic](message)


@pytest.fixture
def reading() -> Reading:
    return Reading()


def odometry(frames: tuple[str, str]) -> Odometry:
    message = Odometry()
    message.header.frame_id, message.child_frame_id = frames
    return message


@pytest.mark.parametrize("frames", [ENU, NED])
def test_a_diver_is_in_one_place_whatever_its_frames(frames: tuple[str, str], reading: Reading) -> None:
    message = odometry(frames)
    fill_spatial_odometry(message, DIVER, (2.0, 0.3, 0.0), 0.0, 7_000_000_000)
    reading.hear(topics.ODOM, message)
    values, seen = reading.record.values, reading.record.seen
    assert (values["x"], values["y"], values["z"]) == pytest.approx((10.0, 30.0, -5.0))
    assert values["yaw"] == pytest.approx(math.pi / 2 - 0.5)
    assert values["pitch"] == pytest.approx(0.1), "bow up is positive"
    ahead = 2.0 * math.cos(0.1)
    assert values["vn"] == pytest.approx(ahead * math.cos(0.5) - 0.3 * math.sin(0.5))
    assert values["ve"] == pytest.approx(ahead * math.sin(0.5) + 0.3 * math.cos(0.5))
    assert seen.stamp == 7.0
    assert seen.pose == pytest.approx((10.0, 30.0, -5.0, math.pi / 2 - 0.5, 0.1))


@pytest.mark.parametrize(("frames", "first"), [(ENU, (1.0, 0.5, 4.0)), (NED, (4.0, 0.5, 1.0))])
def test_a_covariance_is_turned_into_enu(
    frames: tuple[str, str], first: tuple[float, float, float], reading: Reading
) -> None:
    message = odometry(frames)
    fill_odometry(message, Navigation(0.0, 0.0, 0.0, 0.0), 1.0, 0.0, 1_000_000_000)
    covariance = [0.0] * 36
    covariance[0], covariance[1], covariance[6], covariance[7] = first[0], first[1], first[1], first[2]
    message.pose.covariance = covariance
    reading.hear(topics.ODOM, message)
    assert reading.record.seen.covariance == (1.0, 0.5, 4.0)


def test_a_planar_vehicle_without_a_depth_is_at_the_surface(reading: Reading) -> None:
    message = odometry(ENU)
    fill_odometry(message, Navigation(3.0, 4.0, 0.0, 0.0), 1.0, 0.0, 1_000_000_000)
    message.pose.pose.position.z = math.nan
    reading.hear(topics.ODOM, message)
    assert (reading.record.values["x"], reading.record.values["z"]) == (4.0, 0.0)


@pytest.mark.parametrize("spoil", ["frame", "x", "quaternion", "stamp"])
def test_an_odometry_that_cannot_be_used_makes_no_row(spoil: str, reading: Reading) -> None:
    message = odometry(("map", "base_link_frd") if spoil == "frame" else ENU)
    fill_odometry(message, Navigation(3.0, 4.0, 0.0, 0.0), 1.0, 0.0, 1_000_000_000)
    if spoil == "x":
        message.pose.pose.position.x = math.inf
    elif spoil == "quaternion":
        message.pose.pose.orientation.w = 5.0
    elif spoil == "stamp":
        message.header.stamp.sec = -1
    with pytest.raises(MessageRefused):
        reading.hear(topics.ODOM, message)
    assert reading.record.history.taken == 0


def test_signs_and_places_of_the_other_columns(reading: Reading) -> None:
    status = {"state": "running", "length [m]": "200.0", "reason": "started"}
    values = [KeyValue(key=key, value=value) for key, value in status.items()]
    reading.hear(topics.MISSION_STATUS, DiagnosticStatus(values=values))
    reading.hear(topics.DISTANCE_TO_GO, Float64(data=150.0))
    reading.hear(topics.DESIRED_PITCH, Float64(data=0.2))
    reading.hear(topics.RUDDER_CMD, Float64(data=-0.1))
    current = Vector3Stamped()
    current.vector.x, current.vector.y = 0.1, -0.2
    reading.hear(topics.CURRENT_ESTIMATE, current)
    found = reading.record.values
    assert (found["s"], found["rudder"], found["pitch_ref"]) == (50.0, -0.1, -0.2)
    assert (found["current_east"], found["current_north"]) == (0.1, -0.2)
    with pytest.raises(MessageRefused):
        reading.hear(topics.DISTANCE_TO_GO, Float64(data=math.nan))


def test_a_lone_word_of_another_publisher_changes_no_state(reading: Reading) -> None:
    for word in ("running", "running", "aborted", "running"):
        reading.hear(topics.MISSION_STATE, String(data=word))
        assert reading.record.progress.state == "running"
    for word in ("aborted", "aborted"):
        reading.hear(topics.MISSION_STATE, String(data=word))
    assert reading.record.progress.state == "aborted"


def _row(reading: Reading, stamp: int) -> Any:
    message = odometry(ENU)
    fill_odometry(message, Navigation(0.0, 0.0, 0.0, 0.0), 1.0, 0.0, stamp * 1_000_000_000)
    reading.hear(topics.ODOM, message)
    return dict(zip(NAMES, reading.record.history.rows[-1].tolist(), strict=True))


def test_a_measurement_that_no_longer_comes_is_left_out_of_the_rows(reading: Reading) -> None:
    current = Vector3Stamped()
    current.vector.x = 0.25
    reading.hear(topics.CURRENT_ESTIMATE, current)
    reading.hear(topics.DISTANCE_TO_GO, Float64(data=5.0))
    for k in range(9):
        reading.hear(topics.RUDDER_CMD, Float64(data=0.5))
        row = _row(reading, k + 1)
        is_old = k > 4
        assert math.isnan(row["current_east"]) == is_old
        assert (reading.record.seen.current is None) == is_old
        assert math.isnan(reading.record.progress.to_go) == is_old
        assert row["rudder"] == 0.5
        reading.now += 0.5


def test_a_pause_makes_no_measurement_old(reading: Reading) -> None:
    reading.hear(topics.RUDDER_CMD, Float64(data=0.5))
    for k in range(2):
        assert _row(reading, k + 1)["rudder"] == 0.5
        reading.now += 600.0


def test_a_new_simulation_begins_without_the_measurements_of_the_last(reading: Reading) -> None:
    reading.hear(topics.RUDDER_CMD, Float64(data=0.5))
    reading.record.seen.current = 1.0, 0.0, 0.0
    _row(reading, 100)
    _row(reading, 1)
    row = _row(reading, 2)
    assert reading.record.epoch == 2
    assert math.isnan(row["rudder"])
    assert row["x"] == 0.0
    assert reading.record.seen.current is None
