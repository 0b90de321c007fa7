"""Repeats one run of a campaign: in the batch engine, or over ROS 2 with its files written out."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
from rich.console import Console
from rich.markup import escape

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig
from auv_sim.bags.reading.load import load
from auv_sim.cli import mission as mission_command
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, to_type
from auv_sim.flight.batch import engine
from auv_sim.flight.figures.mission_summary import SpatialMissionSummary
from auv_sim.flight.loops import followed_path
from auv_sim.flight.metrics import summarise
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.flight.scenario import Scenario, start_of
from auv_sim.sim_parameters import ConstantCurrent, InitialPose
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.store import RESULTS, Store
from auv_sim.terminal import go_on, wrote
from auv_sim.vehicle.hulls.rigid_body import BodyState, angles_of
from auv_sim.vehicle.remus import PlantState
from auv_sim.views.overview import draw
from auv_sim.views.signal_rows import limits_of

#: The engine flies to the end what these limits of a dive would end.
_NO_WATCHDOG = DiveLimitsConfig(
    roll_deg=0.0,
    pitch_deg=0.0,
    slow_after=0.0,
    broach_after=0.0,
    depth_patience=0.0,
    depth_doubt=0.0,
    hold_sink=0.0,
)


def replay(store: Store, number: int, graph: bool, console: Console) -> int:
    """Fly run `number` again.

    Args:
        store: the campaign.
        number: of the run, from 0.
        graph: fly it over ROS 2 as well, recorded.
        console: for the output.

    Returns:
        the exit code: 0 if the path was flown to its end, else 1.

    Raises:
        ConfigurationError: there is no such run, or the nodes cannot fly it.
    """
    plan = store.plan
    if number >= plan.runs:
        raise ConfigurationError("--replay-run", str(number), f"a run from 0 to {plan.runs - 1}")
    scenario = plan.scenario(number)
    console.print(f"[bold]{escape(plan.study.name)}[/bold], run {number}")
    _print_values(plan, number, console)
    directory = store.directory / "runs" / f"{number:07d}"
    shutil.rmtree(directory, ignore_errors=True)
    write_files(plan, number, directory / "config")
    flown = engine.track(scenario)
    code = _show(store, number, flown, scenario, console)
    _picture(plan, number, flown, scenario, directory / "overview.png")
    wrote(console, directory / "overview.png", "the run in one picture")
    if graph:
        return _over_ros(plan, directory, flown, console)
    go_on(
        console, "Fly it over ROS 2", to_type("campaign.py", store.directory, replay_run=number, graph=True)
    )
    return code


def _print_values(plan: StudyPlan, number: int, console: Console) -> None:
    for name, value in plan.values(number).items():
        text = f"{value:.6g}" if isinstance(value, float) else escape(str(value))
        console.print(f"  {name:<32} {text}")


def _over_ros(plan: StudyPlan, directory: Path, flown: Run, console: Console) -> int:
    """Fly the run over ROS 2, print its distance from the batch engine's, return the exit code."""
    least = ["--flown", f"{plan.study.flown:g}"]
    code = mission_command.main(
        [*command_line(directory / "config"), *least, "--out", str(directory / "graph")]
    )
    recorded = load(directory / "graph" / "bag")
    rows = min(recorded.steps, flown.steps)
    names = ("x", "y", "z") if isinstance(recorded, SpatialRun) else ("x", "y")
    gaps = [getattr(recorded, name)[:rows] - getattr(flown, name)[:rows] for name in names]
    apart = np.sqrt(np.square(gaps).sum(axis=0))
    console.print(f"graph and batch engine: {rows} steps, at most {apart.max():.2g} m apart", soft_wrap=True)
    return code


