"""The table of signals and the columns that are laid out by it."""

from __future__ import annotations

import dataclasses

from auv_sim.flight.batch import track_row
from auv_sim.flight.run_record import Run, SpatialRun
from auv_sim.flight.signals import ANGLES, SIGNALS, SPATIAL_SIGNALS, SPATIAL_TRUTH, TRUTH


def test_every_column_of_a_run_is_a_signal() -> None:
    assert [field.name for field in dataclasses.fields(Run)] == list(SIGNALS)
    assert [field.name for field in dataclasses.fields(SpatialRun)] == [*SIGNALS, *SPATIAL_SIGNALS]
    assert set(SPATIAL_TRUTH) <= {*SIGNALS, *SPATIAL_SIGNALS}


def test_a_column_in_three_dimensions_makes_a_run_in_three_dimensions() -> None:
    pose = {"t": [0.0, 1.0], "x": [0.0, 2.0], "y": [0.0, 0.0], "psi": [0.0, 0.0]}
    assert type(Run.from_columns(pose)) is Run
    run = Run.from_columns(pose | {"z": [5.0, 6.0], "z_true": [5.5, float("nan")]})
    assert isinstance(run, SpatialRun)
    assert run.select([1]).z.tolist() == [6.0]
    assert run.depth.tolist() == [5.5, 6.0]
    assert list(run.signals) == [field.name for field in dataclasses.fields(SpatialRun)]


def test_angles_are_the_signals_in_radians() -> None:
    spatial = {"phi", "theta", "q", "sternplanes", "sternplanes_cmd", "theta_d", "q_d", "theta_e"}
    spatial |= {"phi_true", "theta_true"}
    assert set(ANGLES) == {"psi", "psi_true", "r", "rudder", "rudder_cmd", "psi_d", "r_d", "psi_e", *spatial}


def test_the_columns_of_a_compiled_track_stand_under_their_names() -> None:
    names = [*track_row.TRACK, *TRUTH]
    assert [getattr(track_row, name.upper()) for name in names] == list(range(1, track_row.TRACK_COLUMNS))
    assert set(names) <= set(SIGNALS)
