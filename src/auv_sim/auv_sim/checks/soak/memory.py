"""Memory of the processes of a mission, from /proc."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path


def resident(pid: int) -> int:
    """Return the resident memory of a process, kB; 0 if it has ended."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0
    return int(status.split("VmRSS:")[1].split()[0]) if "VmRSS:" in status else 0


def of_children(pid: int) -> dict[str, int]:
    """Return the resident memory of each direct child that runs a module: last part of its name -> kB."""
    found: dict[str, int] = {}
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children = task.read_text().split()
        except OSError:  # the thread has just ended
            continue
        for child in children:
            try:
                words = Path(f"/proc/{child}/cmdline").read_bytes().decode().split("\0")
                status = Path(f"/proc/{child}/status").read_text()
            except OSError:  # it has just ended
                continue
            if "-m" in words and "VmRSS:" in status:
                name = words[words.index("-m") + 1].rsplit(".", 1)[-1]
                found[name] = int(status.split("VmRSS:")[1].split()[0])
    return found


def draw(rows: Sequence[tuple[float, dict[str, int]]], warm: float, file: Path) -> None:
    """Draw how each process has grown since step `warm`."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, RED, save, style

    late = [row for row in rows if row[0] >= warm]
    figure, axes = pyplot.subplots(figsize=(9.0, 4.0), layout="constrained")
    for name, colour in zip(sorted(late[-1][1]), (BLUE, ORANGE, GREEN, RED, MUTED, INK), strict=False):
        known = [(steps / 1e3, held[name]) for steps, held in late if name in held]
        first = known[0][1]
        label = f"{name}, {first / 1e3:.1f} MB"
        axes.plot([x for x, _ in known], [(y - first) / 1e3 for _, y in known], color=colour, label=label)
    style(axes, "growth of resident memory [MB]")
    axes.set_xlabel("steps [thousand]", color=INK)
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, -2.0), max(high, 2.0))
    axes.margins(x=0.0)
    axes.legend(loc="upper left", frameon=False, labelcolor=INK, fontsize=9)
    save(figure, file, dpi=120)
    pyplot.close(figure)
