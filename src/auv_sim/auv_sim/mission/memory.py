"""Memory of the processes of a mission, from /proc."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any


def of_children(pid: int) -> dict[str, int]:
    """Resident memory (kB) of each direct child that runs a module: last part of the module's name -> kB."""
    found: dict[str, int] = {}
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in task.read_text().split():
            try:
                words = Path(f"/proc/{child}/cmdline").read_bytes().decode().split("\0")
                status = Path(f"/proc/{child}/status").read_text()
            except OSError:  # it has just ended
                continue
            if "-m" in words and "VmRSS:" in status:
                name = words[words.index("-m") + 1].rsplit(".", 1)[-1]
                found[name] = int(status.split("VmRSS:")[1].split()[0])
    return found


def draw(rows: Sequence[tuple[float, dict[str, int]]], file: Path) -> None:
    """Memory of each process over the steps."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    from auv_sim.analysis.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, RED, style

    figure, axes = pyplot.subplots(figsize=(9.0, 4.0), layout="constrained")
    steps = [row[0] / 1e3 for row in rows]
    for name, colour in zip(sorted(rows[-1][1]), (BLUE, ORANGE, GREEN, RED, MUTED, INK), strict=False):
        megabytes: list[Any] = [row[1][name] / 1e3 if name in row[1] else None for row in rows]
        axes.plot(steps, megabytes, color=colour, linewidth=1.4)
        axes.annotate(
            name,
            (steps[-1], megabytes[-1]),
            xytext=(6, 0),
            textcoords="offset points",
            color=colour,
            va="center",
        )
    style(axes, "resident memory [MB]")
    axes.set_xlabel("steps [thousand]", color=INK)
    axes.set_ylim(bottom=0.0)
    axes.margins(x=0.0)
    figure.savefig(file, dpi=120)
    pyplot.close(figure)
