"""Golden tracks: what `closed_loop` flew when they were last recorded, in `data/golden_tracks.npz`.

A change of the laws' form must not move them. A change that is meant to move them renews the file, in a
commit that says so. In the environment, from the folder `test`:

    python3 -m golden_tracks            # report by how much each flight differs
    python3 -m golden_tracks --renew    # the same, then record them anew
"""

from __future__ import annotations

import argparse
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from auv_sim.flight import closed_loop
from auv_sim.flight.run_record import Run
from golden_flights import FLIGHTS, Flight

FILE = Path(__file__).parent / "data" / "golden_tracks.npz"
#: Largest difference: m, and rad, m/s and subpaths for what is no length.
TOLERANCE = 1e-9
COLUMNS = ("x", "y", "psi", "rudder", "s", "Vx_est", "Vy_est")
#: Rows between two that are stored, s; the last row is always stored.
PERIOD = 1.0


def fly(flight: Flight) -> NDArray[np.float64]:
    """Fly it in `closed_loop`; returns the rows that are stored, see `rows_of`."""
    return rows_of(closed_loop.fly(flight.scenario()), flight)


def rows_of(run: Run, flight: Flight) -> NDArray[np.float64]:
    """Return time since the start (s) and `COLUMNS`, (n, 8): one row each `PERIOD`, and the last one."""
    columns = np.column_stack([run.t - run.t[0], *(getattr(run, name) for name in COLUMNS)])
    every = round(PERIOD / flight.step)
    rows = columns[::every]
    return rows if (run.steps - 1) % every == 0 else np.vstack([rows, columns[-1:]])


@cache
def stored() -> dict[str, NDArray[np.float64]]:
    """Return the recorded rows of each flight."""
    with np.load(FILE) as file:
        return dict(file)


def difference(rows: NDArray[np.float64], golden: NDArray[np.float64]) -> tuple[float, str]:
    """Return the largest difference, and a line that says where it is and where differences begin.

    Args:
        rows, golden: as of `rows_of`.
    """
    both = min(len(rows), len(golden))
    apart = np.abs(rows[:both, 1:] - golden[:both, 1:])
    apart[np.isnan(apart)] = np.inf
    row, column = np.unravel_index(np.argmax(apart), apart.shape)
    largest = float(apart[row, column])
    text = f"{COLUMNS[column]} differs by {largest:.3g} at {golden[row, 0]:.2f} s"
    beyond = np.flatnonzero((apart > TOLERANCE).any(axis=1))
    if beyond.size:
        text += f", more than {TOLERANCE:g} from {golden[beyond[0], 0]:.2f} s on"
    ends = rows[-1, 0], golden[-1, 0]
    if abs(ends[0] - ends[1]) > TOLERANCE:
        return float("inf"), f"it ends at {ends[0]:.2f} s, expected {ends[1]:.2f} s; {text}"
    return largest, text


def main() -> None:
    """Report the differences; record anew with ``--renew``."""
    parser = argparse.ArgumentParser(prog="python3 -m golden_tracks", description=__doc__)
    parser.add_argument("--renew", action="store_true", help="record the tracks as they are flown now")
    renew = parser.parse_args().renew
    flown = {name: fly(flight) for name, flight in FLIGHTS.items()}
    golden = stored() if FILE.exists() else {}
    for name, rows in flown.items():
        print(f"{name}: {difference(rows, golden[name])[1] if name in golden else 'not recorded yet'}")
    for name in golden.keys() - flown.keys():
        print(f"{name}: recorded, but no flight of this name")
    if renew:
        np.savez_compressed(FILE, **flown)
        print(f"{len(flown)} flights recorded in {FILE}")


if __name__ == "__main__":
    main()
