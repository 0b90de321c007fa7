"""Draws Figures 5 to 12, each as a picture and as the numbers behind it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.run_record import Column, Run
from auv_sim.studies.paper.cases import LAW_LABELS
from auv_sim.studies.paper.claims import measures as m
from auv_sim.studies.paper.figure_sheet import FigureSheet
from auv_sim.studies.paper.variants import PLANT_NAMES, PLANTS
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, PATH, RED, style

Runs = Mapping[str, Run]

COLORS = {"nism": BLUE, "pid": ORANGE, "smc": RED, "robust": GREEN}
_THREE = ("nism", "pid", "smc")


def _time(run: Run) -> Column:
    return np.asarray(run.t - run.t[0])


def _track(
    sheet: FigureSheet, axes: Axes, path: CompositePath, plant: str, runs: Mapping[str, tuple[Run, str]]
) -> None:
    style(axes, "x, north (m)")
    axes.set_xlabel("y, east (m)", color=INK)
    x, y, _ = path.polyline(1.0)
    sheet.line(axes, y, x, PATH, "desired path", f"{plant} path", 5.0)
    for label, (run, color) in runs.items():
        sheet.line(axes, run.y, run.x, color, label, f"{plant} {label}")
    axes.set_aspect("equal", adjustable="datalim")


def figure_5(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw tracks of case 1."""
    sheet = FigureSheet(1, 3, (14.0, 4.2), share=False)
    for axes, plant in zip(sheet.panels[0], PLANT_NAMES, strict=True):
        tracks = {f"{LAW_LABELS[k]}": (runs[f"1-{k}-{plant}"], COLORS[k]) for k in _THREE}
        _track(sheet, axes, path, plant, tracks)
        axes.set_title(PLANTS[plant].label, color=INK, fontsize=10)
        axes.set_aspect("equal", adjustable="box")
        axes.set_xlim(-30, 560)
        axes.set_ylim(-40, 330)
    return sheet


