"""The table of signals and the columns that are laid out by it."""

from __future__ import annotations

import dataclasses

from auv_sim.flight.batch import track_row
from auv_sim.flight.run_record import Run
from auv_sim.flight.signals import ANGLES, SIGNALS, TRUTH


def test_every_column_of_a_run_is_a_signal() -> None:
    assert [field.name for field in dataclasses.fields(Run)] == list(SIGNALS)


def test_angles_are_the_signals_in_radians() -> None:
    assert set(ANGLES) == {"psi", "psi_true", "r", "rudder", "rudder_cmd", "psi_d", "r_d", "psi_e"}


def test_the_columns_of_a_compiled_track_stand_under_their_names() -> None:
    names = [*track_row.TRACK, *TRUTH]
    assert [getattr(track_row, name.upper()) for name in names] == list(range(1, track_row.TRACK_COLUMNS))
    assert set(names) <= set(SIGNALS)
