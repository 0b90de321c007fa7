"""`vehicle.py identify` from a recording of another maker to a vehicle file that flies; and its refusals."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following import vehicle as vehicle_file
from auv_sim.bags.content.recorded_manoeuvres import manoeuvres_in
from auv_sim.cli.vehicles import vehicle_command
from auv_sim.own_vehicle.identify.combinations import combinations_of
from auv_sim.own_vehicle.identify.hull_abilities import pole_of, radius_of
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.water_current import mean_current
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import Manoeuvred, simulate
from auv_sim.own_vehicle.verbs.identify_checks import check_target
from auv_sim.vehicle import sea as sea_file
from manoeuvre_bag import NAMES, write_manoeuvres

REMUS = vehicle_file.load("remus100")
OTHER_NAMES = NAMES | {"rudder_cmd": "/auv/fins/rudder", "odom": "/auv/nav"}


@pytest.fixture(scope="module")
def flown() -> Manoeuvred:
    """Two minutes of another vehicle than the known one, in a moderate sea."""
    h = REMUS.coefficients
    other = dataclasses.replace(
        REMUS,
        hull=dataclasses.replace(h, Nuud=-4.5, Nuv=-18.0, Yuv=-40.0),
        rudder=dataclasses.replace(REMUS.rudder, max_rate_deg_s=20.0, dead_time=0.07),
    )
    return simulate(other, sea_file.load("moderate"), program_file.load("two_minutes"), 3)


def test_a_recording_of_another_maker_becomes_a_vehicle_file_that_flies(
    flown: Manoeuvred, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = write_manoeuvres(tmp_path / "bag", flown, OTHER_NAMES, ned=True, repeated=False)
    out = tmp_path / "mine.yaml"
    words = ["identify", str(bag), "--out", str(out), "--log-latency", "0.1", "--dead-band", "0.2"]
    assert vehicle_command.main([*words, "--topic", "rudder_cmd=/auv/fins/rudder"]) == 0
    printed = capsys.readouterr().out
    assert "vehicle.py tune" in printed and "of 14 have" in printed
    assert out.with_suffix(".png").stat().st_size > 20_000
    found = vehicle_file.load(str(out))
    c, true = combinations_of(found.coefficients), combinations_of(REMUS.coefficients)
    assert c.Nuud / true.Nuud == pytest.approx(4.5 / 6.15, rel=0.06)
    assert found.rudder.dead_time == pytest.approx(0.12, abs=0.01)  # 0.07 s and the sea's 0.05 s
    assert found.rudder.max_rate_deg_s == pytest.approx(20.0, rel=0.01)
    assert pole_of(c, 2.0) > 0.5
    assert radius_of(c, REMUS, 1.0) == pytest.approx(radius_of(true, REMUS, 1.0), rel=0.2)
    assert "# assumed" in out.read_text() and "+-" in out.read_text()
    assert f"# Identified from {bag}.\n" in out.read_text()  # the name alone is `bag` in every run


def test_both_frames_and_repeated_samples_are_read_alike(flown: Manoeuvred, tmp_path: Path) -> None:
    ned = manoeuvres_in(write_manoeuvres(tmp_path / "ned", flown, ned=True))
    enu = manoeuvres_in(write_manoeuvres(tmp_path / "enu", flown, repeated=False))
    assert ned.water == pytest.approx(enu.water)
    assert ned.water_t == pytest.approx(enu.water_t)
    assert ned.water[:, 1] == pytest.approx(flown.water_v)
    assert ned.run.r == pytest.approx(flown.r) and enu.run.r == pytest.approx(flown.r)
    assert enu.rudder.value == pytest.approx(flown.rudder)
    assert np.nanmax(np.abs(enu.over[:, 1] - flown.v)) < 1e-9


def test_a_frame_id_of_another_maker_is_refused_until_its_axes_are_given(
    flown: Manoeuvred, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    short, words = _first(flown, 200), ["--out", str(tmp_path / "x.yaml")]
    bag = write_manoeuvres(tmp_path / "bag", short, body="base_footprint")
    assert "or their axes by --frame ID=AXES" in _refused(["identify", str(bag), *words], capsys)
    given = ["identify", str(bag), *words, "--frame", "base_footprint=flu"]
    assert "10 s of manoeuvres" in _refused(given, capsys)  # read, and too short
    assert "--frame: found flu" in _refused([*given, "--frame", "flu"], capsys)
    with pytest.raises(ConfigurationError, match="or their axes by --frame ID=AXES"):
        manoeuvres_in(bag)


def test_only_unknown_frame_ids_are_answered_with_the_option_for_them(
    flown: Manoeuvred, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = write_manoeuvres(tmp_path / "bag", _first(flown, 200))
    words = ["identify", str(bag), "--out", str(tmp_path / "x.yaml"), "--topic", "rudder_cmd=/frame/rudder"]
    refused = _refused(words, capsys)
    assert "found /frame/rudder" in refused
    assert "--frame" not in refused


def test_commands_may_be_whole_numbers(flown: Manoeuvred, tmp_path: Path) -> None:
    short = _first(flown, 200)
    found = manoeuvres_in(write_manoeuvres(tmp_path / "bag", short, command="std_msgs/msg/Int16"))
    assert found.thrust.value == pytest.approx(np.trunc(short.thrust))


def test_the_current_is_found_with_its_sign(flown: Manoeuvred) -> None:
    found = mean_current(planar_data(flown))
    north, east, _ = flown.current.mean(axis=0)
    assert found is not None
    assert (found.north, found.east) == pytest.approx((north, east), abs=0.02)
    assert north > 0.03 and east > 0.03


@pytest.mark.parametrize(
    ("missing", "found"),
    [("rudder_cmd", "no rudder_cmd"), ("velocity_through_water", "no velocity_")],
)
def test_a_missing_topic_costs_one_line(
    flown: Manoeuvred, tmp_path: Path, missing: str, found: str, capsys: pytest.CaptureFixture[str]
) -> None:
    names = {name: full for name, full in NAMES.items() if name != missing}
    bag = write_manoeuvres(tmp_path / "bag", _first(flown, 200), names)
    assert vehicle_command.main(["identify", str(bag), "--out", str(tmp_path / "x.yaml")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert found in line and "--topic" in line and "/auv/thrust_cmd" in line


def test_a_straight_run_is_refused_and_names_what_is_missing(
    flown: Manoeuvred, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    still = flown._replace(rudder=0.0 * flown.rudder, r=0.001 * flown.r)
    bag = write_manoeuvres(tmp_path / "bag", still)
    assert vehicle_command.main(["identify", str(bag), "--out", str(tmp_path / "x.yaml")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "zig-zags" in line


@pytest.mark.parametrize("late", [0.02, 3.0])
def test_commands_stand_at_the_time_of_their_log(flown: Manoeuvred, tmp_path: Path, late: float) -> None:
    """Also where their number happens to be that of the odometries."""
    short = _first(flown, 400)
    found = manoeuvres_in(write_manoeuvres(tmp_path / "bag", short, late=late)).rudder
    due = short.t + (0.0 if late < 0.05 else late + 0.001)  # one that answers its odometry has its stamp
    kept = due <= short.t[-1]
    assert found.t == pytest.approx(due[kept], abs=1e-6)
    assert found.value == pytest.approx(short.rudder[kept])


def test_commands_after_the_odometry_are_missing(
    flown: Manoeuvred, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = write_manoeuvres(tmp_path / "bag", _first(flown, 200), late=1000.0)
    line = _refused(["identify", str(bag), "--out", str(tmp_path / "x.yaml")], capsys)
    assert "no rudder_cmd" in line and "before the last odometry" in line


def test_a_clock_that_is_set_back_is_refused(flown: Manoeuvred, tmp_path: Path) -> None:
    short = _first(flown, 400)
    with pytest.raises(
        ConfigurationError, match=r"odom: found stamps that go back by [45]\.\d s, 10 s after"
    ):
        manoeuvres_in(write_manoeuvres(tmp_path / "bag", short, set_back=5.0))
    manoeuvres_in(write_manoeuvres(tmp_path / "jitter", short, set_back=0.12))


@pytest.fixture(scope="module")
def recorded(flown: Manoeuvred, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_manoeuvres(tmp_path_factory.mktemp("recorded") / "bag", flown, repeated=False)


@pytest.mark.parametrize(
    ("words", "where"),
    [
        (["--left-out", "0", "10000"], "--left-out: found 0 s of manoeuvres"),
        (["--left-out", "50", "10"], "--left-out: found 50 10"),
        (["--left-out", "9000", "9999"], "--left-out: found 9000 9999"),
        (["--topic", "rudder_cmd=/auv/odom", "--topic", "thrust_cmd=/auv/odom"], "--topic thrust_cmd: "),
        (["--topic", "odom=/auv/a", "--topic", "odom=/auv/b"], "--topic odom: found /auv/a and /auv/b"),
        (["--log-latency", "1e9"], "--log-latency: found 1e+09 s"),
        (["--dead-band", "90"], "--dead-band: found 90 deg"),
        (["--rudder-rate", "1e-300"], "--rudder-rate: found 1e-300 deg/s"),
        (["--log-scale", "1e300"], "--log-scale: found 1e+300"),
    ],
)
def test_options_that_fit_no_recording_cost_one_line(
    recorded: Path, tmp_path: Path, words: list[str], where: str, capsys: pytest.CaptureFixture[str]
) -> None:
    line = _refused(["identify", str(recorded), "--out", str(tmp_path / "x.yaml"), *words], capsys)
    assert line.startswith(where)


def test_swapped_topics_are_swapped_back(flown: Manoeuvred, tmp_path: Path) -> None:
    swapped = NAMES | {"rudder_cmd": NAMES["thrust_cmd"], "thrust_cmd": NAMES["rudder_cmd"]}
    short = _first(flown, 200)
    bag = write_manoeuvres(tmp_path / "bag", short, swapped)
    names = {"rudder_cmd": NAMES["thrust_cmd"], "thrust_cmd": NAMES["rudder_cmd"]}
    assert manoeuvres_in(bag, names).rudder.value == pytest.approx(short.rudder)


def test_no_file_is_lost(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_text((config_files.find("vehicles", "remus100")).read_text())
    (tmp_path / "drawn.png").write_text("a picture")
    before = {file.name: file.read_text() for file in tmp_path.iterdir()}
    for out, words, found in [
        ("mine.yaml", [], "which is read"),
        ("mine.yaml", ["--overwrite"], "which is read"),
        ("drawn.yaml", [], "drawn.png, which exists"),
        ("drawn.png", ["--overwrite"], "the name of a picture"),
    ]:
        given = ["identify", str(tmp_path / "bag"), "--vehicle", str(mine), "--out", str(tmp_path / out)]
        assert found in _refused([*given, *words], capsys)
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == before
    check_target(tmp_path / "drawn.yaml", [mine], True)


def test_a_study_replaces_no_result_unasked_and_begins_with_no_page_that_it_cannot_renew(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result, page = tmp_path / "mine.json", tmp_path / "page.md"
    result.write_text("of an hour")
    page.write_text("no marks")
    words = ["identify", "--study", "1", "--program", "none_such", "--out", str(tmp_path / "mine.yaml")]
    assert "mine.json, which exists" in _refused(words, capsys)
    assert "which is read" in _refused([*words, "--overwrite", "--page", str(result)], capsys)
    assert "a part to renew" in _refused([*words, "--overwrite", "--page", str(page)], capsys)
    assert "none_such" in _refused([*words, "--overwrite"], capsys)
    assert result.read_text() == "of an hour"


def _refused(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert vehicle_command.main(words) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_no_recording_costs_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert "no recording" in _refused(["identify"], capsys)


@pytest.mark.parametrize(
    ("words", "found"),
    [
        (["runs/none", "--dive"], "--dive: found no --study, expected --study N"),
        (["runs/none", "--sea", "rough"], "--sea: found no --study"),
        (["runs/none", "--first", "3"], "--first: found no --study"),
        (
            ["runs/none", "--study", "1", "--program", "none"],
            "BAG: found --study, expected recordings or --study",
        ),
        (["--study", "1", "--program", "none", "--log-latency", "0.1"], "--log-latency: found --study"),
        (["--study", "1", "--program", "none", "--frame", "x=flu"], "--frame: found --study"),
    ],
)
def test_an_option_without_effect_is_refused(
    words: list[str], found: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert found in _refused(["identify", *words], capsys)


def _first(flown: Manoeuvred, rows: int) -> Manoeuvred:
    n = flown.t.size
    kept = {
        name: column[:rows]
        for name, column in flown._asdict().items()
        if isinstance(column, np.ndarray) and column.shape[0] == n
    }
    return flown._replace(**kept)
