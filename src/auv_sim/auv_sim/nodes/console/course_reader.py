"""Path, fence and origin of a vehicle's mission as the page draws them, and what the mission file adds."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_sim.nodes.console.readings_of_topics import Reader
from auv_sim.views.console.mission_desk import MissionFacts
from auv_sim.views.console.record.readiness import PlanLines
from auv_sim.views.console.record.vehicle_record import VehicleRecord

#: Most points of the path that are sent.
_MOST_POINTS = 8000
#: `sensor_msgs/msg/NavSatStatus.STATUS_NO_FIX`: the mission has no origin.
_NO_FIX = -1
_CHECKING = PlanLines(False, ("the plan is being checked",))
_NOT_CHECKED = PlanLines(True, ("the mission's file is not on this machine: its check was the vehicle's",))


class CourseReader:
    """Collects the course of the present mission; a start is refused until its file has been checked.

    Args:
        record: of the vehicle.
    """

    def __init__(self, record: VehicleRecord) -> None:
        self._record = record
        self._path: list[tuple[float, float, float, float]] = []
        self._fence: list[tuple[float, float]] = []
        self._origin: dict[str, float] | None = None
        self._facts: MissionFacts | None = None
        self._has_changed = False
        self._shown = ""

    def readers(self) -> dict[Topic, Reader]:
        """Return what takes the messages of each topic."""
        return {topics.PATH: self._on_path, topics.GEOFENCE: self._on_fence, topics.ORIGIN: self._on_origin}

    @property
    def digest(self) -> str:
        """Of the mission that guidance has now; empty before it was heard."""
        return self._record.progress.status.get("digest", "")

    def needs_facts(self) -> bool:
        """Return whether guidance has a mission whose file was not looked at yet."""
        return bool(self.digest) and (self._facts is None or self._facts.digest != self.digest)

    def take_facts(self, facts: MissionFacts) -> None:
        """Take what the mission's file holds."""
        self._facts, self._has_changed = facts, True

    def look(self) -> None:
        """Hand a changed course to the record."""
        if self.digest != self._shown:
            self._has_changed = True
        if not self._has_changed or not self._path:
            return
        self._has_changed, self._shown = False, self.digest
        status, facts = self._record.progress.status, self._facts
        is_right = facts is not None and facts.digest == self.digest
        length = self._record.progress.length
        scale = length / self._path[-1][3] if length > 0.0 and self._path[-1][3] > 0.0 else 1.0
        self._record.set_course(
            {
                "path": [(x, y, z, round(s * scale, 3)) for x, y, z, s in self._path],
                "joints": facts.joints if facts is not None and is_right else [],
                "fence": self._fence,
                "origin": self._origin,
                "mission": {
                    "name": status.get("mission", ""), "digest": self.digest, "length": length,
                },
                "dives": facts.dives if facts is not None and is_right else any(p[2] for p in self._path),
            },
            _CHECKING if self.needs_facts() else (facts and facts.plan) or _NOT_CHECKED,
        )  # fmt: skip

    def _on_path(self, message: Any) -> None:
        places = [each.pose.position for each in message.poses]
        step = max(1, math.ceil(len(places) / _MOST_POINTS))
        way, found, last = 0.0, [], None
        for k, place in enumerate(places):
            if last is not None:
                way += math.dist((place.x, place.y, place.z), (last.x, last.y, last.z))
            last = place
            if k % step == 0 or k == len(places) - 1:
                found.append((round(place.x, 3), round(place.y, 3), round(place.z, 3), way))
        self._path, self._has_changed = found, True

    def _on_fence(self, message: Any) -> None:
        fence = [(float(point.x), float(point.y)) for point in message.polygon.points]
        self._has_changed |= fence != self._fence
        self._fence = fence

    def _on_origin(self, message: Any) -> None:
        has_one = message.status.status != _NO_FIX
        origin = {"latitude": message.latitude, "longitude": message.longitude, "altitude": message.altitude}
        self._has_changed |= self._origin != (origin if has_one else None)
        self._origin = origin if has_one else None
