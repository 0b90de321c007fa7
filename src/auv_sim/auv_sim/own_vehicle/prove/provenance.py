"""What a proof was made of: files with their digests, versions, and commands that repeat it."""

from __future__ import annotations

import argparse
import platform
from importlib import metadata
from pathlib import Path

from auv_path_following import config_files
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import to_type
from auv_sim.flight.batch.compiled import digest_of
from auv_sim.own_vehicle.verbs.gain_options import CLAIM, CONDITIONS, changed

#: Packages whose versions may change a figure.
_PACKAGES = ("auv_sim", "numpy", "numba", "scipy", "cma")


def gains_name(options: argparse.Namespace, own: Vehicle) -> str:
    """Return which gains are flown: those asked for, else those that the vehicle names, else the rule's."""
    return str(options.params or own.params or "rule")


def facts_of(options: argparse.Namespace, gains: str) -> dict[str, str]:
    """Return what was flown, by name.

    Args:
        options: of the command.
        gains: name of a parameter file, or `rule`.
    """
    vehicle = config_files.find("vehicles", options.vehicle)
    seas = [_with_digest(config_files.find("seas", name)) for name in options.sea]
    found = f"the rule of docs/tuning.md with {options.delay:g} s of further delay"
    if gains != "rule":
        found = _with_digest(config_files.find("params", gains))
    versions = [f"{name} {metadata.version(name)}" for name in _PACKAGES]
    return {
        "vehicle": _with_digest(vehicle),
        "gains": found,
        "seas": "; ".join(seas),
        "command": command_of(options),
        "seed": f"{options.seed}",
        "versions": ", ".join([*versions, f"Python {platform.python_version()}"]),
        "made": options.made,
    }


def _with_digest(file: Path) -> str:
    return f"{file} (SHA-256 begins with {digest_of([file])})"


def command_of(options: argparse.Namespace, **others: object) -> str:
    """Return the command with all options that decide which flights are drawn.

    Args:
        options: of the command.
        others: further options, by name without dashes.
    """
    words: list[str] = ["prove", str(options.vehicle)]
    if options.params:
        words += ["--params", str(options.params)]
    words += [word for name in options.sea for word in ("--sea", str(name))]
    words += [
        word
        for name, value in changed(options, {**CONDITIONS, **CLAIM}).items()
        for word in (f"--{name.replace('_', '-')}", f"{value}".removesuffix(".0"))
    ]
    words += ["--in-plane"] if options.in_plane else []
    words += ["--laws", "--generations", f"{options.generations}"] if options.laws and not others else []
    words += [word for name, value in others.items() for word in (f"--{name}", f"{value}")]
    return to_type("vehicle.py", *words)
