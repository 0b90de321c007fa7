"""Options that several verbs share."""

from __future__ import annotations

import argparse


def add_choice(parser: argparse.ArgumentParser) -> None:
    """Add the options that choose one of several vehicles and odometries."""
    parser.add_argument(
        "--namespace", metavar="NAME", help="vehicle to take from a recording of several, such as /auv1"
    )
    parser.add_argument(
        "--odometry", metavar="TOPIC", help="the odometry, if no topic or several are named odom"
    )
