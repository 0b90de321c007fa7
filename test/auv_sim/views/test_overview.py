from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from PIL import Image

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight.metrics import summarise
from auv_sim.flight.run_record import Run
from auv_sim.views.overview import draw
from auv_sim.views.signal_rows import FinLimits

PATH = CompositePath([Line(0.0, 0.0, 50.0, 0.0), Line(50.0, 0.0, 50.0, math.pi / 2)])


def flown(**more: np.ndarray) -> Run:
    d = np.arange(0.0, 100.01, 0.5)
    first = d < 50.0
    columns = {
        "t": 1.0 + d / 2.0,
        "x": np.where(first, d, 50.0),
        "y": np.where(first, 0.0, d - 50.0),
        "psi": np.where(first, 0.0, math.pi / 2),
        "s": d / 50.0,
    }
    return Run.from_columns(columns | more)


def pixels(png: Path) -> np.ndarray:
    with Image.open(png) as image:
        image.load()
        return np.asarray(image.convert("RGB"), dtype=np.int16)


def count(picture: np.ndarray, color: tuple[int, int, int]) -> int:
    return int((np.abs(picture - np.array(color)).max(axis=2) < 12).sum())


def test_the_picture_shows_track_errors_limits_and_current(tmp_path: Path) -> None:
    n = flown().steps
    wave = np.sin(np.linspace(0.0, 20.0, n))
    run = flown(
        ye=wave, psi_e=0.1 * wave, rudder=0.2 * wave, rudder_cmd=0.25 * wave, thrust_cmd=np.full(n, 6.48),
        Vx_est=0.1 + 0.0 * wave, Vy_est=0.2 + 0.0 * wave, Vx_true=0.1 + 0.0 * wave, Vy_true=0.2 + 0.0 * wave,
    )  # fmt: skip
    draw(
        run,
        PATH,
        summarise(run, PATH),
        tmp_path / "a.png",
        "a title",
        limits=FinLimits(0.6, 0.26),
    )
    picture = pixels(tmp_path / "a.png")
    assert picture.shape == (1000, 1600, 3)
    blue, orange, green, red = (11, 95, 165), (224, 123, 26), (42, 157, 111), (200, 55, 74)
    left, right = picture[:, :740], picture[:, 760:]
    assert count(left, blue) > 300, "the track"
    assert count(left, green) > 200, "start and current"
    assert count(right, blue) > 1500, "signals"
    assert count(right, orange) > 100, "the commanded rudder"
    assert count(right, red) > 500, "the limits"


def test_a_bare_recording_is_drawn_as_well(tmp_path: Path) -> None:
    for name, run in (("bare", flown()), ("never_started", flown(thrust_cmd=np.zeros(flown().steps)))):
        draw(run, PATH, summarise(run, PATH), tmp_path / f"{name}.png", "costs $5 and $6 {x}_y")
        assert pixels(tmp_path / f"{name}.png").std() > 5.0


def test_the_longest_line_of_facts_fits(tmp_path: Path) -> None:
    """That of a flight at sea: the odometry's error stands in it as well."""
    n = flown().steps
    run = flown(
        x_true=flown().x + 0.123, y_true=flown().y, psi_true=flown().psi,
        thrust_cmd=np.full(n, 6.48), Vx_est=np.full(n, 0.1), Vy_est=np.full(n, 0.2),
        Vx_true=np.full(n, 0.1), Vy_true=np.full(n, 0.2), ye=np.zeros(n),
    )  # fmt: skip
    draw(run, PATH, summarise(run, PATH), tmp_path / "a.png", "a title")
    facts = pixels(tmp_path / "a.png")[68:90]
    written = np.flatnonzero((facts < 250).any(axis=(0, 2)))
    assert 1400 < written.max() < 1590
