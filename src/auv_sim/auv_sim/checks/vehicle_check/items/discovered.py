"""Checks what discovery shows before a message has come: topics, types, QoS."""

from __future__ import annotations

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_sim.checks.vehicle_check.samples import Recording
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed

_FROM_VEHICLE = (topics.ODOM, topics.WATER_VELOCITY)
_TO_VEHICLE = (topics.RUDDER_CMD, topics.THRUST_CMD)
#: Topics that a vehicle may publish, and their use.
_OPTIONAL = ((topics.RUDDER_STATE, "it shows more of the rudder"),)
_OPTIONAL_OF_DIVERS = (
    (topics.STERNPLANE_STATE, "it shows more of the stern planes"),
    (topics.ALTITUDE, "missions with an altitude need it"),
)


def check_graph(recording: Recording, dives: bool = False) -> list[Verdict]:
    """Return a verdict for each topic of the vehicle's side of the contract.

    Args:
        recording: with what discovery found.
        dives: whether the vehicle has stern planes.
    """
    verdicts = [_published(topic, recording) for topic in _FROM_VEHICLE]
    optional = _OPTIONAL + (_OPTIONAL_OF_DIVERS if dives else ())
    verdicts += [_published(topic, recording, use) for topic, use in optional]
    to_vehicle = _TO_VEHICLE + ((topics.STERNPLANE_CMD,) if dives else ())
    return verdicts + [_heard(topic, recording) for topic in to_vehicle]


def _published(topic: Topic, recording: Recording, use: str = "") -> Verdict:
    item = f"{topic.name}: publisher"
    there = [e for e in recording.endpoints if e.topic == topic.name and e.publishes]
    if not there:
        if use:
            return passed(item, "not published", f"optional; {use}")
        place = f" in {recording.listened_in}" if recording.listened_in else ""
        return failed(item, Mistake.MISSING_TOPIC, f"no publisher{place}", topic.type)
    wrong = [e for e in there if e.type != topic.type]
    if wrong:
        return failed(item, Mistake.WRONG_TYPE, wrong[0].type, topic.type)
    if len(there) > 1:
        names = " and ".join(sorted(e.node for e in there))
        return failed(item, Mistake.TWO_PUBLISHERS, names, "one publisher")
    return passed(item, f"{there[0].node}, {'reliable' if there[0].reliable else 'best effort'}", topic.type)


def _heard(topic: Topic, recording: Recording) -> Verdict:
    """Judge a subscription: the autopilot offers reliable and volatile; one that requests more is deaf."""
    item = f"{topic.name}: listener"
    there = [e for e in recording.endpoints if e.topic == topic.name and not e.publishes]
    wrong = [e for e in there if e.type != topic.type]
    if wrong:
        return failed(item, Mistake.WRONG_TYPE, f"{wrong[0].node} expects {wrong[0].type}", topic.type)
    if not there:
        return failed(item, Mistake.DEAF, "no subscription", "the vehicle's driver")
    latched = [e for e in there if e.transient_local]
    if latched:
        return failed(
            item,
            Mistake.QOS_MISMATCH,
            f"{latched[0].node} asks for transient local",
            "volatile, as it is offered",
        )
    return passed(item, ", ".join(sorted({e.node for e in there})), topic.type)
