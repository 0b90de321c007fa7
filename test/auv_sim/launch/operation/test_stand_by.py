"""How the launcher waits for an operator, and what it makes of Ctrl-C."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import pytest
from rich.console import Console

from auv_sim.launch import launcher, mission_flight, mission_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.operation.flown_missions import FlownMissions
from auv_sim.launch.operation.stand_by import StandBy
from auv_sim.launch.options import Options
from auv_sim.launch.outcome import MissionFailed, Outcome
from auv_sim.launch.progress_display import ProgressDisplay

#: What guidance reports: state, stamp at which the mission began, mission.
Script = list[tuple[str, str, str]]


class Graph:
    """The launcher's node and Ctrl-C: a report with every look, then Ctrl-C.

    Args:
        script: reports before Ctrl-C.
        answer: reports that an abort causes.
        digest: of the mission "short".
        late: number of looks after which they arrive.
    """

    s, ye, to_go, stamp = 1.2, 0.1, 30.0, 1

    def __init__(self, script: Script, answer: Script, digest: str, late: int = 0) -> None:
        self.missions, self.state, self._digest = FlownMissions(), "", digest
        self._script, self._answer, self.aborts = script, answer, 0
        self._late = late

    @property
    def requested(self) -> bool:
        return not self._script

    def look(self, _: float) -> None:
        if self._script:
            self._report(*self._script.pop(0))
        elif self.aborts and self._late:
            self._late -= 1
            self._answered()

    def abort(self) -> None:
        self.aborts += 1
        self._answered()

    def _answered(self) -> None:
        while self._answer and not self._late:
            self._report(*self._answer.pop(0))

    def _report(self, state: str, begun: str, name: str) -> None:
        self.state = state
        digest = self._digest if name == "short" else name
        values = {"state": state, "mission": name, "digest": digest, "length [m]": "61.4"}
        self.missions.hear(values | {"begun at [s]": begun, "flown share": "0.5"}, 9.0, 9.0)


@pytest.fixture
def plan(short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Plan:
    monkeypatch.setenv("ROS_DOMAIN_ID", "42")
    return mission_plan.make(Options(mission=str(short_mission), wait=True), tmp_path)


def wait(
    plan: Plan,
    script: Script,
    answer: Script | None = None,
    check: Callable[[bool], None] = lambda _: None,
    late: int = 0,
) -> tuple[Outcome, str]:
    text = io.StringIO()
    graph = Graph(script, list(answer or []), plan.mission.digest, late)
    progress = ProgressDisplay(plan.mission.path, Console(file=text, width=140))
    try:
        outcome = StandBy(plan, graph, progress, graph, check).run()  # type: ignore[arg-type]
    except MissionFailed:
        return Outcome("failed", "", 0.0, 0.0), text.getvalue()
    assert graph.aborts == 1
    return outcome, text.getvalue()


IDLE, RUNS, DONE = ("idle", "", "short"), ("running", "5.0", "short"), ("complete", "5.0", "short")
ABORTED, OTHER = ("aborted", "5.0", "short"), ("complete", "7.0", "other")


@pytest.mark.parametrize(
    ("script", "answer", "state", "code"),
    [
        ([IDLE], [("aborted", "", "short")], "idle", 0),
        ([IDLE, RUNS, DONE], [], "complete", 0),
        ([IDLE, RUNS, ABORTED], [], "aborted", 1),
        ([IDLE, RUNS], [ABORTED], "interrupted", 130),
        ([IDLE, RUNS], [DONE], "complete", 0),  # while Ctrl-C was pressed
        ([IDLE, RUNS, DONE, ("running", "6.0", "short")], [("aborted", "6.0", "short")], "interrupted", 130),
        ([IDLE, RUNS, DONE], [("running", "6.0", "short"), ("aborted", "6.0", "short")], "interrupted", 130),
        ([IDLE, ("running", "", "short")], [("aborted", "", "short")], "interrupted", 130),
        ([IDLE, RUNS, ABORTED, ("running", "7.0", "other"), OTHER], [], "complete", 0),
    ],
)
def test_the_last_mission_decides(plan: Plan, script: Script, answer: Script, state: str, code: int) -> None:
    outcome, text = wait(plan, list(script), answer)
    assert (outcome.state, mission_flight._EXIT[outcome.state]) == (state, code)
    begun = {begun for _, begun, _ in [*script, *answer] if begun}
    assert text.count(", flown 50.0 % of 61.4 m") == len(begun)
    assert "ROS_DOMAIN_ID=42 ros2 service call /auv/start std_srvs/srv/Trigger" in text
    assert outcome.other == ("other" if script[-1] == OTHER else "")


def test_the_report_of_a_complete_mission_may_come_after_ctrl_c(plan: Plan) -> None:
    outcome, text = wait(plan, [IDLE, RUNS], [DONE], late=100)
    assert (outcome.state, "short: complete, flown" in text) == ("complete", True)
    outcome, _ = wait(plan, [IDLE, RUNS], [DONE], late=10_000)
    assert outcome.state == "interrupted", "guidance is dead"


def test_what_was_flown_is_listed_where_a_node_dies_later(plan: Plan) -> None:
    script = [IDLE, RUNS, DONE, IDLE]

    def check(_: bool) -> None:
        if len(script) == 1:
            raise MissionFailed("guidance ended")

    outcome, text = wait(plan, script, check=check)
    assert (outcome.state, "short: complete, flown" in text) == ("failed", True)


def test_time_has_to_pass_only_while_a_mission_runs(plan: Plan) -> None:
    asked: list[bool] = []
    wait(plan, [IDLE, RUNS, ("holding", "5.0", "short"), RUNS, DONE, IDLE], check=asked.append)
    assert asked == [False, False, True, False, True, False]


def test_a_mission_that_was_not_planned_has_no_figures(
    short_mission: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    flown = Outcome("complete", "", 1.0, 2.0, since=7.0, other="other")
    monkeypatch.setattr(launcher, "fly", lambda *_: flown)
    options = Options(mission=str(short_mission), wait=True, out=tmp_path / "run")
    assert mission_flight.fly(options, None, 42) == 0  # type: ignore[arg-type]
    assert "no figures: the last mission flown was other, not short" in capsys.readouterr().out
    assert not (tmp_path / "run" / "summary.json").exists()
