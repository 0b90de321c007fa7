"""A sea over the graph, in lockstep: as random as in `closed_loop`, and frames change nothing."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_sim.bags.reading.load import load, load_messages
from auv_sim.cli.mission import main
from auv_sim.flight import closed_loop
from auv_sim.flight.run_record import Run
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options

SEA = str(Path(__file__).parent / "data" / "sea.yaml")
_FRAMES = """
/**/remus_plant:
  ros__parameters: {{world_frame: {world}, body_frame: {body}}}
"""


def difference(run: Run, other: Run, column: str) -> float:
    """The largest difference in a column; an angle's is taken round the circle."""
    apart = np.abs(getattr(run, column) - getattr(other, column))
    if column.startswith("psi"):
        apart = np.minimum(apart % (2.0 * np.pi), 2.0 * np.pi - apart % (2.0 * np.pi))
    return float(apart.max())


def test_a_sea_over_the_graph_equals_closed_loop(short_mission: Path, tmp_path: Path, domain: int) -> None:
    run = tmp_path / "run"
    asked = ["--mission", str(short_mission), "--sea", SEA, "--seed", "3", "--current", "0.0", "0.05"]
    asked += ["--flown", "0"]  # the odometry is off by more than a flown cell may be
    assert main([*asked, "--quiet", "--composed", "--domain", str(domain), "--out", str(run)]) == 0
    options = Options(mission=str(short_mission), sea=SEA, seed=3, current=(0.0, 0.05))
    reference = closed_loop.fly(mission_plan.make(options, tmp_path).scenario())
    flown = load(run / "bag")
    assert flown.steps == reference.steps
    for column in (
        "x", "y", "psi", "r", "ur", "vr", "rudder", "rudder_cmd", "psi_d", "s", "Vx_est",
        "Vx_true", "Vy_true", "x_true", "y_true", "psi_true",
    ):  # fmt: skip
        assert difference(flown, reference, column) < 1e-9, column
    # To the last bit: over minutes a dead band and a rudder in saturation would make centimetres of less.
    for column in ("x_true", "y_true", "rudder_cmd", "r", "ur"):
        assert (getattr(flown, column) == getattr(reference, column)).all(), column
    # The odometry errs, and the figures are of where the vehicle really was.
    assert 0.05 < np.hypot(flown.x - flown.x_true, flown.y - flown.y_true).max() < 5.0
    summary = json.loads((run / "summary.json").read_text())
    track = np.stack([flown.x_true, flown.y_true])
    assert summary["distance_covered"] == pytest.approx(np.hypot(*np.diff(track)).sum(), rel=0.02)
    # Without bottom lock the twist says so.
    twists = [message.twist.twist.linear.x for _, message in load_messages(run / "bag", topics.ODOM.name)]
    assert np.isnan(twists).any()
    assert not np.isnan(twists).all()
    # The run directory flies again as it stands: the same sea, the same seed.
    again = Options(
        mission=str(run / "config" / "mission.yaml"),
        vehicle=str(run / "config" / "vehicle.yaml"),
        params=str(run / "config" / "params.yaml"),
    )
    second = closed_loop.fly(mission_plan.make(again, tmp_path).scenario())
    assert (second.x_true == reference.x_true).all()


def test_vehicles_that_speak_ned_and_enu_fly_to_the_same_track(
    short_mission: Path, tmp_path: Path, domain: int
) -> None:
    """The whole graph with the simulator in either convention, in a sea, with its truth in the bag."""
    runs = {}
    for world, body in (("map", "base_link"), ("auv/map_ned", "auv/base_link_frd")):
        params = tmp_path / f"{body.rsplit('/', maxsplit=1)[-1]}.yaml"
        params.write_text(_FRAMES.format(world=world, body=body), encoding="utf-8")
        out = params.with_suffix("")
        asked = [
            "--mission",
            str(short_mission),
            "--params",
            str(params),
            "--sea",
            SEA,
            "--quiet",
            "--composed",
            "--flown",
            "0",
        ]
        assert main([*asked, "--domain", str(domain), "--out", str(out)]) == 0
        runs[world] = load(out / "bag")
        message = load_messages(out / "bag", topics.TRUE_ODOM.name)[0][1]
        assert (message.header.frame_id, message.child_frame_id) == (world, body)
    enu, ned = runs.values()
    assert enu.steps == ned.steps
    for column in ("x", "y", "psi", "r", "vr", "rudder", "rudder_cmd", "ye", "x_true", "y_true", "psi_true"):
        assert difference(enu, ned, column) < 1e-9, column
