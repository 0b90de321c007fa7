"""The launcher makes the plan's check, and works out whose switching counts."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.missions import mission_file
from auv_sim.cli import mission as mission_command
from auv_sim.flight.closed_loop import fly
from auv_sim.flight.scenario import Scenario
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.sim_parameters import SUITE
from auv_sim.vehicle.remus import PlantState

TIGHT = Path(__file__).parents[1] / "cli" / "wrong_missions" / "20_turn_too_tight.yaml"


def _mission(folder: Path, more: str = "") -> str:
    file = folder / "own.yaml"
    route = "waypoints: {file: points/a.csv, smoothing: {kind: linear}}\n"
    file.write_text(f"version: 1\nname: own\nframe: ned\nthrust: 6\n{more}{route}", encoding="utf-8")
    (folder / "points").mkdir()
    (folder / "points" / "a.csv").write_text("north,east\n0,0\n50,0\n50,50\n", encoding="utf-8")
    return str(file)


def test_what_cannot_be_flown_is_refused_before_anything_starts(tmp_path, capsys):
    assert mission_command.main(["--mission", str(TIGHT), "--out", str(tmp_path / "run")]) == 2
    err = capsys.readouterr().err
    assert "1.21 m too tight" in err and "--force" in err and err.count("\n") == 1
    assert not (tmp_path / "run").exists()


def test_force_overrides(tmp_path):
    made = mission_plan.make(Options(mission=str(TIGHT), force=True), tmp_path)
    assert len(made.verdicts.refusals) == 1


def test_a_current_too_strong_is_refused(tmp_path):
    with pytest.raises(ConfigurationError, match=r"a current of 2\.50 m/s against a speed of 2\.00 m/s"):
        mission_plan.make(Options(current=(2.5, 0.0)), tmp_path)


def test_the_papers_mission_is_flown_with_warnings_only(tmp_path):
    made = mission_plan.make(Options(current=(0.1, 0.2)), tmp_path)
    assert not made.verdicts.refusals
    assert len(made.verdicts.warnings) == 2


@pytest.mark.parametrize(
    ("wish", "option", "expected"),
    [
        ("", None, ("g0", 6.0)),
        ("switching: {mode: all, radius: 3}\n", None, ("all", 3.0)),
        ("switching: {mode: all, radius: 3}\n", "off", ("off", 3.0)),
        ("", "off", ("off", 6.0)),
    ],
)
def test_option_before_mission_before_parameters(tmp_path, wish, option, expected):
    made = mission_plan.make(
        Options(mission=_mission(tmp_path, wish), params="paper", switching=option), tmp_path
    )
    guidance = made.parameters[topics.GUIDANCE]
    assert (guidance.guidance.switching.mode, guidance.guidance.switching.radius) == expected
    assert made.scenario().guidance.switching == guidance.guidance.switching


def test_the_written_configuration_flies_the_same_again(tmp_path):
    wish = "switching: {mode: all, radius: 3}\n"
    made = mission_plan.make(Options(mission=_mission(tmp_path, wish), switching="off"), tmp_path)
    written = made.write(tmp_path / "config")
    again = params_file.load(written, SUITE)[topics.GUIDANCE]
    copy = mission_file.load(again.mission)
    assert Path(again.mission).parent == tmp_path / "config"
    assert copy.waypoints == made.mission.waypoints
    assert again.with_mission_overrides(copy).guidance.switching.mode == "off"
    third = mission_plan.make(Options(mission=again.mission, params=str(written)), tmp_path)
    assert third.parameters[topics.GUIDANCE].guidance.switching.mode == "off"


def test_circles_far_beyond_the_look_ahead_of_these_gains_are_refused(tmp_path):
    file = tmp_path / "wide.yaml"
    file.write_text(
        "version: 1\nname: wide\nframe: ned\nthrust: 6\nswitching: {radius: 11}\n"
        "waypoints: {points: [[0, 0], [90, 0], [90, 90]], smoothing: {kind: linear}}\n"
    )
    with pytest.raises(
        ConfigurationError, match=r"wide\.yaml: switching\.radius: found 11 m with a look-ahead of 5\.2"
    ):
        mission_plan.make(Options(mission=str(file), params="robust"), tmp_path / "run")
    (_, warning) = mission_plan.make(
        Options(mission=str(file), params="paper"), tmp_path / "run"
    ).verdicts.warnings
    assert "look-ahead of 6 m" in str(warning)


def test_of_a_file_for_two_vehicles_the_one_in_this_namespace_counts(tmp_path):
    file = tmp_path / "fleet.yaml"
    file.write_text(
        "".join(
            f"/{name}/ailos_guidance: {{ros__parameters: {{guidance.virtual_point.k: {k}}}}}\n"
            for name, k in (("auv1", 0.5), ("auv2", 2.0))
        )
    )
    for namespace, k in (("/auv1", 0.5), ("/auv2", 2.0)):
        made = mission_plan.make(Options(params=str(file), namespace=namespace), tmp_path / "run")
        assert made.parameters[topics.GUIDANCE].guidance.virtual_point.k == k
    with pytest.raises(ConfigurationError, match="found another namespace than /auv, expected"):
        mission_plan.make(Options(params=str(file)), tmp_path / "run")


def test_a_vehicle_without_a_hull_can_be_planned_for_but_not_simulated(tmp_path, capsys):
    path = tmp_path / "measured.yaml"
    path.write_text(
        "name: measured\nlength: 2.0\nthrust_max: 10\nrudder: {max_angle_deg: 25, max_rate_deg_s: 10}\n"
        "cruise: {thrust: 8, speed: 2}\nturning: {radius: 9.5}\n"
    )
    options = Options(vehicle=str(path), no_sim=True, params="paper")
    assert mission_plan.make(options, tmp_path / "run").vehicle.hull is None
    with pytest.raises(ConfigurationError, match="hull: found nothing, expected the hull's coefficients"):
        mission_plan.make(dataclasses.replace(options, no_sim=False), tmp_path / "run")


BARE = """
name: measured
length: 1.6
thrust_max: 100
thrust_unit: percent
rudder: {max_angle_deg: 35, max_rate_deg_s: 15}
cruise: {thrust: 100, speed: 2.0}
turning: {radius: 4.2}
"""


def test_a_vehicle_without_a_hull_needs_limits_and_flies_by_those_that_the_launcher_advises(tmp_path):
    file, params = tmp_path / "bare.yaml", tmp_path / "limits.yaml"
    file.write_text(BARE, encoding="utf-8")
    asked = Options(mission=_mission(tmp_path), vehicle=str(file), no_sim=True)
    with pytest.raises(ConfigurationError) as error:
        mission_plan.make(asked, tmp_path / "run")
    advised = error.value.expected.rsplit("turning: ", 1)[1]
    assert advised == "max_rate: 0.42, max_acceleration: 0.29, max_jerk: 0.37"
    assert error.value.where.endswith("robust.yaml: heading_autopilot: measured: hull")
    robust = config_files.find("params", "robust")
    text = robust.read_text(encoding="utf-8").replace("damping: 0.8", f"damping: 0.8, {advised}")
    params.write_text(text, encoding="utf-8")
    by_rule = mission_plan.make(dataclasses.replace(asked, params=str(params)), tmp_path / "run").parameters
    # The same vehicle as its hull has it, and what it then does with either.
    hull, mission = vehicle.load("remus100"), mission_file.load("paper_composite")
    beside = PlantState(0.0, 40.0, 3.0, 2.0, 0.0, 0.0)
    common = {
        "path": mission.path,
        "vehicle": hull,
        "thrust": mission.thrust,
        "initial": beside,
        "time_limit": 90.0,
    }
    runs = [
        fly(Scenario(**common, autopilot=parameters[topics.AUTOPILOT].autopilot, controller_vehicle=known))
        for parameters, known in (
            (params_file.load(robust, SUITE), hull),
            (by_rule, vehicle.load(str(file))),
        )
    ]
    errors = [float(np.sqrt(np.mean(run.ye**2))) for run in runs]
    assert errors[1] < 1.5 * errors[0]  # narrower limits: they assume a sluggish hull


def test_the_former_name_of_the_controller_model_still_serves(capsys):
    options = mission_command.parser().parse_args(["--believed", "remus100_table2"])
    assert options.controller_model == "remus100_table2"
    assert capsys.readouterr().err == "notice --believed is now --controller-model\n"
    assert (
        mission_command.parser().parse_args(["--controller-model", "remus100"]).controller_model == "remus100"
    )
    assert capsys.readouterr().err == ""


def test_both_names_of_the_controller_model_are_refused(capsys):
    with pytest.raises(SystemExit) as end:
        mission_command.parser().parse_args(["--believed", "remus100", "--controller-model", "remus100"])
    assert end.value.code == 2
    assert "not allowed with argument --believed" in capsys.readouterr().err


DIVER = "remus100_6dof"


def _start(**options):
    """Depth and pitch (rad) of the start in closed loop, and the path's."""
    scenario = mission_plan.scenario(Options(vehicle=DIVER, **options))
    run = fly(dataclasses.replace(scenario, time_limit=0.1))
    return run.z[0], run.theta[0], scenario.spatial.start_pose


