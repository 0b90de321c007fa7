"""Uncertainties, delays and rates that no flight can have end in one line."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli.vehicles.vehicle_command import main
from auv_sim.own_vehicle.prove.proof import Proposition, draw_claim
from auv_sim.own_vehicle.tune.ensemble import drawn_hulls, spread_of_file
from auv_sim.own_vehicle.tune.trial_flights import Conditions
from auv_sim.vehicle import sea
from hulls import REMUS

CALM = sea.load("calm")
CONDITIONS = Conditions(0.05, 0.05, (0.1, 0.05), CALM)


@pytest.mark.parametrize(
    "line",
    [
        "hull:\n  Nuud: -6  # assumed (x0)",
        "hull:\n  Nuud: -6  # assumed (x0.5)",
        "hull:\n  Nuud: -6  # assumed (x1.2.3)",
        "hull:\n  Nuud: -6  # assumed (100000 %)",
        "hull:\n  Nuud: -6  # assumed: 3 to 9",
        "rudder:\n  dead_time: 0.05  # s; assumed: 0 to 0.3 s",
    ],
)
def test_an_uncertainty_that_cannot_be_drawn_is_refused(tmp_path, line: str) -> None:
    file = tmp_path / "own.yaml"
    file.write_text(f"name: own\n{line}\n", encoding="utf-8")
    with pytest.raises(
        ConfigurationError, match=r"own\.yaml: (hull\.Nuud|rudder\.dead_time): found the comment"
    ):
        spread_of_file(file)


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        (["--spread", "100000"], "argument --spread: found 100000, expected 0 to 300 per cent, or `file`"),
        (["--rate", "1e5"], "argument --rate: found 1e5, expected 0.5 to 200 a second"),
        (["--delay", "30"], "argument --delay: found 30, expected 0 to 1 s"),
    ],
)
def test_numbers_that_no_flight_can_have_are_refused(capsys, wrong: list[str], text: str) -> None:
    for verb in ("tune", "prove"):
        with pytest.raises(SystemExit) as ended:
            main([verb, "remus100", *wrong])
        assert ended.value.code == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert text in line


def test_a_delay_beyond_that_of_the_simulator_is_refused() -> None:
    """The dead time of a drawn hull counts: its fins are delayed by both."""
    late = dataclasses.replace(REMUS, rudder=dataclasses.replace(REMUS.rudder, dead_time=0.8))
    claim = Proposition(late, CONDITIONS, (CALM,), 0.1, {}, 6, 2.0, math.inf, 3)
    assert len(draw_claim(claim)) == 12
    claim = claim._replace(conditions=CONDITIONS._replace(delay=1.0))
    with pytest.raises(
        ConfigurationError, match=r"--delay: found 1 s, with a dead time of .* at most 1\.74 s"
    ):
        draw_claim(claim)
    # A dead time beyond what a fin may have is drawn again.
    (drawn,) = drawn_hulls(late, 1, 0.0, np.random.default_rng(1), {"dead_time": (2.0, 4.0)})
    assert 1.6 <= drawn.rudder.dead_time <= 2.0
