"""Recorded and new commands of a rerun, compared: figures, a table, a file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich import box
from rich.table import Table

from auv_msgs_py.contract import topics
from auv_msgs_py.settings.result_files import replacing
from auv_sim.bags.content.rerun_pilot import Answers
from auv_sim.terminal import console as terminal

_DEGREES = (
    topics.RUDDER_CMD.name, topics.DESIRED_YAW.name, topics.DESIRED_YAW_RATE.name,
    topics.STERNPLANE_CMD.name, topics.DESIRED_PITCH.name, topics.DESIRED_PITCH_RATE.name,
)  # fmt: skip
#: What the vehicle was commanded: rudder, thrust, and the stern planes of a vehicle that has them.
_COMMANDS = (topics.RUDDER_CMD.name, topics.STERNPLANE_CMD.name, topics.THRUST_CMD.name)
_UNITS = {
    topics.RUDDER_CMD.name: "°", topics.THRUST_CMD.name: "N", topics.DESIRED_YAW.name: "°",
    topics.DESIRED_YAW_RATE.name: "°/s", topics.DESIRED_THRUST.name: "N", topics.PATH_PARAMETER.name: "",
    topics.STERNPLANE_CMD.name: "°", topics.DESIRED_PITCH.name: "°", topics.DESIRED_PITCH_RATE.name: "°/s",
    topics.DESIRED_DEPTH.name: "m",
}  # fmt: skip


def compared(found: Answers, name: str) -> dict[str, Any]:
    """Return the figures of one topic: how many commands have the same bits, and how far others are off."""
    recorded, new = found.recorded[name], found.new[name]
    both = np.isfinite(recorded)
    if not both.any():
        return {"compared": 0, "identical": 0, "rms": None, "largest": None, "largest_at_s": None}
    a, b = np.ascontiguousarray(recorded[both]), np.ascontiguousarray(new[both])
    difference = _shown(name, b - a)
    worst = int(np.argmax(np.abs(difference)))
    return {
        "compared": int(both.sum()),
        # As bits: -0.0 is not 0.0.
        "identical": int((a.view(np.uint64) == b.view(np.uint64)).sum()),
        "rms": float(np.sqrt(np.mean(difference**2))),
        "largest": float(np.abs(difference[worst])),
        "largest_at_s": float(found.t[both][worst]),
    }


def _shown(name: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """In the units in which people read them; a yaw's difference is wrapped."""
    if name == topics.DESIRED_YAW.name:
        values = np.remainder(values + np.pi, 2 * np.pi) - np.pi
    return np.degrees(values) if name in _DEGREES else values


def show(found: Answers, figures: dict[str, dict[str, Any]]) -> None:
    """Print the figures of all topics, and those of the fins."""
    console = terminal()
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("recorded against new")
    for heading in ("compared", "same bits", "rms difference", "largest", "at s"):
        table.add_column(heading, justify="right")
    for name, f in figures.items():
        if not f["compared"]:
            table.add_row(name, "0", *["-"] * 4)
            continue
        same = f["identical"] == f["compared"]
        colour = "green" if same else "yellow"
        unit = f" {_UNITS[name]}".rstrip()
        table.add_row(
            name, str(f["compared"]), f"[{colour}]{'all' if same else f['identical']}[/{colour}]",
            f"{f['rms']:.4g}{unit}", f"{f['largest']:.4g}{unit}", "-" if same else f"{f['largest_at_s']:.2f}",
        )  # fmt: skip
    console.print(table)
    if is_same(figures):
        console.print(f"every command is the recorded one, bit for bit ({found.t.size} steps)")
    fins = {"rudder": topics.RUDDER_CMD.name, "stern planes": topics.STERNPLANE_CMD.name}
    for fin, name in fins.items():
        for label, commands in (("recorded", found.recorded), ("new", found.new)):
            angles = np.degrees(commands.get(name, np.empty(0)))
            angles = angles[np.isfinite(angles)]
            if not angles.size:
                continue
            travel, rms = np.abs(np.diff(angles)).sum(), np.sqrt(np.mean(angles**2))
            console.print(
                f"{fin} {label}: travel {travel:.1f}°, rms {rms:.3f}°, largest {np.abs(angles).max():.2f}°"
            )


def is_same(figures: dict[str, dict[str, Any]]) -> bool:
    """Return whether every command has the bits of the recorded one."""
    commands = [figures[name] for name in _COMMANDS if name in figures]
    return all(f["identical"] == f["compared"] for f in commands)


def write_csv(found: Answers, file: Path) -> None:
    """Write both sides of every topic, a row for each odometry."""
    names = [f"{name}_{which}" for name in found.new for which in ("recorded", "new")]
    columns = [column for name in found.new for column in (found.recorded[name], found.new[name])]
    with replacing(file) as draft, draft.open("w", encoding="utf-8") as stream:
        stream.write(",".join(["t [s]", *names]) + "\n")
        for row in zip(found.t, *columns, strict=True):
            stream.write(",".join(repr(float(value)) for value in row) + "\n")
