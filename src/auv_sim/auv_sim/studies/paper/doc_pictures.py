"""Draws the pictures of docs/reproduction.md and docs/tuning.md from flights that a reader can repeat."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from auv_path_following import vehicle
from auv_sim.flight.run_record import Run
from auv_sim.studies.paper.cases import CURRENT, beside
from auv_sim.studies.paper.heading_loop import open_loop, phase_lag
from auv_sim.studies.paper.paper_flights import PaperFlight, fly
from auv_sim.studies.paper.variants import PLANT_NAMES, PLANTS
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, RED, save, style

#: Runs `work` on each item and shows the progress: (what, work, items) -> results.
Runner = Callable[[str, Callable[[Any], Any], Sequence[Any]], list[Any]]

#: The map of starts: offsets to starboard (m) and heading errors (deg).
OFFSETS = (-20.0, -10.0, -5.0, 0.0, 5.0, 10.0, 20.0)
HEADINGS = (-180.0, -135.0, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0)
#: Duration of the map's flights, s; the last 15 s count.
_LOOK = 90.0
_DPI = 80


class _Gain(NamedTuple):
    """One picture of docs/tuning.md: a gain too low, as chosen and too high."""

    file: str
    where: str
    name: str
    unit: str
    values: tuple[float, float, float]
    signal: str
    label: str
    seconds: float = 40.0
    words: tuple[str, str, str] = ("low", "", "high")


GAINS = (
    _Gain("lookahead", "guidance", "ailos.lookahead", "m", (2.0, 5.2, 15.0), "ye", "ye (m)"),
    _Gain("bandwidth", "autopilot", "reference.bandwidth", "1/s", (0.25, 0.7, 2.5), "ye", "ye (m)"),
    _Gain("k1", "autopilot", "nism.k1", "rad/s", (0.05, 0.4, 3.0), "psi_e", "ψe (°)"),
    _Gain("k3", "autopilot", "nism.k3", "rad/s²", (0.03, 0.4, 4.0), "psi_e", "ψe (°)"),
    _Gain("k5", "autopilot", "nism.k5", "s²/rad", (0.5, 15.0, 200.0), "rudder_cmd", "δ (°)"),
    _Gain(
        "kp",
        "autopilot",
        "nism.kp",
        "rad/s",
        (0.05, 0.1745, 0.2618),
        "psi_e",
        "ψe (°)",
        40.0,
        ("low", "Table 4", "the rudder's own"),
    ),
)


def draw_all(folder: Path, run: Runner) -> None:
    """Draw everything into `folder`.

    Args:
        folder: of the pictures; it exists.
        run: flies a list of flights.
    """
    _map(folder / "limit_cycle_map.png", run)
    _phase(folder / "rate_limit_phase.png")
    _gains(folder, run)


def _settles(flight: PaperFlight) -> float:
    """Fly, and return the largest heading error (deg) in the last 15 s."""
    flown = fly(flight)
    late = flown.t - flown.t[0] > flight.time_limit - 15.0
    return float(np.degrees(np.abs(flown.psi_e[late])).max())


#: Gains that the map compares: heading -> what differs from a plain flight.
_MAPPED: dict[str, dict[str, Any]] = {"Table 4": {"params": "paper"}, "robust.yaml": {"params": "robust"}}


def _map(file: Path, run: Runner) -> None:
    """Draw which starts end in the limit cycle."""
    cycle = _cycles(run)
    figure = _figure((11.0, 6.2))
    panels = figure.subplots(len(_MAPPED), len(PLANT_NAMES), squeeze=False)
    for row, law in enumerate(_MAPPED):
        for column, plant in enumerate(PLANT_NAMES):
            axes = panels[row][column]
            axes.imshow(
                cycle[row, column], cmap=ListedColormap(["#d9f2e5", RED]), vmin=0, vmax=1, aspect="auto",
                origin="lower",
            )  # fmt: skip
            axes.set_xticks(range(len(OFFSETS)), [f"{o:g}" for o in OFFSETS])
            axes.set_yticks(range(len(HEADINGS)), [f"{h:g}" for h in HEADINGS])
            axes.set_title(f"{law}, {PLANTS[plant].label}", fontsize=10, color=INK)
            axes.set_xlabel("start to starboard of the path (m)")
            axes.set_ylabel("heading off the path's (°)")
    figure.suptitle(
        "red: a limit cycle still runs after 75 s; green: the heading has settled", fontsize=11, color=INK
    )
    save(figure, file, dpi=_DPI)


def _cycles(run: Runner) -> np.ndarray:
    """Fly every start; return whether it cycles, shape (gains, plants, headings, offsets)."""
    _, _, course = beside(0.0)
    shape = (len(_MAPPED), len(PLANT_NAMES), len(HEADINGS), len(OFFSETS))
    places = list(itertools.product(*map(range, shape)))
    laws = list(_MAPPED.values())
    flights = []
    for law, plant, heading, offset in places:
        x, y, _ = beside(OFFSETS[offset])
        start = (x, y, course + math.radians(HEADINGS[heading]))
        flights.append(
            PaperFlight(name="map", plant=PLANT_NAMES[plant], start=start, time_limit=_LOOK, **laws[law])
        )
    cycle = np.zeros(shape)
    for place, error in zip(places, run("mapping the starts", _settles, flights), strict=True):
        cycle[place] = error > 5.0
    return cycle


def _phase(file: Path) -> None:
    """Draw the heading loop's gain and phase at its limit cycle, and the lag of the rate limit."""
    figure = _figure((9.0, 5.4))
    gain, phase = figure.subplots(2, 1, sharex=True)
    w = np.geomspace(0.2, 6.0, 300)
    for name, color in (("remus100", BLUE), ("remus100_table2", RED)):
        hull = vehicle.load(name)
        response = open_loop(hull, w)
        gain.loglog(w, np.abs(response), color=color, label=hull.name)
        phase.semilogx(w, np.degrees(np.unwrap(np.angle(response))), color=color)
    for amplitude, dash in ((5.0, ":"), (15.0, "--"), (35.0, "-.")):
        lag = np.degrees(phase_lag(w, math.radians(amplitude), math.radians(10.0)))
        phase.semilogx(
            w, -lag, color=MUTED, linestyle=dash, label=f"rate limit 10°/s, rudder ±{amplitude:g}°"
        )
    style(gain, "|r / δ| (1/s)")
    style(phase, "phase (°)")
    gain.legend(fontsize=8, frameon=False)
    phase.legend(fontsize=8, frameon=False, loc="center left")
    phase.set_xlabel("angular frequency (rad/s)")
    save(figure, file, dpi=_DPI)


