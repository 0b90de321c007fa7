"""Play recorded topics into a live graph, with their recorded QoS and timing.

Keys while it plays: space pauses and resumes, s plays the next message while paused, q ends.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.playing.playback import Player, Selected, select
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.command_line import not_negative, positive, say
from auv_sim.terminal import console as terminal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument("bag", type=Path, metavar="BAG", help="recording or run directory")
    parser.add_argument(
        "--rate",
        type=positive,
        default=1.0,
        metavar="N",
        help="play at N times the recorded speed (default 1)",
    )
    parser.add_argument("--start", type=not_negative, default=0.0, metavar="S", help="skip this many seconds")
    parser.add_argument(
        "--duration", type=positive, metavar="S", help="play this many seconds of the recording"
    )
    parser.add_argument("--loop", action="store_true", help="repeat until stopped")
    parser.add_argument("--clock", action="store_true", help="publish the recorded time on /clock")
    parser.add_argument(
        "--topics", nargs="+", metavar="NAME", help="play only these; the last part of a name is enough"
    )
    parser.add_argument("--exclude", nargs="+", default=[], metavar="NAME", help="do not play these")
    parser.add_argument(
        "--remap", nargs="+", default=[], metavar="OLD:=NEW", help="publish under another name"
    )
    parser.add_argument(
        "--delay",
        type=not_negative,
        default=1.0,
        metavar="S",
        help="time to wait for subscribers first (default 1)",
    )
    parser.add_argument(
        "--start-paused", action="store_true", help="start paused, until the space bar is pressed"
    )


def run(arguments: argparse.Namespace) -> int:
    """Play; return 0 at the end, 130 when interrupted."""
    bag = read_bag(arguments.bag)
    for note in bag.notes:
        say(f"damaged: {note}")
    remaps = {}
    for text in arguments.remap:
        old, separator, new = text.partition(":=")
        if not (old and separator and new):
            raise ConfigurationError("--remap", f"'{text}'", "OLD:=NEW")
        remaps[old] = new
    chosen: Selected = select(
        bag, arguments.topics, arguments.exclude, remaps, arguments.start, arguments.duration, arguments.clock
    )
    length = f"{chosen.length:.1f} s at {arguments.rate:g}x"
    say(f"{len(chosen.topics)} topics, {len(chosen.messages)} messages, {length}")
    with Player(chosen, arguments.rate, arguments.clock, terminal()) as player:
        return player.play(arguments.delay, arguments.loop, arguments.start_paused)
