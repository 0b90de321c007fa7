"""The verbs that read a recording, on that of a vehicle that dives."""

from __future__ import annotations

import base64
import csv
import json
import os
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from auv_msgs_py.settings import yaml_file
from auv_sim.bags.content.recorded_mission import mission_in
from auv_sim.bags.playing.playback import select
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.showing.report_data import page_data
from auv_sim.bags.verbs.report import page_of
from auv_sim.cli import bag as bag_command
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import SpatialRun
from auv_sim.views import signal_panels as panels

ROOT = Path(__file__).resolve().parents[4]
VERTICAL = ("sternplane_cmd", "desired_pitch", "desired_pitch_rate", "desired_depth")


def test_a_rerun_commands_the_recorded_bits(dive: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert bag_command.main(["rerun", str(dive), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["steps"] > 600
    assert set(found["topics"]) > set(VERTICAL)
    for name, figures in found["topics"].items():
        assert figures["identical"] == figures["compared"] >= found["steps"] - 1, name


def test_a_rerun_with_another_gain_of_the_pitch_moves_the_planes_alone(
    dive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    gains = {"/**/heading_autopilot": {"ros__parameters": {"pitch": {"controller": "pid"}}}}
    yaml_file.dump(gains, tmp_path / "new.yaml")
    asked = ["--params", str(tmp_path / "new.yaml"), "--png", str(tmp_path / "rerun.png")]
    assert bag_command.main(["rerun", str(dive), *asked]) == 0
    shown = capsys.readouterr().out
    assert "bit for bit" not in shown
    assert "stern planes new: travel" in shown
    assert bag_command.main(["rerun", str(dive), *asked, "--json"]) == 0
    topics = json.loads(capsys.readouterr().out)["topics"]
    assert topics["sternplane_cmd"]["largest"] > 0.1
    assert topics["rudder_cmd"]["identical"] == topics["rudder_cmd"]["compared"]
    assert (tmp_path / "rerun.png").read_bytes().startswith(b"\x89PNG")


def test_an_export_has_the_columns_that_the_page_lists(dive: Path, tmp_path: Path) -> None:
    assert bag_command.main(["export", str(dive), "--out", str(tmp_path / "dive.csv")]) == 0
    with (tmp_path / "dive.csv").open(encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    section = (
        (ROOT / "docs" / "bags.md").read_text(encoding="utf-8").split("## export")[1].split("## replay")[0]
    )
    listed = [
        name for line in re.findall(r"^\| (.*?) \|", section, re.M) for name in re.findall(r"`(\w+)`", line)
    ]
    assert sorted(listed) == sorted(column.split(" [")[0] for column in head)
    depth = [float(row[head.index("z [m]")]) for row in rows]
    assert (min(depth), max(depth)) == pytest.approx((3.0, 5.0), abs=0.1)


def test_a_damaged_dive_is_repaired_played_and_rerun(
    dive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "copy"
    shutil.copytree(dive, copy, ignore=shutil.ignore_patterns("*.png", "log"))
    (file,) = (copy / "bag").glob("*.mcap")
    os.truncate(file, file.stat().st_size * 9 // 10)
    (copy / "bag" / "metadata.yaml").unlink()
    assert bag_command.main(["repair", str(copy)]) == 0
    assert "whole" in capsys.readouterr().out
    assert bag_command.main(["rerun", str(copy), "--json"]) == 0  # 0: the recorded bits
    assert json.loads(capsys.readouterr().out)["topics"]["sternplane_cmd"]["compared"] > 500
    chosen = select(read_bag(copy), None, [], {}, 0.0, None, False)
    played = {name.rsplit("/", 1)[-1] for name in chosen.topics}
    assert played > {*VERTICAL, "sternplane_state", "path_error_3d"}


def test_the_overview_of_a_dive_has_a_row_more_and_a_surface(dive: Path) -> None:
    with Image.open(dive / "overview.png") as image:
        picture = np.asarray(image.convert("RGB"), dtype=np.int16)
    assert picture.shape == (1000, 1600, 3)
    green = np.abs(picture[:, 800:] - np.array([42, 157, 111])).max(axis=2) < 12
    assert green.sum(axis=1).max() > 300, "the surface"
    summary = json.loads((dive / "summary.json").read_text())
    assert 0.0 < summary["rms_depth_error"] < summary["largest_depth_error"] < 0.2


def test_depth_increases_downwards_and_the_surface_is_on_top(dive: Path) -> None:
    flight = mission_in(read_bag(dive))
    run, path = flight.run, flight.spatial
    assert isinstance(run, SpatialRun)
    assert path is not None
    flown = under_way(run, path.n)
    assert isinstance(flown, SpatialRun)
    axes = Figure().add_subplot()
    panels.depth(axes, flown.t - flown.t[0], flown, path)
    bottom, top = axes.get_ylim()
    assert bottom > run.z.max() > 4.9
    assert top < 0.0
    lines = {line.get_label(): line for line in axes.get_lines()}
    assert set(lines) == {"path", "requested", "depth", "surface"}
    depth = np.asarray(lines["path"].get_ydata(), float)
    assert (depth.min(), depth.max()) == pytest.approx((3.0, 5.0), abs=0.02)


def test_the_dive_is_drawn_in_three_dimensions_and_over_the_length_of_path(dive: Path) -> None:
    with Image.open(dive / "dive.png") as image:
        picture = np.asarray(image.convert("RGB"), dtype=np.int16)
    assert picture.shape == (1000, 1600, 3)
    left, right = picture[:, :800], picture[:, 880:]
    surface, flown = np.array([42, 157, 111]), np.array([11, 95, 165])
    assert (np.abs(left - surface).max(axis=2) < 30).sum() > 200, "surface and start in three dimensions"
    top, below = right[100:450], right[700:930]
    for panel in (top, below):  # depth and pitch as flown
        assert (np.abs(panel - flown).max(axis=2) < 30).any(axis=0).sum() > 400


def test_report_draws_the_same_rows_and_the_figures_of_the_mission(dive: Path, tmp_path: Path) -> None:
    assert bag_command.main(["report", str(dive), "--out", str(tmp_path)]) == 0
    with Image.open(tmp_path / "overview.png") as ours, Image.open(dive / "overview.png") as theirs:
        rows = slice(120, 950)  # without title and command line
        new, old = (np.asarray(image.convert("RGB"))[rows] for image in (ours, theirs))
    np.testing.assert_array_equal(new, old)


def test_inspect_and_compare_and_the_page_have_the_vertical(
    dive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert bag_command.main(["inspect", str(dive)]) == 0
    shown = capsys.readouterr().out
    assert "depth 3.00 to 5.0" in shown
    assert "stern planes -" in shown
    assert re.search(r"planes\s+pitch|planes °/m +pitch °", shown)
    (whole,) = re.findall(r"^ all +(.*)$", shown, re.MULTILINE)
    summary = json.loads((dive / "summary.json").read_text())
    vertical = [
        summary[name] for name in ("rms_depth_error", "largest_depth_error", "sternplane_travel_per_metre")
    ]
    assert [float(cell) for cell in whole.split()[-4:-1]] == pytest.approx(vertical, abs=6e-4)
    asked = ["--png", str(tmp_path / "c.png"), "--json"]
    assert bag_command.main(["compare", str(dive), str(dive / "bag"), *asked]) == 0
    with Image.open(tmp_path / "c.png") as compared:
        assert compared.size == (2000, 1200), "with the rows of depth and depth error"
    for figures in json.loads(capsys.readouterr().out)["runs"].values():
        assert 0.0 < figures["rms_depth_error"] < 0.1
    data = page_data(mission_in(read_bag(dive)), [], "a dive")
    panels_of = {panel["title"]: panel for panel in data["panels"]}
    assert panels_of["Depth (m; down, the surface is 0)"]["down"] is True
    assert {line["name"] for line in panels_of["Pitch (°; bow up is positive)"]["series"]} == {
        "theta",
        "theta_d",
    }
    assert "Stern planes (°; bow down is positive)" in panels_of
    columns = {name: np.frombuffer(base64.b64decode(text), "<f4") for name, text in data["columns"].items()}
    depth = columns["depth"]
    assert (depth.min(), depth.max()) == pytest.approx((3.0, 5.0), abs=0.1)
    summary = json.loads((dive / "summary.json").read_text())
    assert np.nanmax(columns["distance"]) == pytest.approx(summary["largest_distance"], abs=1e-4)
    assert np.nanmax(np.abs(columns["depth_error"])) == pytest.approx(
        summary["largest_depth_error"], abs=1e-4
    )
    way = columns["way"]
    assert (np.diff(way) >= 0.0).all()
    assert way[-1] == pytest.approx(summary["path_length"], abs=1e-3)
    assert data["table"][0][-1] == "largest depth error (m)"


def test_the_page_has_the_path_in_three_dimensions_and_the_scripts_that_draw_it(dive: Path) -> None:
    flight = mission_in(read_bag(dive))
    page = page_of(flight)
    assert "http" not in page.split('<script id="data"')[0] + page.split("/* ---- words ---- */")[1]
    assert 'id="space"' in page
    assert "function project(" in page
    space = page_data(flight, [], "a dive")["space"]
    north, east, depth = (np.frombuffer(base64.b64decode(space["path"][axis]), "<f4") for axis in "xyz")
    assert (north[0], east[0], depth[0]) == pytest.approx((0.0, 0.0, 3.0))
    assert (north[-1], east[-1], depth[-1]) == pytest.approx((40.0, 40.0, 4.0), abs=1e-3)
    assert depth.max() == pytest.approx(5.0, abs=1e-3)
    assert [colour["name"] for colour in space["colours"]] == ["distance", "depth_error", "ze"]
    assert space["bottom"] is space["mesh"] is None
    flight.mission = None  # then the path is the one that guidance published
    published = page_data(flight, [], "a dive")["space"]["path"]
    depths = np.frombuffer(base64.b64decode(published["z"]), "<f4")
    assert (depths[0], depths.max()) == pytest.approx((3.0, 5.0), abs=0.01)
