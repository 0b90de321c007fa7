"""A figure with the numbers behind it, written as a picture and as CSV."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_msgs_py.settings.result_files import replacing
from auv_sim.flight.run_record import Column
from auv_sim.views.plot_style import save

#: Most rows of the table: a longer signal is thinned out there, not in the picture.
_CSV_ROWS = 4000


class FigureSheet:
    """One figure with its numbers.

    Args:
        rows, columns: of panels.
        size: inches.
        share: whether panels share their horizontal axes.
    """

    def __init__(self, rows: int, columns: int, size: tuple[float, float], share: bool = True) -> None:
        self.figure = Figure(figsize=size, dpi=110, facecolor="white", layout="constrained")
        FigureCanvasAgg(self.figure)
        self.panels: list[list[Axes]] = self.figure.subplots(
            rows, columns, squeeze=False, sharex=share
        ).tolist()
        self.numbers: dict[str, Column] = {}

    def line(
        self, axes: Axes, x: Column, y: Column, color: str, label: str, name: str, width: float = 1.3
    ) -> None:
        """Draw y over x and keep both under `name`."""
        axes.plot(x, y, color=color, label=label, linewidth=width)
        for axis, values in (("x", x), ("y", y)):
            self.numbers[f"{name} {axis}"] = values

    def save(self, stem: Path) -> None:
        """Write `stem`.png, .svg and .csv; columns of different lengths end with empty cells."""
        for row in self.panels:
            for axes in row:
                if axes.get_legend_handles_labels()[0] and not axes.get_legend():
                    axes.legend(fontsize=8, framealpha=0.85, edgecolor="none", loc="upper right")
        save(self.figure, stem.with_suffix(".png"))
        # Without the date the file is the same each time.
        save(self.figure, stem.with_suffix(".svg"), metadata={"Date": None})
        with (
            replacing(stem.with_suffix(".csv")) as draft,
            draft.open("w", newline="", encoding="utf-8") as stream,
        ):
            writer = csv.writer(stream)
            writer.writerow(self.numbers)
            longest = max(len(column) for column in self.numbers.values())
            for k in range(0, longest, 1 + longest // _CSV_ROWS):
                cells = [
                    f"{c[k]:.6g}" if k < len(c) and np.isfinite(c[k]) else "" for c in self.numbers.values()
                ]
                writer.writerow(cells)
