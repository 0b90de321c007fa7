"""Renews the figures in docs/performance.md and its growth curves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from auv_sim.checks.benchmark.sheets import Sheet, markdown
from auv_sim.command_line import make_directory
from auv_sim.views import doc_pages
from auv_sim.views.plot_style import BLUE, INK, ORANGE, save, style

#: Of the page.
PART = "figures"
PICTURE = "performance_growth.png"


def renew(page: Path, images: Path, figures: dict[str, Any], found: list[Sheet]) -> None:
    """Put the machine, the tables and the growth curves into the page."""
    make_directory(images, "--images")
    draw(figures, images / PICTURE)
    machine = "; ".join(f"{name} {value}" for name, value in figures["machine"].items())
    load = figures["load"]
    text = (
        f"Measured on: {machine}. Load of the machine before it began: {load:.1f}.\n\n{markdown(found)}\n\n"
        f"![Growth: simulation by vehicles, guidance by subpaths, recorder by topics](images/{PICTURE})"
    )
    doc_pages.renew(page, PART, text)


def draw(figures: dict[str, Any], picture: Path) -> None:
    """Cost against number of vehicles, of subpaths, of recorded topics."""
    fig, axes = plt.subplots(1, 3, figsize=(12.0, 3.6), layout="constrained")
    _vehicles(axes[0], figures["simulation"])
    _curve(axes[1], figures["subpaths"]["step_us"], "subpaths", "one step of guidance [us]")
    _curve(
        axes[2], figures["recording"]["cpu_percent"], "recorded topics at 50 Hz", "recorder [% of one core]"
    )
    save(fig, picture, dpi=110)
    plt.close(fig)


def _vehicles(ax: Axes, figures: dict[str, Any]) -> None:
    scalar = 1e6 / figures["closed_loop"]["vehicle_steps_per_second"]
    rates = figures["batch"]["vehicle_steps_per_second"]
    numbers = [int(n) for n in rates]
    ax.loglog(numbers, [1e6 / rate for rate in rates.values()], "o-", color=BLUE, label="batch")
    ax.axhline(scalar, color=ORANGE, label="closed_loop")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("vehicles", color=INK)
    ax.legend(frameon=False)
    style(ax, "one vehicle-step [us]")


def _curve(ax: Axes, costs: dict[str, float], xlabel: str, ylabel: str) -> None:
    ax.semilogx([int(n) for n in costs], list(costs.values()), "o-", color=BLUE)
    ax.set_ylim(0.0, 1.25 * max(costs.values()))
    ax.set_xlabel(xlabel, color=INK)
    style(ax, ylabel)
