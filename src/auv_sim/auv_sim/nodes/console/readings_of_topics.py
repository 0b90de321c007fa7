"""What the console reads of each topic of a vehicle; ENU, SI, and NaN for what is not measured."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import finite, navigation_from, stamp_of
from auv_msgs_py.contract.frames import Convention, FrameTable, flip_yaw, turn_pose_covariance
from auv_msgs_py.contract.mission_word import MissionWord
from auv_msgs_py.contract.spatial_conversions import spatial_navigation_from
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SpatialNavigation
from auv_sim.nodes.console.ground_velocity import over_ground
from auv_sim.views.console.record.health_board import OK, SILENT_AFTER
from auv_sim.views.console.record.readiness import NAVIGATION
from auv_sim.views.console.record.vehicle_record import VehicleRecord

Reader = Callable[[Any], None]
#: Topics whose number is a column, with the factor between them.
_PLAIN = {
    topics.RUDDER_CMD: ("rudder", 1.0),
    topics.STERNPLANE_CMD: ("planes", 1.0),
    topics.THRUST_CMD: ("thrust", 1.0),
    topics.DESIRED_YAW: ("yaw_ref", 1.0),
    topics.DESIRED_PITCH: ("pitch_ref", -1.0),  # on the wire positive is bow down
    topics.DESIRED_DEPTH: ("depth_ref", 1.0),
}
#: Topic -> columns that it fills; those of the odometry are new in every row.
_COLUMNS = {topic: (column,) for topic, (column, _) in _PLAIN.items()} | {
    topics.DISTANCE_TO_GO: ("s",),
    topics.WATER_VELOCITY: ("u",),
    topics.PATH_ERROR: ("xe", "ye"),
    topics.PATH_ERROR_3D: ("ze",),
    topics.CURRENT_ESTIMATE: ("current_east", "current_north"),
    topics.ALTITUDE: ("altitude",),
    topics.TRUE_ODOM: ("true_x", "true_y", "true_z"),
}
#: A longer gap between two odometries is a pause, s.
_PAUSE = 1.0


class TopicReader:
    """Writes what is heard into a vehicle's record.

    Args:
        record: of the vehicle.
        frames: table of the accepted frame ids.
        clock: returns steady time, s.
    """

    def __init__(self, record: VehicleRecord, frames: FrameTable, clock: Callable[[], float]) -> None:
        self._record, self._frames, self._clock = record, frames, clock
        self._word = MissionWord()
        #: Topic -> `_flown` at its last message.
        self._heard: dict[Topic, float] = {}
        #: Steady time while odometry came, s: a simulator that pauses makes no measurement old.
        self._flown, self._odometry_at = 0.0, math.inf

    def readers(self) -> dict[Topic, Reader]:
        """Return what takes the messages of each topic; the odometry, which makes a row, comes last."""
        found: dict[Topic, Reader] = {topic: self._plain(*column) for topic, column in _PLAIN.items()}
        found |= {
            topics.MISSION_STATE: self._on_state,
            topics.MISSION_STATUS: self._on_status,
            topics.DISTANCE_TO_GO: self._on_to_go,
            topics.WATER_VELOCITY: self._on_water,
            topics.PATH_ERROR: self._on_error,
            topics.PATH_ERROR_3D: self._on_spatial_error,
            topics.VIRTUAL_POINT: self._on_virtual_point,
            topics.CURRENT_ESTIMATE: self._on_current,
            topics.ALTITUDE: self._on_altitude,
            topics.TRUE_ODOM: self._on_truth,
            topics.ODOM: self._on_odometry,
        }
        return {topic: self._noted(topic, read) for topic, read in found.items()}

    def _noted(self, topic: Topic, reader: Reader) -> Reader:
        def read(message: Any) -> None:
            reader(message)
            self._heard[topic] = self._flown

        return read

    def _forget_old(self) -> None:
        """Leave what has not come for `SILENT_AFTER` s out of the rows that follow."""
        now = self._clock()
        self._flown += min(max(now - self._odometry_at, 0.0), _PAUSE)
        self._odometry_at = now
        for topic, heard in list(self._heard.items()):
            if self._flown - heard > SILENT_AFTER and topic is not topics.ODOM:
                del self._heard[topic]
                self._record.forget(_COLUMNS.get(topic, ()))
                if topic is topics.VIRTUAL_POINT:
                    self._record.seen.virtual_point = None
                elif topic is topics.CURRENT_ESTIMATE:
                    self._record.seen.current = None

    def _plain(self, name: str, factor: float) -> Reader:
        values = self._record.values

        def read(message: Any) -> None:
            values[name] = factor * message.data

        return read

    def _on_state(self, message: Any) -> None:
        self._word.hear(message.data, self._clock())
        self.look()

    def look(self) -> None:
        """Take the state that counts now, and report a change as an event."""
        progress, state = self._record.progress, self._word.at(self._clock())
        if state != progress.state:
            progress.state = state
            progress.at(self._record.seen.stamp)

    def _on_status(self, message: Any) -> None:
        progress = self._record.progress
        progress.status = {pair.key: pair.value for pair in message.values}
        self.look()

    def _on_to_go(self, message: Any) -> None:
        progress, to_go = self._record.progress, finite(message.data, topics.DISTANCE_TO_GO.name)
        progress.to_go = to_go
        self._record.values["s"] = progress.length - to_go

    def _on_water(self, message: Any) -> None:
        self._record.values["u"] = message.twist.twist.linear.x

    def _on_error(self, message: Any) -> None:
        values, vector = self._record.values, message.vector
        values["xe"], values["ye"] = vector.x, vector.y

    def _on_spatial_error(self, message: Any) -> None:
        self._record.values["ze"] = message.vector.z

    def _on_virtual_point(self, message: Any) -> None:
        place = message.pose.position
        self._record.seen.virtual_point = place.x, place.y, place.z

    def _on_current(self, message: Any) -> None:
        vector, values = message.vector, self._record.values
        self._record.seen.current = vector.x, vector.y, vector.z
        values["current_east"], values["current_north"] = vector.x, vector.y

    def _on_altitude(self, message: Any) -> None:
        found = float(message.range)
        self._record.values["altitude"] = found if math.isfinite(found) else math.nan

    def _on_truth(self, message: Any) -> None:
        place, values = self._navigation(message, topics.TRUE_ODOM), self._record.values
        values["true_x"], values["true_y"], values["true_z"] = place.y, place.x, -place.z

    def _on_odometry(self, message: Any) -> None:
        stamp = stamp_of(message.header.stamp, topics.ODOM.name) * 1e-9
        at = self._navigation(message, topics.ODOM)
        self._forget_old()
        record, frames = self._record, self._frames
        convention = frames.of_pose(topics.ODOM.name, message.header.frame_id, message.child_frame_id)
        linear = message.twist.twist.linear
        sign = 1.0 if convention is Convention.NED_FRD else -1.0
        north, east = over_ground(at, (linear.x, sign * linear.y, sign * linear.z))
        yaw = math.remainder(flip_yaw(at.psi), math.tau)
        record.values |= {
            "x": at.y, "y": at.x, "z": -at.z, "yaw": yaw, "pitch": at.theta, "ve": east, "vn": north,
        }  # fmt: skip
        record.health.hear(NAVIGATION, OK, "odometry arrives", self._clock())
        if record.take_row(stamp):
            record.seen.pose = at.y, at.x, -at.z, yaw, at.theta
            record.seen.covariance = _covariance(message.pose.covariance, convention)

    def _navigation(self, message: Any, topic: Topic) -> SpatialNavigation:
        """Return pose and rates; of a planar vehicle, whose depth is no number, at the surface."""
        try:
            return spatial_navigation_from(message, self._frames, topic.name)
        except MessageRefused:
            x, y, psi, r = navigation_from(message, self._frames, topic.name)
            return SpatialNavigation(x, y, 0.0, 0.0, 0.0, psi, 0.0, r)


def _covariance(values: Any, convention: Convention) -> tuple[float, float, float] | None:
    """Return the variances and the covariance of the position, ENU, m²; None where they are not known."""
    ned = convention is Convention.NED_FRD
    found = turn_pose_covariance(values) if ned else values
    east, both, north = float(found[0]), float(found[1]), float(found[7])
    known = east > 0.0 and north > 0.0 and math.isfinite(east + both + north)
    return (east, both, north) if known else None
