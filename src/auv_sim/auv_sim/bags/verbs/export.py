"""Write one table on the odometry's time base: a row for each odometry, units in the header."""

from __future__ import annotations

import argparse
import dataclasses
import importlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.settings.result_files import replacing
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.vehicle_parts import read_vehicles
from auv_sim.bags.reading.load import run_of
from auv_sim.bags.verbs.arguments import add_choice
from auv_sim.command_line import say, target
from auv_sim.flight.run_record import Run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument("bag", type=Path, metavar="BAG", help="recording or run directory")
    parser.add_argument(
        "--out", type=target, metavar="FILE", help="*.csv or *.parquet (default: beside the recording, CSV)"
    )
    parser.add_argument("--rate", type=float, metavar="HZ", help="resample to this number of rows a second")
    add_choice(parser)


def run(arguments: argparse.Namespace) -> int:
    """Write the table and print its place."""
    bags = read_vehicles(arguments.bag, odometry=arguments.odometry, namespace=arguments.namespace)
    if len(bags) > 1:
        expected = f"--namespace with one of {', '.join(bags)}"
        raise ConfigurationError(str(arguments.bag), f"{len(bags)} vehicles", expected)
    bag = next(iter(bags.values()))
    for note in bag.notes:
        say(f"damaged: {note}")
    flown = run_of(bag, arguments.namespace)
    if arguments.rate is not None:
        flown = _resampled(flown, arguments.rate)
    columns = {f"{name} [{signal.unit}]": getattr(flown, name) for name, signal in flown.signals.items()}
    file = arguments.out or bag.path.parent / f"{bag.path.stem}.csv"
    try:
        if file.suffix == ".csv":
            _write_csv(columns, file)
        elif file.suffix == ".parquet":
            _write_parquet(columns, file)
        else:
            raise ConfigurationError("--out", str(file), "a name that ends in .csv or .parquet")
    except OSError as error:
        raise ConfigurationError(str(file), f"{error.strerror}", "a place to write to") from None
    say(f"{file}: {flown.steps} rows, {len(columns)} columns")
    return 0


def _resampled(flown: Run, rate: float) -> Run:
    """Return the newest row at each of the new times, without interpolation."""
    if not 0.0 < rate <= 1e6:
        raise ConfigurationError("--rate", f"{rate:g}", "a number greater than 0")
    count = int((flown.t[-1] - flown.t[0]) * rate + 1e-9) + 1
    times = flown.t[0] + np.arange(count) / rate
    rows = np.searchsorted(flown.t, times + 1e-9, side="right") - 1
    picked = flown.select(rows)
    return dataclasses.replace(picked, t=times)


def _write_csv(columns: dict[str, NDArray[np.float64]], file: Path) -> None:
    """Write every digit; an unknown value is an empty cell."""
    with replacing(file) as draft, draft.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(",".join(columns) + "\n")
        for row in zip(*(column.tolist() for column in columns.values()), strict=True):
            stream.write(",".join("" if value != value else repr(value) for value in row) + "\n")


def _write_parquet(columns: dict[str, NDArray[np.float64]], file: Path) -> None:
    try:
        pyarrow = importlib.import_module("pyarrow")
        parquet = importlib.import_module("pyarrow.parquet")
    except ImportError:
        raise ConfigurationError(
            "--out", f"{file}, and no pyarrow", "python -m pip install pyarrow, or a .csv"
        ) from None
    with replacing(file) as draft:
        parquet.write_table(pyarrow.table(dict(columns)), draft)
