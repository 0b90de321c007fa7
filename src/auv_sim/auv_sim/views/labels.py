"""Texts on a picture without overlap."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from auv_path_following.curves.composite import CompositePath
from auv_sim.views.plot_style import GREEN, HALO

#: Width and height of a character over its font size.
_WIDTH, _HEIGHT = 0.62, 1.1
_POINTS_PER_INCH = 72.0
#: Corners of a map for an arrow, the preferred one first: shares of the axes to the right and up.
_CORNERS = ((0.08, 0.1), (0.76, 0.1), (0.08, 0.9), (0.76, 0.9))
#: Half of the room that an arrow and its words take there.
_ROOM = (0.26, 0.1)
#: A slower current is not drawn, m/s.
_STILL = 1e-3


class Labels:
    """Writes texts; one that would cover an earlier one is left out.

    The axes must have their final limits: boxes are compared on the page, not in the data.

    Args:
        axes: to write on.
    """

    def __init__(self, axes: Axes) -> None:
        axes.apply_aspect()
        self._axes = axes
        self._taken: list[tuple[float, float, float, float]] = []

    def write(
        self, text: str, at: tuple[float, float], offset: tuple[float, float], size: float, **look: Any
    ) -> bool:
        """Write a text beside a point.

        Args:
            text: one line.
            at: the point, in data coordinates.
            offset: from there to the middle of the text, in points of the page.
            size: font size, points.
            look: further properties of the text.

        Returns:
            Whether there was room.
        """
        pixels = self._axes.transData.transform(at)
        scale = _POINTS_PER_INCH / self._axes.get_figure(root=True).dpi  # type: ignore[union-attr]
        x, y = (float(pixel) * scale + shift for pixel, shift in zip(pixels, offset, strict=True))
        half_width, half_height = 0.5 * _WIDTH * size * len(text), 0.5 * _HEIGHT * size
        box = (x - half_width, x + half_width, y - half_height, y + half_height)
        if any(
            box[0] < other[1] and other[0] < box[1] and box[2] < other[3] and other[2] < box[3]
            for other in self._taken
        ):
            return False
        self._taken.append(box)
        self._axes.annotate(
            text, at, xytext=offset, textcoords="offset points", ha="center", va="center", fontsize=size,
            path_effects=HALO, **look,
        )  # fmt: skip
        return True


def arrow(axes: Axes, name: str, north: float, east: float, path: CompositePath) -> None:
    """Draw a current in the corner of a map that has the least of the path.

    Args:
        axes: the map, east to the right and north up, with its final limits.
        name: of the current.
        north, east: its components, m/s.
        path: that the arrow must not cover, NED.
    """
    strength = float(np.hypot(north, east))
    if strength < _STILL:
        return
    axes.apply_aspect()
    x, y, _ = path.polyline(max(1.0, path.length / 2000.0))
    points = axes.transAxes.inverted().transform(axes.transData.transform(np.column_stack((y, x))))

    def covered(corner: tuple[float, float]) -> int:
        right, up = points[:, 0] - corner[0], points[:, 1] - corner[1]
        return int(((right > -0.08) & (right < _ROOM[0]) & (np.abs(up) < _ROOM[1])).sum())

    right, up = min(_CORNERS, key=covered)
    # In inches, and along the screen: axes of unequal sides must not bend its direction.
    axes.quiver(
        right, up, east / strength, north / strength, transform=axes.transAxes, angles="uv", pivot="middle",
        scale_units="inches", scale=1.6, units="inches", width=0.035, color=GREEN,
    )  # fmt: skip
    words = f"{name}\n{strength:.2f} m/s"
    axes.text(right + 0.06, up, words, transform=axes.transAxes, color=GREEN, fontsize=10, va="center")
