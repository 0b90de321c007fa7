"""Checks what discovery shows before a message has come: topics, types, QoS."""

from __future__ import annotations

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_sim.checks.vehicle_check.samples import Recording
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed

_FROM_VEHICLE = (topics.ODOM, topics.WATER_VELOCITY)
_TO_VEHICLE = (topics.RUDDER_CMD, topics.THRUST_CMD)


def check_graph(recording: Recording) -> list[Verdict]:
    """Return a verdict for each topic of the vehicle's side of the contract."""
    verdicts = [_published(topic, recording) for topic in _FROM_VEHICLE]
    verdicts.append(_published(topics.RUDDER_STATE, recording, optional=True))
    return verdicts + [_heard(topic, recording) for topic in _TO_VEHICLE]


def _published(topic: Topic, recording: Recording, optional: bool = False) -> Verdict:
    item = f"{topic.name}: publisher"
    there = [e for e in recording.endpoints if e.topic == topic.name and e.publishes]
    if not there:
        if optional:
            return passed(item, "not published", "optional; it shows more of the rudder")
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
