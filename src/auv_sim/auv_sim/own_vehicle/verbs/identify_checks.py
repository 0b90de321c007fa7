"""Checks of `vehicle.py identify` before any work: numbers that no vehicle has, files that would be lost."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Vehicle
from auv_sim.command_verbs import refuse_without_effect
from auv_sim.own_vehicle.output_files import check_outputs

#: Options of a study, and of recordings, by name.
_OF_STUDY = ("first", "program", "dive", "sea", "workers", "page")
_OF_RECORDINGS = (
    "vehicle", "log_latency", "dead_band", "left_out", "log_scale", "thrust_bias", "rudder_rate", "topic",
    "frame", "unit", "namespace",
)  # fmt: skip
#: Largest latency of a log (s), error by a data sheet (per cent), and range of a rudder's rate (deg/s).
_LATENCY, _PERCENT, _RATE = 2.0, 50.0, (0.1, 1000.0)


def check_effect(o: argparse.Namespace) -> None:
    """Check that every option has an effect.

    Raises:
        ConfigurationError: one of the study without it, or one of recordings with it.
    """
    if o.study is not None and o.bag:
        raise ConfigurationError("BAG", "--study", "recordings or --study, not both")
    if o.study is None:
        refuse_without_effect(o, _OF_STUDY, "no --study", "--study N")
    else:
        refuse_without_effect(o, _OF_RECORDINGS, "--study", "recordings")


def check_options(o: argparse.Namespace, vehicle: Vehicle) -> None:
    """Check the numbers among the options.

    Raises:
        ConfigurationError: one that no vehicle has.
    """
    _within("--log-latency", o.log_latency, 0.0, _LATENCY, "s")
    _within("--dead-band", o.dead_band, 0.0, 0.5 * vehicle.rudder.max_angle_deg, "deg")
    _within("--log-scale", o.log_scale, 0.0, _PERCENT, "per cent")
    _within("--thrust-bias", o.thrust_bias, 0.0, _PERCENT, "per cent")
    _within("--rudder-rate", o.rudder_rate, *_RATE, "deg/s")


def _within(option: str, value: float | None, least: float, most: float, unit: str) -> None:
    if value is not None and not least <= value <= most:
        raise ConfigurationError(option, f"{value:g} {unit}", f"{least:g} to {most:g} {unit}")


def check_target(out: Path, inputs: Sequence[Path], overwrite: bool) -> None:
    """Check that the vehicle file and the picture beside it replace nothing that is needed.

    Args:
        out: the vehicle file.
        inputs: files and directories that are read.
        overwrite: whether files of an earlier identification are replaced.

    Raises:
        ConfigurationError: a file is an input, or exists, or is the picture.
    """
    picture = out.with_suffix(".png")
    if out.suffix.lower() == picture.suffix:
        raise ConfigurationError(
            "--out", f"{out}, the name of a picture", "a vehicle file, such as mine.yaml"
        )
    check_outputs((out, picture), inputs, overwrite)
