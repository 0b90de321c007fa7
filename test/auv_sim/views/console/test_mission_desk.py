"""Missions for the page: the list, the check of a text, and the joints of a path."""

from __future__ import annotations

import asyncio
import math
from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_sim.views.console import plan_apart
from auv_sim.views.console.mission_desk import MissionShelf, check_text, draft_of, facts_of, joints_of

LINE = """\
version: 1
name: line
frame: ned
thrust: 6.48
segments: [{line: {start: [0, 0], length: 50, course_deg: 0}}]
"""


def test_the_check_of_a_text_prints_what_the_plan_prints() -> None:
    found = check_text(LINE, "remus100")
    assert found.ok
    assert found.lines[0].startswith("line: 1 subpaths, 50.0 m, 2")
    assert found.lines[0].endswith("no fault found")
    refused = check_text(LINE + "geofence: [[0, -5], [20, -5], [20, 5], [0, 5]]\n", "remus100")
    assert not refused.ok
    assert refused.lines[0].endswith("refused")
    assert refused.lines[1].startswith("refused geofence: found ")
    wrong = check_text(LINE + "colour: red\n", "remus100")
    assert (wrong.ok, len(wrong.lines)) == (False, 1)
    assert "colour" in wrong.lines[0]
    deep = check_text(LINE + "depth: 5\n", "remus100")
    assert "a planar mission" in deep.lines[0]
    assert check_text(LINE + "depth: 5\n", "remus100_6dof").ok


@pytest.mark.parametrize("text", ["", "\x00", "- 1", "version: [", "x" * 500_000, "a: &a [*a]", "🚤"])
def test_any_text_gets_a_line(text: str) -> None:
    found = check_text(text, "remus100")
    assert (found.ok, len(found.lines)) == (False, 1)
    assert found.lines[0].isprintable()


def test_a_draft_is_thinned_and_ends_with_its_path() -> None:
    draft = draft_of(LINE.replace("length: 50", "length: 33333.33333"), "remus100")
    assert len(draft["path"]) <= 8000
    assert draft["path"][-1] == [0.0, 33333.333, 0.0, 33333.333]


def test_a_check_in_its_own_process_has_the_same_result(monkeypatch: pytest.MonkeyPatch) -> None:
    found = asyncio.run(plan_apart.checked_text(LINE, "remus100"))
    assert found == {
        "ok": True, "lines": list(check_text(LINE, "remus100").lines), "course": draft_of(LINE, "remus100"),
    }  # fmt: skip
    digest = mission_file.read_text(LINE).digest
    asked = (digest, "", LINE, "remus100")
    assert asyncio.run(plan_apart.facts_of(*asked)) == facts_of(*asked)
    monkeypatch.setattr(plan_apart, "LONGEST", 0.0)
    with pytest.raises(plan_apart.CheckFailed, match="longer than 0 s"):
        asyncio.run(plan_apart.checked_text(LINE, "remus100"))


def test_joints_lie_on_the_path_and_end_with_it() -> None:
    hull = vehicle.load("remus100")
    mission = mission_file.load("paper_composite", hull)
    joints = joints_of(mission, hull)
    assert [joint["kind"] for joint in joints] == [s.kind for s in mission.path.segments[1:]] + ["end"]
    assert joints[-1]["s"] == pytest.approx(mission.path.length)
    for joint, found in zip(mission.path.joints, joints, strict=False):
        assert (found["x"], found["y"]) == pytest.approx((joint.y, joint.x))
    diver = vehicle.load("remus100_6dof")
    deep = mission_file.load("helix", diver)
    assert deep.spatial is not None
    joints = joints_of(deep, diver)
    assert joints[-1]["s"] == pytest.approx(deep.spatial.length)
    assert min(joint["z"] for joint in joints) < -1.0, "up is positive"


def test_facts_count_for_the_mission_that_guidance_has_alone() -> None:
    digest = mission_file.load("paper_composite").digest
    facts = facts_of(digest, "paper_composite", "", "remus100")
    assert facts.plan is not None
    assert (facts.plan.ok, facts.dives, len(facts.joints)) == (True, False, 7)
    other = facts_of("another", "paper_composite", "", "remus100")
    assert (other.plan, other.joints) == (None, [])
    gone = facts_of("another", "/of/another/machine.yaml", "", "remus100")
    assert (gone.digest, gone.plan, gone.joints) == ("another", None, [])
    text = facts_of(mission_file.read_text(LINE).digest, "", LINE, "remus100")
    assert math.isclose(text.joints[0]["s"], 50.0)


def test_the_shelf_offers_shipped_missions_and_those_of_a_folder(tmp_path: Path) -> None:
    (tmp_path / "own.yaml").write_text(LINE + "description: of mine\n")
    (tmp_path / "broken.yaml").write_text("version: [")
    shelf = MissionShelf(tmp_path)
    listed = {each["name"]: each["description"] for each in shelf.listed()}
    assert set(config_files.shipped("missions")) <= set(listed)
    assert listed["own"] == "of mine"
    assert "broken.yaml" in listed["broken"]
    assert shelf.text_of("own").startswith("version: 1")
    for name in ("../own", "nothing", "/etc/passwd", ""):
        with pytest.raises(ConfigurationError, match="a mission of the list"):
            shelf.text_of(name)
    with pytest.raises(ConfigurationError, match="--missions"):
        MissionShelf(tmp_path / "own.yaml")
