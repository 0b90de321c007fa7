"""Colours and axes that all panels of the overview share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from auv_msgs_py.settings.result_files import replacing

INK = "#1b2733"
MUTED = "#7a8794"
GRID = "#e6eaee"
PATH = "#b9c3cd"
AREA = "#f3f6f8"
BLUE = "#0b5fa5"
ORANGE = "#e07b1a"
GREEN = "#2a9d6f"
RED = "#c8374a"
#: Keeps text legible on top of lines.
HALO = [withStroke(linewidth=3.0, foreground="white")]


def fact(value: float, form: str) -> str:
    """Return `value` in the given format; empty when it is unknown."""
    return form.format(value) if np.isfinite(value) else ""


def save(figure: Figure, target: Path, **options: Any) -> None:
    """Write a picture in the format of its suffix; PNG without one.

    Raises:
        NotWritten: it cannot be written.
        ValueError: no picture has this suffix.
    """
    with replacing(target) as draft:
        figure.savefig(draft, format=target.suffix[1:].lower() or "png", **options)


def style(axes: Axes, ylabel: str) -> None:
    """Style the axes of a panel."""
    axes.set_ylabel(ylabel, color=INK)
    axes.grid(color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, labelsize=9, length=3)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(PATH)
