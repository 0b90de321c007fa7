"""The table of expectations: complete, and the one that docs/safety.md prints."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings.schema import leaves
from auv_sim.checks.faults.expectations import QUICK, REPRESENTATIVE, TABLE, as_markdown, chosen
from auv_sim.checks.faults.fault_session import summary
from auv_sim.checks.faults.row_judge import RowResult
from auv_sim.nodes.fault_injection import FAULTS
from auv_sim.nodes.fault_relay import RELAYED
from auv_sim.nodes.message_faults import DEPTH_FAULTS
from auv_sim.sim_parameters import SUITE

PAGE = Path(__file__).resolve().parents[4] / "docs" / "safety.md"
#: A text has no number that can jump, no frame, and its past cannot be told from its present.
NOT_FOR_A_TEXT = {"jump", "reverse", "frameless", "timeless"}


def test_the_page_prints_the_table() -> None:
    """`python -m auv_sim.checks.faults.expectations` prints what belongs there."""
    printed = re.search(
        r"<!-- table: begin -->\n(.*?)<!-- table: end -->", PAGE.read_text(encoding="utf-8"), re.DOTALL
    )
    assert printed is not None
    assert printed.group(1) == as_markdown()


@pytest.mark.parametrize("name", RELAYED)
def test_every_fault_of_every_topic_has_a_row(name: str) -> None:
    wanted = set(FAULTS)
    if "Float64" in RELAYED[name].type:
        wanted -= {"frameless", "timeless"}
    if "String" in RELAYED[name].type:
        wanted -= NOT_FOR_A_TEXT
    else:
        wanted -= {"forge"}
    if name != topics.ODOM.name:
        wanted -= set(DEPTH_FAULTS)
    if name != topics.THRUST_CMD.name:
        wanted -= {"weak"}
    assert {row.fault for row in TABLE if row.place == name} == wanted


def test_every_node_is_killed() -> None:
    """A driver stands where the simulator stands, and is not of the graph that the matrix flies."""
    graph = {topics.PLANT, topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT, topics.RECORDER}
    assert {row.place for row in TABLE if row.fault == "kill"} == graph


def test_the_bounds_are_set_by_parameters_that_exist() -> None:
    known = {leaf.name for cls in SUITE.values() for leaf in leaves(cls)}
    for row in TABLE:
        assert not row.set_by or set(row.set_by.split(", ")) <= known, row.name


@pytest.mark.parametrize("row", TABLE, ids=lambda row: row.name)
def test_a_row_does_not_contradict_itself(row) -> None:  # type: ignore[no-untyped-def]
    assert bool(row.noticed_by) == bool(row.says) == (row.within > 0.0)
    assert row.noticed_by in {"", *SUITE}
    assert (row.safe > 0.0) == (row.outcome != "goes on")
    assert row.lasts >= row.safe
    assert row.wall or row.then_abort or row.fault == "kill" or row.lasts >= row.within
    assert row.fault != "jump" or row.place != topics.ODOM.name or row.lasts < 3.0  # else it is accepted


def test_a_vehicle_that_dives_has_a_row_for_each_of_its_faults() -> None:
    """Depth, attitude, planes, thruster, buoyancy, altimeter; each in the flight in which it can show."""
    flights = {row.name: row.flight for row in TABLE}
    dives = [f"odom {fault}" for fault in DEPTH_FAULTS]
    dives += ["sternplane_cmd freeze", "thrust_cmd weak", "remus_plant heavy", "remus_plant light"]
    assert {flights[name] for name in dives} == {"dive"}
    assert {row.flight for row in TABLE if row.place == topics.ALTITUDE.name} == {"bottom"}
    assert [row.name for row in TABLE if row.surfaces] == ["remus_plant heavy"]


def test_names_are_unique_and_choose() -> None:
    names = [row.name for row in TABLE]
    assert len(set(names)) == len(names)
    assert [row.name for row in chosen(("odom nan", "odom stop"))] == ["odom stop", "odom nan"]
    assert len(chosen(QUICK)) == len(QUICK) > len(REPRESENTATIVE)
    assert {row.flight for row in chosen(QUICK)} == {"plane", "dive", "bottom"}
    with pytest.raises(KeyError):
        chosen(("odom burn",))


def test_the_last_line_counts_the_rows_that_a_busy_machine_made_late() -> None:
    """At 4 times real time 0.25 s of wall time are 1 s; neither a missing nor a failed report counts."""
    stop, freeze = chosen(("odom stop", "velocity_through_water freeze"))  # 0.6 s to both; no report
    on_time, failed = RowResult(stop, 0.6, 0.6), RowResult(stop, 2.0, 2.0, ["noticed too late"])
    assert summary([on_time, RowResult(freeze)], 9.0, 4.0) == (
        "2 of 2 rows as docs/safety.md says, in 9 s of wall time at 4 times real time"
    )
    late = [RowResult(stop, 0.65, 0.6), RowResult(stop, 0.55, 0.7)]
    assert summary([*late, on_time, failed], 9.0, 4.0) == (
        "3 of 4 rows as docs/safety.md says (2 within the allowance for a busy machine),"
        " in 9 s of wall time at 4 times real time"
    )
