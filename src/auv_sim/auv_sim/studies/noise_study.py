"""Rudder activity against the level of noise, with and without the filter behind dr/dt."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from rich.table import Table

from auv_sim.flight.batch import engine
from auv_sim.flight.scenario import Scenario
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.studies.settings_changes import changed
from auv_sim.studies.trials import Trial, judge
from auv_sim.terminal import headed_table
from auv_sim.vehicle.fins.actuator import RudderFlaws
from auv_sim.vehicle.sea import Sea
from auv_sim.views.doc_pages import markdown_table
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, save, style

#: Name of the table's part of the page.
PART = "noise"
#: The sea's white noise is multiplied by these.
LEVELS = (0.0, 0.25, 0.5, 1.0, 2.0)
SEED = 0


class Gains(NamedTuple):
    """One line of the picture: a parameter file, and what differs from it."""

    label: str
    params: str
    changes: dict[str, float]
    color: str


GAINS = (
    Gains("robust.yaml: differences", "robust", {}, ORANGE),
    Gains("robust.yaml with the filter", "robust", {"derivative.bandwidth": 20.0}, GREEN),
    Gains("rough.yaml: filter and a third of k5", "rough", {}, BLUE),
)
#: The sea's own rudder, and one without flaws.
RUDDERS = ("of the sea", "ideal")


class NoiseJob(NamedTuple):
    """One flight."""

    mission: str
    vehicle: str
    sea: str
    gains: Gains
    rudder: str
    level: float


#: Runs `work` on each item and shows the progress: (what, work, items) -> results.
Runner = Callable[[str, Callable[[Any], Any], Sequence[Any]], list[Any]]
Study = dict[tuple[str, str, float], Trial]


def fly(mission: str, vehicle: str, sea: str, run: Runner) -> Study:
    """Fly every line, rudder and level; return (label, rudder, level) -> figures.

    Raises:
        ConfigurationError: a file that cannot be used.
    """
    jobs = [
        NoiseJob(mission, vehicle, sea, gains, rudder, level)
        for gains in GAINS
        for rudder in RUDDERS
        for level in LEVELS
    ]
    _scenario(jobs[0])  # report a mistake before the pool starts
    trials = run("flying", _fly, jobs)
    return {(job.gains.label, job.rudder, job.level): trial for job, trial in zip(jobs, trials, strict=True)}


def _fly(job: NoiseJob) -> Trial:
    scenario = _scenario(job)
    return judge(engine.track(scenario), scenario.path, job.gains.params, SEED)


def _scenario(job: NoiseJob) -> Scenario:
    options = Options(
        mission=job.mission, vehicle=job.vehicle, params=job.gains.params, sea=job.sea, seed=SEED
    )
    scenario = mission_plan.make(options, Path()).scenario()
    assert scenario.sea is not None
    sea = with_noise(scenario.sea, job.level)
    if job.rudder == "ideal":
        sea = dataclasses.replace(sea, rudder=RudderFlaws())
    autopilot = changed(scenario.autopilot, job.gains.changes, job.gains.label)
    return dataclasses.replace(scenario, sea=sea, autopilot=autopilot)


def with_noise(sea: Sea, level: float) -> Sea:
    """Return the sea with `level` times the white noise of compass, gyro and both logs."""
    sensors = sea.sensors
    noises = {
        "heading.noise_deg.white": sensors.heading.noise_deg.white,
        "yaw_rate.noise_deg.white": sensors.yaw_rate.noise_deg.white,
        "water_track.noise.white": sensors.water_track.noise.white,
        "bottom_track.noise.white": sensors.bottom_track.noise.white,
    }
    return changed(sea, {f"sensors.{name}": level * white for name, white in noises.items()}, sea.name)


def draw(study: Study, png: Path) -> None:
    """Draw travel and rate of the rudder over the level of noise."""
    figure = Figure(figsize=(12.0, 4.8), dpi=80, facecolor="white")
    FigureCanvasAgg(figure)
    for axes, name, label in (
        (figure.add_subplot(1, 2, 1), "rudder_travel", "rudder travel (°/m)"),
        (figure.add_subplot(1, 2, 2), "rudder_rate", "rms rudder rate (°/s)"),
    ):
        style(axes, label)
        axes.set_xlabel("white noise, 1 = as in the sea's file", color=INK)
        for gains in GAINS:
            for rudder, dashes in zip(RUDDERS, ("-", "--"), strict=True):
                values = [getattr(study[gains.label, rudder, level], name) for level in LEVELS]
                text = gains.label if rudder == RUDDERS[0] else None
                axes.plot(LEVELS, values, dashes, marker="o", markersize=4, color=gains.color, label=text)
        axes.plot([], [], "--", color=MUTED, label="the same with an ideal rudder")
        axes.set_ylim(bottom=0.0)
        axes.margins(x=0.03)
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=4, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.93))
    save(figure, png)


def _rows(study: Study) -> list[list[str]]:
    return [
        [
            gains.label,
            rudder,
            *(
                f"{study[gains.label, rudder, level].rudder_travel:.2f}"
                f" / {study[gains.label, rudder, level].rudder_rate:.1f}"
                for level in LEVELS
            ),
        ]
        for gains in GAINS
        for rudder in RUDDERS
    ]


_HEADS = ("gains", "rudder", *(f"noise × {level:g}" for level in LEVELS))


def table(study: Study) -> Table:
    """Return the table for the terminal."""
    shown = headed_table("Rudder: travel (°/m) / rms rate (°/s)", _HEADS[:2], _HEADS[2:])
    for row in _rows(study):
        shown.add_row(*row)
    return shown


def record(study: Study) -> list[dict[str, Any]]:
    """Return the figures for programs: one entry for each flight."""
    return [
        {"gains": label, "rudder": rudder, "noise": level, **dataclasses.asdict(trial)}
        for (label, rudder, level), trial in study.items()
    ]


def markdown(study: Study) -> str:
    """Return the table for a page."""
    return markdown_table(_HEADS, _rows(study), left=2)
