"""Plans are checked in a process of their own: a long mission delays neither the topics nor an abort."""

from __future__ import annotations

import asyncio
import contextlib
import json
import signal
import sys
from collections.abc import Mapping
from typing import Any

from auv_msgs_py.values.errors import SuiteError, printable
from auv_sim.views.console import mission_desk
from auv_sim.views.console.mission_desk import MissionFacts
from auv_sim.views.console.record.readiness import PlanLines

#: Longest time of a check that a browser waits for, and of the one of the present mission, s.
LONGEST, _LONGEST_FACTS = 25.0, 120.0
_MODULE = "auv_sim.views.console.plan_apart"


class CheckFailed(SuiteError):
    """A check has ended without a result."""


async def checked_text(text: str, hull: str) -> dict[str, Any]:
    """Return `ok`, the `lines` of the check of a mission's text, and its `course` if it is ok.

    Args:
        text: of a mission file.
        hull: name or file of the vehicle.

    Raises:
        CheckFailed: it took longer than `LONGEST`, or its process failed.
    """
    found: dict[str, Any] = await _apart({"text": text, "hull": hull}, LONGEST)
    return found


async def facts_of(digest: str, mission: str, text: str, hull: str) -> MissionFacts:
    """Return the facts of the mission that guidance has, as `mission_desk.facts_of`.

    Raises:
        CheckFailed: it took too long, or its process failed.
    """
    request = {"digest": digest, "mission": mission, "text": text, "hull": hull}
    found = await _apart(request, _LONGEST_FACTS)
    plan = found.pop("plan")
    return MissionFacts(**found, plan=None if plan is None else PlanLines(plan["ok"], tuple(plan["lines"])))


async def _apart(request: Mapping[str, str], longest: float) -> Any:
    """Return the result of `_result` in another process, within `longest` s."""
    child = await asyncio.create_subprocess_exec(
        sys.executable, "-m", _MODULE, start_new_session=True,  # Ctrl-C is the console's alone
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        out, complaint = await asyncio.wait_for(child.communicate(json.dumps(request).encode()), longest)
    except TimeoutError:
        raise CheckFailed(f"the check took longer than {longest:g} s") from None
    finally:
        if child.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                child.kill()
            await child.wait()
    if child.returncode:
        last = complaint.decode(errors="replace").strip().rpartition("\n")[2]
        raise CheckFailed(printable(f"the check failed: {last or f'exit code {child.returncode}'}"))
    return json.loads(out)


def _result(request: Mapping[str, str]) -> dict[str, Any]:
    """Return facts of a mission if the request has a digest, else the check of a text."""
    if "digest" in request:
        facts = mission_desk.facts_of(**request)
        return {**facts._asdict(), "plan": None if facts.plan is None else facts.plan._asdict()}
    found = mission_desk.check_text(**request)
    draft = {"course": mission_desk.draft_of(**request)} if found.ok else {}
    return {**found._asdict(), **draft}


if __name__ == "__main__":
    signal.setitimer(signal.ITIMER_REAL, 2.0 * _LONGEST_FACTS)  # even without the console
    json.dump(_result(json.load(sys.stdin)), sys.stdout)
