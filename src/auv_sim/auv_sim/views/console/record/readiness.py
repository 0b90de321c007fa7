"""Whether a mission can begin: the line above the button Start, and which buttons may be pressed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState
from auv_sim.views.console.record.health_board import ERROR, SILENT, HealthBoard, NodeHealth

#: The nodes that fly a vehicle; every vehicle has them.
CHAIN = (topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT)
#: The row of the vehicle's odometry among the nodes.
NAVIGATION = "navigation"
_OVER = (MissionState.IDLE, MissionState.COMPLETE, MissionState.ABORTED)


class PlanLines(NamedTuple):
    """What the check of a mission's plan printed.

    Attributes:
        ok: whether it refuses nothing; True where it could not be made here.
        lines: of the check.
    """

    ok: bool
    lines: tuple[str, ...]


def preflight(health: HealthBoard, plan: PlanLines | None, state: str, now: float) -> dict[str, Any]:
    """Return the items that have to hold before a start.

    Args:
        health: of the nodes.
        plan: of the mission that is set; None while it is being checked.
        state: of the mission; empty before it was heard.
        now: steady time, s.
    """
    nodes = [health.of(name, now) for name in CHAIN]
    waits = state in _OVER and health.of(topics.PLANT, now).level != SILENT
    items = [_nodes(nodes), _navigation(health.of(NAVIGATION, now), waits), _plan(plan)]
    return {"ready": all(item["ok"] for item in items), "items": items}


def _nodes(nodes: Sequence[NodeHealth]) -> dict[str, Any]:
    missing = [f"{node.node} is not heard" for node in nodes if node.level == SILENT]
    return _item("nodes", not missing, ", ".join(missing) or "all nodes report")


def _navigation(row: NodeHealth, waits: bool) -> dict[str, Any]:
    """Return the item of the odometry.

    Args:
        row: of the odometry.
        waits: whether a simulator is there that waits for a mission: it sends no odometry meanwhile. A
            vehicle sends it always, and may not start without it.
    """
    if row.age is None:
        reason = "; the simulator begins with the mission" * waits
        return _item("navigation", waits, f"no odometry yet{reason}")
    if row.level == SILENT:
        last = f"the last odometry is {row.age:.0f} s old"
        return _item("navigation", waits, last + ": the simulator waits for a mission" * waits)
    return _item("navigation", row.level < ERROR, row.message)


def _plan(plan: PlanLines | None) -> dict[str, Any]:
    if plan is None:
        return _item("plan", False, "no mission was heard yet")
    return _item("plan", plan.ok, plan.lines[0] if plan.lines else "the check finds nothing")


def _item(name: str, ok: bool, text: str) -> dict[str, Any]:
    return {"name": name, "ok": ok, "text": text}


def start_refusal(checked: Mapping[str, Any], state: str) -> str:
    """Return why a mission cannot be started; empty if it can.

    Args:
        checked: result of `preflight`.
        state: of the mission.
    """
    failed = [f"{item['name']}: {item['text']}" for item in checked["items"] if not item["ok"]]
    if failed or buttons(state, ready=True)["start"]:
        return "; ".join(failed)
    return f"the mission is {state or 'not heard yet'}"


def buttons(state: str, ready: bool) -> dict[str, bool]:
    """Return which buttons an operator may press; an abort is always possible."""
    return {
        "start": ready and state in _OVER,
        "hold": state in (MissionState.RUNNING, MissionState.HOLDING),
        "resume": state == MissionState.HOLDING,
        "abort": True,
    }