def test_a_vehicle_that_dives_starts_at_the_paths_first_depth(tmp_path):
    z, theta, pose = _start(mission="helix")
    assert (z, theta) == pytest.approx((5.0, 0.0)) and pose.z == 5.0
    text = (
        "version: 1\nname: down\nframe: ned\nthrust: 6.48\n"
        "waypoints: {points: [[0, 0, 8], [100, 0, 28]], smoothing: {kind: linear}}\n"
    )
    (tmp_path / "down.yaml").write_text(text)
    z, theta, _ = _start(mission=str(tmp_path / "down.yaml"))
    assert (z, theta) == pytest.approx((8.0, -np.arctan(0.2)))


def test_it_starts_elsewhere_on_request_and_never_higher_than_it_floats():
    assert _start(mission="helix", depth=12.0)[:2] == pytest.approx((12.0, 0.0))
    assert _start(mission="mss_course")[0] == vehicle.load(DIVER).shallowest
    assert _start(mission="mss_course", depth=0.0)[0] == 0.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"depth": 3.0}, "--depth: found vehicle REMUS 100 without stern planes"),
        ({"upwelling": 0.1}, "--upwelling: found vehicle REMUS 100 without stern planes"),
        ({"depth": 300.0, "vehicle": DIVER}, "--depth: found 300 m, expected at most 100 m"),
        ({"mission": "helix"}, "vehicle REMUS 100: found no stern planes for a mission with a depth"),
    ],
)
def test_depths_that_the_vehicle_cannot_have_are_refused(tmp_path, options, message):
    with pytest.raises(ConfigurationError, match=message):
        mission_plan.make(Options(**options), tmp_path)


