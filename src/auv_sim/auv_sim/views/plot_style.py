"""Colours and axes that all panels of the overview share."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from auv_msgs_py.settings.result_files import replacing


def _by_day() -> dict[str, str]:
    """Return the colours that pictures share with the report and the console: name -> #rrggbb."""
    sheet = resources.files("auv_sim.views.console").joinpath("page", "colours.css")
    return dict(re.findall(r"--(\w+): light-dark\((#\w{6})", sheet.read_text(encoding="utf-8")))


_COLOURS = _by_day()
INK, MUTED, GRID, PATH, AREA = (_COLOURS[name] for name in ("ink", "muted", "grid", "path", "area"))
BLUE, ORANGE, GREEN, RED = (_COLOURS[name] for name in ("blue", "orange", "green", "red"))
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
