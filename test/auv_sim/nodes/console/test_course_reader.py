"""The plan of a mission counts once its file was checked, and no earlier."""

from __future__ import annotations

from types import SimpleNamespace

from auv_msgs_py.contract import topics
from auv_sim.nodes.console.course_reader import CourseReader
from auv_sim.views.console.mission_desk import MissionFacts
from auv_sim.views.console.record.readiness import PlanLines
from auv_sim.views.console.record.vehicle_record import VehicleRecord


def test_until_its_file_is_checked_a_plan_refuses_the_start() -> None:
    record = VehicleRecord(0, "/auv")
    course = CourseReader(record)
    points = [SimpleNamespace(x=float(x), y=0.0, z=0.0) for x in range(3)]
    poses = [SimpleNamespace(pose=SimpleNamespace(position=point)) for point in points]
    course.readers()[topics.PATH](SimpleNamespace(poses=poses))
    for digest, plan in (("a", PlanLines(True, ("a: flyable",))), ("b", None)):
        record.progress.status = {"digest": digest}
        course.look()
        assert record.plan == PlanLines(False, ("the plan is being checked",))
        course.take_facts(MissionFacts(digest, [], False, plan))
        course.look()
        assert record.plan is not None
        assert record.plan.ok, "a file on another machine was checked there"
        assert ("not on this machine" in record.plan.lines[0]) == (plan is None)
