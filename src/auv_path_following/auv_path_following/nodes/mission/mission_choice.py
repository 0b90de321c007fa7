"""The choice of a mission by parameters: read and checked before it takes the place of another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.nodes.mission.mission_course import PublishedCourse, course_of
from auv_path_following.parameters import GuidanceParameters


class MissionChoice:
    """The mission that the parameters `mission`, `mission_text` and `start_at` name.

    Args:
        parameters: at the start of the node.

    Attributes:
        course: of the chosen mission.

    Raises:
        ConfigurationError: the mission cannot be read, or the vehicle cannot fly it.
    """

    def __init__(self, parameters: GuidanceParameters) -> None:
        self._hull = vehicle.load(parameters.vehicle)
        self._chosen = ("", parameters.mission_text) if parameters.mission_text else (parameters.mission, "")
        self._start_at = parameters.start_at
        self.course = self._course_of(*self._chosen)
        self._next: tuple[GuidanceParameters, PublishedCourse] | None = None

    def propose(self, proposed: GuidanceParameters, refuses: str, current: Any) -> None:
        """Check parameters before they are accepted.

        Args:
            proposed: the parameters.
            refuses: why no other mission can be taken now; empty where one can.
            current: estimate, NED, m/s, in which the mission is checked.

        Raises:
            ConfigurationError: another mission is named, and it cannot be taken, read or flown.
        """
        self._next = None
        chosen = self._named(proposed)
        if chosen == self._chosen and proposed.start_at == self._start_at:
            return
        name = "start_at" if chosen == self._chosen else "mission_text" if chosen[1] else "mission"
        if refuses:
            raise ConfigurationError(name, refuses, "no mission under way, or one held by the service hold")
        course = self.course if chosen == self._chosen else self._course_of(*chosen)
        course.prepare(proposed)
        self._check(course.mission, proposed, current)
        if course.with_altitude and not self.course.with_altitude and proposed.lockstep:
            found = "an altitude in lockstep, where guidance has not listened to the altimeter from the start"
            raise ConfigurationError(f"{course.mission.source}: altitude", found, "a mission without")
        self._next = proposed, course

    def taken(self, parameters: GuidanceParameters) -> bool:
        """Take what was proposed last, if these are its parameters; return whether the mission changed."""
        if self._next is None or self._next[0] is not parameters:
            return False
        self._chosen, self._start_at = self._named(parameters), parameters.start_at
        self.course, self._next = self._next[1], None
        return True

    def empty_again(self, parameters: GuidanceParameters) -> str:
        """Return which of `mission` and `mission_text` is set and not flown; empty if neither is."""
        if self._chosen[1]:
            return "mission" if parameters.mission else ""
        return "mission_text" if parameters.mission_text else ""

    def _named(self, parameters: GuidanceParameters) -> tuple[str, str]:
        """Return the mission's name and text, one of them empty: of two that are set the newer one counts."""
        name, text = parameters.mission, parameters.mission_text
        is_older = text == self._chosen[1] and name not in ("", self._chosen[0])
        return ("", text) if text and not is_older else (name, "")

    def _course_of(self, name: str, text: str) -> PublishedCourse:
        read: Callable[..., Mission] = mission_file.read_text if text else mission_file.load
        return course_of(read(text or name, self._hull), self._hull)

    def _check(self, mission: Mission, parameters: GuidanceParameters, current: Any) -> None:
        """Refuse what the launcher's check refuses."""
        if not parameters.check_mission:
            return
        # Imported when it is needed: nodes start faster without it.
        from auv_path_following.mission_check.flyable import check, refusal

        guidance = parameters.with_mission_overrides(mission).guidance
        findings = check(mission, self._hull, current, guidance.switching, guidance.lookahead)
        if findings.refusals:
            raise refusal(mission, findings, "check_mission false takes it all the same")
