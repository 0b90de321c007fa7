"""Before and after: a held-out course with the rule's gains and with those found."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from auv_path_following.curves.composite import CompositePath
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.batch import engine
from auv_sim.flight.figures.flown_rows import FlownRows
from auv_sim.flight.loops import followed_path
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import SpatialRun
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.gain_verdict import FOUND, PRESENT, RULE, GainVerdict
from auv_sim.own_vehicle.tune.trial_flights import Amount, draw_flights, with_laws
from auv_sim.own_vehicle.tune.tuning_problem import Problem
from auv_sim.views.plot_style import BLUE, INK, MUTED, ORANGE, PATH, save, style

#: Colours of before and after.
_COLOURS = (ORANGE, BLUE)
#: Stream of the draw of the picture's course.
_PICTURE = 3
_PANELS, _DEPTH = ("distance (m)", "rudder (°)", "rudder travel (°)"), "depth (m)"
#: Of each source of gains: label of its track, state in the picture's title.
_STATES = {
    FOUND: ("tuned", "tuned"),
    PRESENT: ("present", "the present gains stay"),
    RULE: ("", "the rule's gains stay"),
}


def draw(
    target: Path, title: str, path: CompositePath, flights: Sequence[tuple[str, Scenario]],
    history: Sequence[float],
) -> None:  # fmt: skip
    """Draw the tracks, the distances to the path, the rudder, and how the search went.

    Args:
        target: the picture.
        title: above it.
        path: seen from above.
        flights: label and flight: before, after.
        history: objective of each generation; empty for no search.

    Raises:
        NotWritten: it cannot be written.
    """
    figure = Figure(figsize=(13.0, 7.2), dpi=90, facecolor="white")
    FigureCanvasAgg(figure)
    labels = [*_PANELS, *[_DEPTH] * any(scenario.spatial is not None for _, scenario in flights)]
    grid = figure.add_gridspec(len(labels), 2, width_ratios=(1.0, 1.35))
    over = figure.add_subplot(grid[:, 0] if not history else grid[:2, 0])
    away, _, spent, *deep = panels = [figure.add_subplot(grid[k, 1]) for k in range(len(labels))]
    for axes, text in zip((over, *panels), ("north x (m)", *labels), strict=True):
        style(axes, text)
    x, y, _ = path.polyline(1.0)
    over.plot(y, x, color=PATH, linewidth=5.0, solid_capstyle="round", label="path")
    for (label, scenario), colour in zip(flights, _COLOURS, strict=False):
        _add(label, scenario, colour, (over, *panels))
    over.set_aspect("equal", adjustable="datalim")
    over.set_xlabel("east y (m)", color=INK)
    panels[-1].set_xlabel("time (s)", color=INK)
    for axes in (away, spent):
        axes.set_ylim(bottom=0.0)
    for axes in (over, away, *deep):
        axes.legend(frameon=False, fontsize=9)
    if history:
        _add_search(figure.add_subplot(grid[2, 0]), history)
    figure.suptitle(title, color=INK, fontsize=12)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.97))
    save(figure, target)


def draw_verdict(
    picture: Path,
    own: Vehicle,
    problem: Problem,
    written: GainSet,
    verdict: GainVerdict,
    history: tuple[float, ...],
) -> None:
    """Draw a held-out course with the rule's gains and with those that a vehicle gets.

    Args:
        picture: the file.
        own: the vehicle.
        problem: what was tuned.
        written: gains as the parameter file has them.
        verdict: where they come from.
        history: objective of each generation.

    Raises:
        NotWritten: it cannot be written.
    """
    space = problem.space
    one = Amount(starts=0, courses=1, legs=5, at_sea=0)
    random = np.random.default_rng([problem.seed, _PICTURE])
    # The second: sharp corners in a current.
    flight = draw_flights(space.vehicle, problem.conditions, one, random)[1]
    label, state = _STATES[verdict.source]
    gains = [("rule", space.rule())] + ([(label, written)] if label else [])
    flights = [(name, with_laws(flight, flown, space.vehicle)) for name, flown in gains]
    speed = np.hypot(*flight.scenario.current[:2])
    title = f"{own.name}: {state}. A held-out course in {speed:.2f} m/s of current"
    draw(picture, title, flight.scenario.path, flights, history)


def _add(label: str, scenario: Scenario, colour: str, panels: Sequence[Axes]) -> None:
    """Add one flight to the panels of track, distance, rudder and travel; of depth if it dives."""
    over, away, rudder, spent, *deep = panels
    followed = followed_path(scenario)
    run = under_way(engine.track(scenario), followed.n)
    t, (x, y) = run.t - run.t[0], run.track
    rows = FlownRows(run, followed)
    distance = rows.distance
    text = f"{label}: rms {np.sqrt(np.mean(distance**2)):.2f} m, largest {distance.max():.2f} m"
    over.plot(y, x, color=colour, linewidth=1.4, label=label)
    away.plot(t, distance, color=colour, linewidth=1.2, label=text)
    rudder.plot(t, np.degrees(run.rudder), color=colour, linewidth=0.9)
    moved = np.degrees(np.abs(np.diff(run.rudder, prepend=run.rudder[:1])))
    spent.plot(t, np.cumsum(moved), color=colour, linewidth=1.4)
    if deep and isinstance(run, SpatialRun):
        deep[0].yaxis.set_inverted(True)
        error = rows.depth_error
        deep[0].plot(t, run.depth - error, color=PATH, linewidth=4.0, label="path")
        text = f"{label}: error rms {np.sqrt(np.mean(error**2)):.2f} m, largest {np.abs(error).max():.2f} m"
        deep[0].plot(t, run.depth, color=colour, linewidth=1.2, label=text)


def _add_search(axes: Axes, history: Sequence[float]) -> None:
    style(axes, "objective")
    axes.axhline(0.0, color=PATH, linewidth=1.0)
    axes.plot(range(1, len(history) + 1), history, color=MUTED, linewidth=1.4)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_xlabel("generation, each on new courses; 0: the gains compared with", color=INK)
