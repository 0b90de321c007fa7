"""Repair a damaged or unfinished recording: everything readable gets an index and metadata.yaml.

It is replaced in its place (files with unreadable parts stay beside it as *.damaged), or written to a new
place with --out. A whole recording is left unchanged.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from auv_sim.bags.bag_repair import repair
from auv_sim.command_line import say


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument("bag", type=Path, metavar="BAG", help="recording, run directory or storage file")
    parser.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="write the repaired recording to DIR, and leave this one unchanged",
    )
    parser.add_argument(
        "--compression",
        choices=("zstd", "none"),
        default="zstd",
        help="compression of the new file (default zstd)",
    )


def run(arguments: argparse.Namespace) -> int:
    """Repair, and print the damage."""
    done = repair(arguments.bag, arguments.out, arguments.compression)
    for note in done.notes:
        say(f"was damaged: {note}")
    if not done.notes and arguments.out is None and arguments.bag.is_dir():
        say(f"{done.directory}: whole already, {done.messages} messages")
        return 0
    say(f"{done.directory}: whole, {done.messages} messages")
    for file in done.kept:
        say(f"{file}: kept, it is damaged")
    return 0