def _gains(folder: Path, run: Runner) -> None:
    """Draw each gain too low, right and too high."""
    start = beside(8.0)
    flights = []
    for gain in GAINS:
        for value in gain.values:
            changes = {gain.name: value}
            if gain.name == "nism.kp":
                changes["nism.kp_from_rudder"] = False
            flights.append(
                PaperFlight(
                    name=gain.file,
                    params="robust",
                    start=start,
                    current=CURRENT,
                    time_limit=gain.seconds,
                    changes={gain.where: changes},
                )
            )
    flown = iter(run("flying with wrong gains", fly, flights))
    for gain in GAINS:
        figure = _figure((8.0, 3.0))
        axes = figure.subplots()
        style(axes, gain.label)
        axes.set_xlabel("t (s)")
        for value, color, word in zip(gain.values, (ORANGE, GREEN, RED), gain.words, strict=True):
            result: Run = next(flown)
            signal = getattr(result, gain.signal)
            values = signal if gain.signal == "ye" else np.degrees(signal)
            label = f"{gain.name.rpartition('.')[2]} = {value:g} {gain.unit}" + (f" ({word})" if word else "")
            axes.plot(result.t - result.t[0], values, color=color, label=label, linewidth=1.3)
        axes.legend(fontsize=8, frameon=False, loc="upper right")
        save(figure, folder / f"tuning_{gain.file}.png", dpi=_DPI)


def _figure(size: tuple[float, float]) -> Figure:
    figure = Figure(figsize=size, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    return figure
