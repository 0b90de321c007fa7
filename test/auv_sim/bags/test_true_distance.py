"""In a sea every table and picture shows the true distance, with the odometry's beside it, and says which."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.typing import NDArray
from rich.console import Console

from auv_path_following.missions import mission_file
from auv_sim.bags.content.flown_settings import differences
from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.showing import compare_picture, inspect_tables
from auv_sim.bags.showing.report_data import page_data
from auv_sim.bags.verbs import compare
from auv_sim.bags.verbs.inspect import as_data
from auv_sim.flight.by_odometry import by_odometry
from auv_sim.flight.run_record import Run

#: How far beside the path the vehicle is, and assumes to be, m.
TRUE, ASSUMED = 1.5, 0.25
STEPS = 50


def flight(truth: bool = True) -> RecordedMission:
    """Along the first subpath, a line, beside it."""
    mission = mission_file.load("paper_composite")
    points = [mission.path.evaluate(0, share) for share in np.linspace(0.05, 0.95, STEPS)]

    def beside(offset: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        x = np.array([p.x - offset * np.sin(p.chi) for p in points])
        return x, np.array([p.y + offset * np.cos(p.chi) for p in points])

    columns: dict[str, Any] = dict(zip(("x", "y"), beside(ASSUMED), strict=True))
    if truth:
        columns |= dict(zip(("x_true", "y_true"), beside(TRUE), strict=True))
        columns["psi_true"] = np.array([p.chi for p in points])
    columns |= {
        "t": np.arange(STEPS) * 0.5,
        "psi": np.array([p.chi for p in points]),
        "s": np.linspace(0.05, 0.95, STEPS),
        "psi_e": np.zeros(STEPS),
        "rudder": np.zeros(STEPS),
        "thrust_cmd": np.full(STEPS, 6.0),
    }
    return RecordedMission(Bag(Path("sea")), Run.from_columns(columns), mission, None, [])


def decoded(text: str) -> NDArray[np.float32]:
    return np.frombuffer(base64.b64decode(text), "<f4")


def test_the_odometrys_distance_is_judged_beside_the_true_one() -> None:
    flown = flight()
    own = flown.by_odometry
    assert own is not None and flown.summary is not None
    assert own.rms == pytest.approx(ASSUMED)
    assert own.largest == pytest.approx(ASSUMED)
    assert own.subpaths[0] == pytest.approx(ASSUMED)
    assert np.isnan(own.subpaths[1:]).all()
    assert flown.summary.rms_distance == pytest.approx(TRUE)


def test_without_a_truth_there_is_one_distance_only() -> None:
    flown = flight(truth=False)
    assert flown.run is not None and flown.mission is not None
    assert by_odometry(flown.run, flown.mission.path) is None
    data = page_data(flown, [], "title")
    assert "distance_by_odometry" not in data["columns"]
    assert "track_x" not in data["columns"]
    np.testing.assert_allclose(decoded(data["columns"]["distance"]), ASSUMED, rtol=1e-5)
    assert len(data["table"][0]) == 6


def test_the_page_shows_the_distance_of_its_table() -> None:
    flown = flight()
    data = page_data(flown, [], "title")
    np.testing.assert_allclose(decoded(data["columns"]["distance"]), TRUE, rtol=1e-5)
    np.testing.assert_allclose(decoded(data["columns"]["distance_by_odometry"]), ASSUMED, rtol=1e-4)
    assert flown.run is not None
    np.testing.assert_allclose(decoded(data["columns"]["track_x"]), flown.run.x_true, rtol=1e-6)
    labels = {s["name"]: s["label"] for panel in data["panels"] for s in panel.get("series", [])}
    assert labels["distance"] == "true distance"
    assert labels["distance_by_odometry"] == "by odometry"
    heads, first = data["table"][0], data["table"][1]
    assert first[heads.index("rms dist. (m)")] == f"{TRUE:.3f}"
    assert first[heads.index("rms by odometry (m)")] == f"{ASSUMED:.3f}"
    assert ("rms distance", f"{TRUE:.3f} m") in data["facts"]
    assert ("by its odometry", f"rms {ASSUMED:.3f} m, largest {ASSUMED:.2f} m") in data["facts"]


def test_the_comparison_draws_the_distance_of_its_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[Figure] = []
    monkeypatch.setattr(compare_picture, "save", lambda figure, *_: drawn.append(figure))
    flown = flight()
    compare_picture.draw([flown, flight(truth=False)], ["sea", "calm"], tmp_path / "a.png")
    lines = {str(line.get_label()): line.get_ydata() for line in drawn[0].axes[1].lines}
    assert set(lines) == {"sea", "sea, by its odometry", "calm"}
    np.testing.assert_allclose(np.asarray(lines["sea"]), TRUE)
    np.testing.assert_allclose(np.asarray(lines["sea, by its odometry"]), ASSUMED)
    np.testing.assert_allclose(np.asarray(lines["calm"]), ASSUMED)
    assert flown.run is not None
    tracks = {str(line.get_label()): line.get_ydata() for line in drawn[0].axes[0].lines}
    np.testing.assert_allclose(np.asarray(tracks["sea"]), flown.run.x_true)


def test_tables_name_both_distances() -> None:
    console = Console(width=200)
    flown = flight()
    assert flown.summary is not None
    with console.capture() as told:
        inspect_tables.show(flown, [], [], console)
        console.print(compare._table(["sea"], [flown.summary], [flown.by_odometry]))
    assert f"distance by odometry: rms {ASSUMED:.3f} m" in told.get()
    assert f"{TRUE:.4f}" in told.get()
    assert "rms by odometry m" in told.get()
    data = json.loads(json.dumps(as_data(flown, [], [])))
    assert data["by_odometry"]["rms_distance"] == pytest.approx(ASSUMED)
    assert data["mission"]["rms_distance"] == pytest.approx(TRUE)


def with_sea(where: str, sea: str, gain: float = 0.1) -> Bag:
    """A recording of a mission whose files lay in `where`."""
    params = {
        "/auv/remus_plant": {"ros__parameters": {"sea": f"{where}/config/sea.yaml", "seed": 3}},
        "/auv/ailos_guidance": {"ros__parameters": {"mission": f"{where}/m.yaml", "guidance": {"kp": gain}}},
        "/auv/recorder": {"ros__parameters": {"directory": f"{where}/bag"}},
    }
    return Bag(Path(where) / "bag", texts={"params.yaml": json.dumps(params), "sea.yaml": sea})


def test_an_identical_sea_elsewhere_is_no_difference() -> None:
    sea = "name: rough\ncurrent: {mean: [0.1, 0.2]}\n"
    assert differences([with_sea("/runs/a", sea), with_sea("/runs/b", sea)]) == {}
    assert differences([with_sea("/a", sea, gain=2), with_sea("/b", sea, gain=2.0)]) == {}
    other = sea.replace("0.2", "0.3")
    assert differences([with_sea("/runs/a", sea), with_sea("/runs/b", other, gain=0.2)]) == {
        "sea.yaml current.mean": ["[0.1, 0.2]", "[0.1, 0.3]"],
        "ailos_guidance guidance.kp": ["0.1", "0.2"],
    }
    assert differences([with_sea("/runs/a", sea), Bag(Path("b"))])["remus_plant seed"] == ["3", None]
    assert (
        differences([Bag(Path("a"), texts={"params.yaml": "[1, 2]", "sea.yaml": "5"}), Bag(Path("b"))]) == {}
    )
