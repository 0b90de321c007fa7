"""Options that several verbs share."""

from __future__ import annotations

import argparse


def add_choice(parser: argparse.ArgumentParser) -> None:
    """Add the options that choose one of several vehicles and odometries."""
    parser.add_argument("--namespace", metavar="NAME", help="which vehicle, where there are several (/auv1)")
    parser.add_argument(
        "--odometry", metavar="TOPIC", help="which nav_msgs/Odometry, where none or several are named odom"
    )
