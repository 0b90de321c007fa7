"""The distributions behind a proof, and one flight of it."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_sim.own_vehicle.prove.proof import Proof, SeaProof
from auv_sim.own_vehicle.tune.objective import LIMIT_CYCLE
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, PATH, RED, save, style

#: Line of each set of gains and sea, in the order drawn.
_LINES = [(colour, line) for line in ("-", "--", ":") for colour in (BLUE, ORANGE, GREEN, RED, MUTED, INK)]
#: A legend covers the lines under it.
_UNDER: dict[str, Any] = {"framealpha": 1.0, "edgecolor": "none"}
_WIDTH = 115


def draw(
    target: Path, verdict: str, is_proven: bool, within: float, proofs: Mapping[str, Proof],
    depth_within: float | None = None,
) -> None:  # fmt: skip
    """Draw the distributions.

    Args:
        target: the picture.
        verdict: one line.
        is_proven: whether it is.
        within: largest distance away from corners that is good enough, m.
        proofs: the flights with the gains themselves first, then with other laws.
        depth_within: the same of the depth, m; None for a vehicle in the plane.

    Raises:
        NotWritten: it cannot be written.
    """
    figure = Figure(figsize=(12.0, 8.2), dpi=90, facecolor="white")
    FigureCanvasAgg(figure)
    head = "\n".join(textwrap.wrap(verdict, _WIDTH))
    figure.text(0.05, 0.975, head, color=GREEN if is_proven else RED, fontsize=12, va="top", weight="bold")
    grid = figure.add_gridspec(2, 2, left=0.08, right=0.97, top=0.9, bottom=0.07, hspace=0.34, wspace=0.22)
    off, whole, calm, last = (figure.add_subplot(grid[k // 2, k % 2]) for k in range(4))
    along = _along(proofs)
    _spread(off, "off", along, within)
    off.set_xlabel("largest true distance of a flight away from corners (m)", color=INK)
    _spread(whole, "whole", along)
    whole.set_xlabel("largest true distance of a flight anywhere (m)", color=INK)
    _unrest(calm, proofs)
    if depth_within is None:
        _activity(last, along)
    else:
        _spread(last, "deep", along, depth_within)
        last.set_xlabel("largest error of depth of a flight (m)", color=INK)
    save(figure, target)


def _along(proofs: Mapping[str, Proof]) -> dict[str, SeaProof]:
    """Return the flights along courses by gains and sea."""
    return {
        label if len(proof.seas) == 1 else f"{label}, {name}": one
        for label, proof in proofs.items()
        for name, one in proof.seas.items()
    }


def _spread(axes: Axes, name: str, along: Mapping[str, SeaProof], within: float | None = None) -> None:
    """Draw the share of flights within a distance, and where the bound lies."""
    style(axes, "share of the flights (%)")
    farthest = [within or 0.0]
    for (label, proof), (colour, line) in zip(along.items(), _LINES, strict=False):
        values = np.sort(getattr(proof, name))
        share = 100.0 * np.arange(1, len(values) + 1) / len(values)
        is_known = np.isfinite(values)
        bound = getattr(proof, f"{name}_bound")
        text = f"{label}: 99 % within {bound:.2f} m" if np.isfinite(bound) else f"{label}: no bound"
        look: dict[str, Any] = {"color": colour, "linewidth": 1.5, "linestyle": line, "label": text}
        axes.step(values[is_known], share[is_known], where="post", **look)
        axes.plot([bound], [99.0], "o", color=colour, markersize=5)
        # A few flights that are far away must not squeeze the others.
        farthest.append(1.3 * float(np.quantile(values[is_known], 0.97)) if is_known.any() else 0.0)
        farthest.append(1.1 * bound if np.isfinite(bound) and len(along) < 3 else 0.0)
    if within is not None:
        axes.axvline(within, color=INK, linewidth=1.0, linestyle=":", label=f"asked for: {within:g} m")
    axes.set_ylim(0.0, 101.0)
    axes.set_xlim(0.0, 1.05 * max(*farthest, 1e-3))
    axes.legend(fontsize=8, loc="lower right", **_UNDER)


def _unrest(axes: Axes, proofs: Mapping[str, Proof]) -> None:
    style(axes, "starts (%)")
    edges = np.geomspace(1e-3, 30.0, 46)
    place = 0
    for label, proof in proofs.items():
        colour, line = _LINES[place % len(_LINES)]
        place += len(proof.seas)  # the colour of its first sea in the other panels
        rates = np.clip(np.nan_to_num(proof.unrest, nan=edges[-1]), edges[0], edges[-1])
        counts, _ = np.histogram(rates, edges)
        text = f"{label}: {proof.cycles} of {len(rates)}, at most {100.0 * proof.cycle_bound:.1f} %"
        share = 100.0 * counts / len(rates)
        axes.stairs(share, edges, color=colour, linestyle=line, linewidth=1.4, label=text)
    axes.axvline(LIMIT_CYCLE, color=INK, linewidth=1.0, linestyle=":")
    axes.set_xscale("log")
    axes.set_xlabel("rms yaw rate late on a straight line (°/s); right of the line: limit cycles", color=INK)
    axes.legend(fontsize=8, **_UNDER)


def _activity(axes: Axes, along: Mapping[str, SeaProof]) -> None:
    style(axes, "")
    places = np.arange(len(along))[::-1]
    for place, proof, (colour, line) in zip(places, along.values(), _LINES, strict=False):
        hatch = None if line == "-" else "///"  # as the dashed lines of the other panels
        axes.barh(place, proof.travel, height=0.5, color=colour, hatch=hatch, edgecolor="white")
    for place, (label, proof) in zip(places, along.items(), strict=True):
        known = proof.rms[np.isfinite(proof.rms)]
        rms = float(np.median(known)) if known.size else np.nan
        text = f"{label}: median rms {rms:.2f} m, {proof.lost} of {len(proof.rms)} not completed"
        axes.text(0.0, place + 0.3, text, color=INK, fontsize=8, va="bottom")
    axes.set_yticks([])
    axes.set_ylim(min(-0.6, len(along) - 6.6), len(along))
    axes.spines["left"].set_color(PATH)
    axes.set_xlabel("rudder travel in the sea (°/m)", color=INK)