def test_an_altitude_is_held_within_the_limits(tmp_path):
    text = (
        "version: 1\nname: low\nframe: ned\nthrust: 6.48\naltitude: {above_bottom: 5, min: 2}\n"
        "limits: {min_altitude: 3, max_depth: 60}\nloiter: {centre: [0, 0], radius: 30}\n"
    )
    (tmp_path / "low.yaml").write_text(text)
    options = Options(mission=str(tmp_path / "low.yaml"), vehicle=DIVER)
    with pytest.raises(ConfigurationError, match="altitude: found no sea, without an altimeter"):
        mission_plan.scenario(options)
    made = mission_plan.make(dataclasses.replace(options, sea="shelf"), tmp_path)
    assert made.path is made.mission.path  # the depths are those of the bottom
    mode = made.scenario().mode
    assert (mode.above, mode.least, mode.surface, mode.deepest) == (5.0, 3.0, 0.5, 60.0)


@pytest.mark.parametrize("more", [[], ["--force"]])
def test_the_launcher_refuses_a_mission_with_a_depth_for_a_planar_vehicle(tmp_path, capsys, more):
    asked = ["helix", "--domain", "1", "--out", str(tmp_path / "run"), *more]
    assert mission_command.main(asked) == 2
    err = capsys.readouterr().err
    assert "found" in err
    assert "stern planes" in err
    assert err.count("\n") == 1
    assert not (tmp_path / "run").exists()


def test_gains_by_rule_are_those_of_the_vehicles_file(tmp_path):
    """The word stands in place of a file; a vehicle for which the rule does not hold gets a notice."""
    made = mission_plan.make(Options(params="rule", vehicle="remus100_mismatch"), tmp_path)
    gains = gains_for(vehicle.load("remus100_mismatch"))
    flight = made.scenario()
    assert flight.autopilot == gains.heading.autopilot
    assert flight.guidance.ailos.lookahead == gains.heading.lookahead
    assert flight.guidance.switching.turn_rate == gains.heading.autopilot.reference.max_rate
    assert made.parameters[topics.OBSERVER].observer.k_ob1 == 1.0
    assert made.verdicts.notices == ()
    slow = tmp_path / "slow.yaml"
    text = config_files.find("vehicles", "remus100").read_text(encoding="utf-8")
    slow.write_text(text.replace("max_rate_deg_s: 15", "max_rate_deg_s: 3"), encoding="utf-8")
    notices = mission_plan.make(Options(params="rule", vehicle=str(slow)), tmp_path).verdicts.notices
    assert any("too slow a fin" in notice for notice in notices)


def test_a_hull_without_tuned_gains_flies_by_the_rule(tmp_path):
    """What was asked for comes first, then what the vehicle's file names, then the rule."""
    own = (config_files.find("vehicles", "remus100")).read_text(encoding="utf-8")
    (tmp_path / "own.yaml").write_text(own.replace("params: robust", "#"), encoding="utf-8")
    options = Options(vehicle=str(tmp_path / "own.yaml"))
    made = mission_plan.make(options, tmp_path)
    assert made.parameters[topics.AUTOPILOT].autopilot == gains_for(made.vehicle).heading.autopilot
    assert any("its file names no params" in notice for notice in made.verdicts.notices)
    for tuned in (Options(), dataclasses.replace(options, params="robust")):
        made = mission_plan.make(tuned, tmp_path)
        assert made.parameters[topics.AUTOPILOT].autopilot.nism.k5 == 15.0
