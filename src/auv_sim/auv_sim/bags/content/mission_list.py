"""The missions in a recording, as `mission_status` reports them; an operator may have flown several."""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.bags.content.parameter_changes import changes_in
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import Bag

#: Keys of `mission_status` that are read.
_BEGUN, _PLACE = "begun at [s]", "start at"


@dataclass
class ListedMission:
    """One mission that was flown.

    Attributes:
        name, digest: of the mission.
        place: where on its path it began, as the operator named it; empty: at its start.
        begun: stamp of its first odometry, s.
        state, reason: as they were reported last.
    """

    name: str
    digest: str
    place: str
    begun: float
    state: str
    reason: str


def listed(bag: Bag, namespace: str | None) -> list[ListedMission]:
    """Return the missions that were flown, in their order; a start begins one again.

    Args:
        bag: with the messages of `mission_status`; without them there are none.
        namespace: of the vehicle.
    """
    topic = bag.find(topics.MISSION_STATUS.name, namespace)
    if topic is None or topic.type != topics.MISSION_STATUS.type:
        return []
    found: list[ListedMission] = []
    for _, message in messages_of(topic):
        values = {str(pair.key): str(pair.value) for pair in message.values}
        begun = _seconds(values)
        if math.isnan(begun):  # chosen, but not begun
            continue
        if not found or found[-1].begun != begun:
            name, digest = values.get("mission", ""), values.get("digest", "")
            found.append(ListedMission(name, digest, values.get(_PLACE, ""), begun, "", ""))
        found[-1].state, found[-1].reason = values.get("state", ""), values.get("reason", "")
    return found


def missions_by_digest(bag: Bag, namespace: str | None, model: Vehicle | None) -> dict[str, Mission]:
    """Return the missions that were set in flight, by their digests.

    One that was set by the name of a file is read from that file; its digest shows whether it still is the
    same.

    Args:
        bag: with the messages of `/parameter_events`.
        namespace: of the vehicle.
        model: the hull that the nodes assumed.
    """
    found: dict[str, Mission] = {}
    for change in changes_in(bag, namespace):
        if change.node != topics.GUIDANCE:
            continue
        for key, read in (("mission_text", mission_file.read_text), ("mission", mission_file.load)):
            if value := change.values.get(key):
                with contextlib.suppress(ConfigurationError):
                    mission: Mission = read(value, model)
                    found[mission.digest] = mission
    return found


def _seconds(values: dict[str, Any]) -> float:
    """Return when a mission began; NaN where it has not, or where that is no number."""
    try:
        begun = float(values.get(_BEGUN, ""))
    except ValueError:
        return math.nan
    return begun if math.isfinite(begun) else math.nan
