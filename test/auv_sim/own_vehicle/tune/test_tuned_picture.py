"""The picture of a search."""

from __future__ import annotations

from matplotlib.figure import Figure

from auv_sim.own_vehicle.tune.outcome import tuned_picture


def test_generations_are_whole_numbers() -> None:
    axes = Figure().add_subplot()
    tuned_picture._add_search(axes, (0.3, -0.2, -0.4))
    low, high = axes.get_xlim()
    assert [tick for tick in axes.get_xticks() if low <= tick <= high] == [1.0, 2.0, 3.0]