def write_files(plan: StudyPlan, number: int, directory: Path) -> None:
    """Write mission, hulls, sea and parameters of one run, such that `scripts/mission.py` flies it."""
    values, scenario = plan.values(number), plan.scenario(number)
    mission = plan.files.mission_of(values)
    given = plan.files.parameters(str(values.get("params", plan.study.params)))
    directory.mkdir(parents=True)
    mission.copy_to(directory)
    yaml_file.dump(_written(scenario.vehicle), directory / "vehicle.yaml")
    yaml_file.dump(_written(scenario.controller_vehicle), directory / "controller_model.yaml")
    plant: dict[str, Any] = {"step": scenario.step, "seed": scenario.seed}
    if scenario.sea is not None:
        yaml_file.dump(_written(scenario.sea), directory / "sea.yaml")
        plant["sea"] = str(directory / "sea.yaml")
    plant["initial"] = _initial(scenario.initial or start_of(scenario.path))
    plant["current"] = ConstantCurrent(**scenario.current._asdict())
    limits = dataclasses.replace(given[topics.GUIDANCE].limits, duration=plan.study.time_limit)
    parameters = given | {
        topics.PLANT: dataclasses.replace(given[topics.PLANT], **plant),
        topics.OBSERVER: dataclasses.replace(given[topics.OBSERVER], observer=scenario.observer),
        topics.AUTOPILOT: dataclasses.replace(
            given[topics.AUTOPILOT], autopilot=scenario.autopilot, pitch=scenario.pitch
        ),
        topics.GUIDANCE: dataclasses.replace(
            given[topics.GUIDANCE],
            guidance=scenario.guidance,
            limits=limits,
            diving=_NO_WATCHDOG,
            mission_switching=False,
        ),
    }
    yaml_file.dump(params_file.as_ros(parameters), directory / "params.yaml")


def _initial(state: PlantState | BodyState) -> InitialPose:
    """Return the first state of a vehicle, which turns about no axis, as the simulator's parameter."""
    if isinstance(state, BodyState):
        _, theta, psi = angles_of(state)
        return InitialPose(x=state.x, y=state.y, psi=psi, surge=state.ur, depth=state.z, theta=theta)
    return InitialPose(x=state.x, y=state.y, psi=state.psi, surge=state.ur)


def command_line(config: Path) -> list[str]:
    """Return arguments for `scripts/mission.py`; a campaign flies what the mission check refuses, too."""
    names = ("mission", "vehicle", "controller_model", "params")
    files = [part for name in names for part in (f"--{name.replace('_', '-')}", str(config / f"{name}.yaml"))]
    return [*files, "--force"]


def _written(settings: Any) -> Any:
    """Return a settings object as it stands in a file: what is not given is left out."""
    if not dataclasses.is_dataclass(settings):
        return list(settings) if isinstance(settings, tuple) else settings
    named = {field.name: getattr(settings, field.name) for field in dataclasses.fields(settings)}
    return {name: _written(value) for name, value in named.items() if value is not None}


def _show(store: Store, number: int, flown: Run, scenario: Scenario, console: Console) -> int:
    """Print the figures; return the exit code."""
    summary = summarise(flown, followed_path(scenario))
    outcome = summary.outcome(store.plan.study.flown)
    console.print(
        f"\n{outcome} after {summary.duration:.1f} s,"
        f" rms distance {summary.rms_distance:.4g} m, largest {summary.largest_distance:.4g} m"
    )
    if isinstance(summary, SpatialMissionSummary):
        console.print(
            f"rms depth error {summary.rms_depth_error:.4g} m, largest {summary.largest_depth_error:.4g} m,"
            f" largest pitch {summary.largest_pitch:.3g} deg"
        )
    console.print(summary.flown_line(), soft_wrap=True)
    if store.finished:
        table = pq.read_table(store.directory / RESULTS, columns=["rms_distance"])
        kept = table.column(0)[number].as_py()
        console.print(
            f"in the campaign: rms distance {kept:.4g} m, {abs(kept - summary.rms_distance):.1g} m apart"
        )
    return EXIT_DONE if outcome == "complete" else EXIT_FAILED


def _picture(plan: StudyPlan, number: int, flown: Run, scenario: Scenario, file: Path) -> None:
    path = followed_path(scenario)
    draw(
        flown,
        scenario.path,
        summarise(flown, path),
        file,
        f"{plan.study.name}, run {number}",
        limits=limits_of(scenario.vehicle),
        spatial=path if isinstance(path, SpatialPath) else None,
    )