def figure_6(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw errors of case 1, three plants beside each other."""
    sheet = FigureSheet(3, 3, (14.0, 7.5), share=False)
    for column, plant in enumerate(PLANT_NAMES):
        start, heading, cross = (sheet.panels[row][column] for row in range(3))
        for law, color in COLORS.items():
            run = runs[f"1-{law}-{plant}"]
            label, t = LAW_LABELS[law], _time(run)
            first = t <= 60.0
            sheet.line(start, t[first], run.ye[first], color, label, f"{plant} {law} ye, first minute")
            sheet.line(heading, t, np.degrees(run.psi_e), color, label, f"{plant} {law} psi_e")
            sheet.line(cross, t, run.ye, color, label, f"{plant} {law} ye")
        start.set_title(PLANTS[plant].label, color=INK, fontsize=10)
        for axes, text, low, high in (
            (start, "ye, first minute (m)", -3.0, 6.0),
            (heading, "ψe (°)", -100.0, 100.0),
            (cross, "ye (m)", -6.0, 6.0),
        ):
            style(axes, text)
            axes.set_ylim(low, high)
            if axes is not start:
                axes.set_xlim(0.0, 660.0)
        cross.set_xlabel("t (s)", color=INK)
    return sheet


def figure_7(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw heading error with Nuud changed in the plant."""
    sheet = FigureSheet(2, 1, (10.0, 5.6))
    for axes, plant in zip((row[0] for row in sheet.panels), ("prestero", "mismatch"), strict=True):
        style(axes, "ψe (°)")
        axes.set_title(PLANTS[plant].label, color=INK, fontsize=10)
        for law in _THREE:
            run = runs[f"1-{law}-{plant}"]
            sheet.line(
                axes, _time(run), np.degrees(run.psi_e), COLORS[law], LAW_LABELS[law], f"{plant} {law}"
            )
        axes.set_ylim(-8.0, 8.0)
        axes.set_xlim(0.0, 660.0)
    axes.set_xlabel("t (s); the arc lasts from about 250 s to 400 s, both panels cut at ±8°", color=INK)
    return sheet


def figure_8(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw rudder and its rate, case 1."""
    sheet = FigureSheet(2, 3, (14.0, 5.8))
    for column, law in enumerate(_THREE):
        angle, speed = sheet.panels[0][column], sheet.panels[1][column]
        run = runs[f"1-{law}-prestero"]
        t = _time(run)
        sheet.line(angle, t, np.degrees(run.rudder_cmd), COLORS[law], "", f"{law} delta")
        sheet.line(speed, t[1:-1], np.degrees(m.rudder_rate(run)), COLORS[law], "", f"{law} rate")
        angle.set_title(LAW_LABELS[law], color=INK, fontsize=10)
        for axes, text, limit in ((angle, "δ (°)", 40.0), (speed, "rate of δ (°/s)", 18.0)):
            style(axes, text)
            axes.set_ylim(-limit, limit)
        for value in (-15.0, 15.0):
            speed.axhline(value, color=MUTED, linestyle="--", linewidth=0.9)
        speed.set_xlabel("t (s)", color=INK)
    return sheet


def figure_9(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw tracks of case 2 at the corner."""
    sheet = FigureSheet(1, 3, (14.0, 4.1), share=False)
    corner = path.joints[0]
    for axes, plant in zip(sheet.panels[0], PLANT_NAMES, strict=True):
        _track(
            sheet,
            axes,
            path,
            plant,
            {
                "without (44)": (runs[f"1-on-path-{plant}"], RED),
                "with (44)": (runs[f"2-nism-{plant}"], BLUE),
                "with (44), robust.yaml": (runs[f"2-robust-{plant}"], GREEN),
            },
        )
        axes.set_title(PLANTS[plant].label, color=INK, fontsize=10)
        axes.set_aspect("equal", adjustable="box")
        axes.set_xlim(corner.y - 14.0, corner.y + 22.0)
        axes.set_ylim(corner.x - 16.0, corner.x + 10.0)
    return sheet


def figure_10(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw distance to the path around the corner, case 2."""
    sheet = FigureSheet(1, 3, (14.0, 4.0), share=False)
    for axes, plant in zip(sheet.panels[0], PLANT_NAMES, strict=True):
        style(axes, "distance to the path (m)")
        for name, label, color in (
            (f"1-on-path-{plant}", "without (44)", RED),
            (f"2-nism-{plant}", "with (44)", BLUE),
            (f"2-robust-{plant}", "with (44), robust.yaml", GREEN),
        ):
            run = runs[name]
            t = _time(run)
            rows = (t > 130.0) & (t < 190.0)
            sheet.line(axes, t[rows], m.distance(run, path)[rows], color, label, f"{plant} {label}")
        axes.set_title(PLANTS[plant].label, color=INK, fontsize=10)
        axes.set_xlabel("t (s)", color=INK)
        axes.set_ylim(0.0, 6.0)
    return sheet


def figure_11(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw errors of case 3 with and without the observer."""
    sheet = FigureSheet(2, 1, (10.0, 5.8))
    for name, label, color in (
        ("3-without", "without the observer", RED),
        ("3-with", "with the observer", BLUE),
        ("3-los", "proportional LOS", MUTED),
        ("3-ilos", "integral LOS", ORANGE),
    ):
        run = runs[name]
        sheet.line(sheet.panels[0][0], _time(run), run.xe, color, label, f"{label} xe")
        sheet.line(sheet.panels[1][0], _time(run), run.ye, color, label, f"{label} ye")
    style(sheet.panels[0][0], "xe (m)")
    style(sheet.panels[1][0], "ye (m)")
    sheet.panels[0][0].set_ylim(-2.0, 2.0)
    sheet.panels[1][0].set_ylim(-2.0, 2.0)
    sheet.panels[1][0].set_xlabel("t (s)", color=INK)
    return sheet


def figure_12(runs: Runs, path: CompositePath) -> FigureSheet:
    """Draw the estimated current."""
    sheet = FigureSheet(1, 2, (12.0, 4.0), share=False)
    run = runs["3-with"]
    for axes, span, title in (
        (sheet.panels[0][0], 30.0, "first half minute"),
        (sheet.panels[0][1], 1e9, "whole mission"),
    ):
        style(axes, "current (m/s)")
        rows = _time(run) <= span
        t = _time(run)[rows]
        for true, estimate, label, color in (
            (run.Vx_true, run.Vx_est, "Vx, north", BLUE),
            (run.Vy_true, run.Vy_est, "Vy, east", ORANGE),
        ):
            sheet.line(axes, t, true[rows], PATH, f"{label}, true", f"{title} {label} true", 4.0)
            sheet.line(axes, t, estimate[rows], color, f"{label}, estimated", f"{title} {label} estimated")
        axes.set_title(title, color=INK, fontsize=10)
        axes.set_xlabel("t (s)", color=INK)
        axes.set_ylim(-0.05, 0.35)
    return sheet


#: Number -> what it shows, and what draws it.
FIGURES: dict[int, tuple[str, Callable[[Runs, CompositePath], FigureSheet]]] = {
    5: ("Case 1: desired path and tracks", figure_5),
    6: ("Case 1: errors of the heading controllers", figure_6),
    7: ("Case 1: heading error with Nuud changed in the plant", figure_7),
    8: ("Case 1: rudder angle and rudder rate, Prestero's hull", figure_8),
    9: ("Case 2: the corner with and without Eq. (44)", figure_9),
    10: ("Case 2: distance to the path around the corner", figure_10),
    11: ("Case 3: errors with and without the current observer", figure_11),
    12: ("Case 3: estimated and true current", figure_12),
}


def draw(number: int, runs: Runs, path: CompositePath, folder: Path) -> Path:
    """Draw one figure; return the stem of its three files."""
    stem = folder / f"figure-{number:02d}"
    FIGURES[number][1](runs, path).save(stem)
    return stem
