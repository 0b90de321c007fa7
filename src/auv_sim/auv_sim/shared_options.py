"""Options that several commands have in common: the mission, the share that counts as flown, former names."""

from __future__ import annotations

import argparse

from auv_sim.command_line import say, share
from auv_sim.flight.least_share import LEAST_SHARE, LEAST_SHARE_AT_SEA


class Renamed(argparse.Action):
    """An option under a former name: it works as before, and a notice names the present one.

    Args of `add_argument`: ``dest`` of the present option, and ``help=argparse.SUPPRESS``.
    """

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option: str | None = None,
    ) -> None:
        say(f"notice {option} is now --{self.dest.replace('_', '-')}", error=True)
        setattr(namespace, self.dest, values)


class _Mission(argparse.Action):
    """The mission as a word or as `--mission`; two that differ are refused."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option: str | None = None,
    ) -> None:
        given = namespace.mission
        if given not in (self.const, values):  # const: the default
            parser.error(f"found two missions, {given} and {values}, expected one")
        namespace.mission = values


def add_mission_option(parser: argparse.ArgumentParser, default: str | None, shipped: str) -> None:
    """Add the mission, which may be given as a word or as `--mission`.

    Args:
        parser: the command's.
        default: its default; None where one must be given.
        shipped: names of the missions that come with the suite.
    """
    parser.add_argument(
        "--mission", metavar="FILE", action=_Mission, const=default, default=default, help="same as MISSION"
    )
    parser.add_argument(
        "mission", metavar="MISSION", nargs="?", action=_Mission, const=default, default=argparse.SUPPRESS,
        help=f"file or one of: {shipped}",
    )  # fmt: skip


def add_flown_option(parser: argparse.ArgumentParser, default: float | None) -> None:
    """Add the option `--flown` of commands that judge missions: the least share of the path.

    Args:
        parser: the command's.
        default: None where it depends on whether there is a sea.
    """
    usual = f"{LEAST_SHARE:g}, at sea {LEAST_SHARE_AT_SEA:g}" if default is None else f"{default:g}"
    parser.add_argument(
        "--flown",
        type=share,
        default=default,
        metavar="SHARE",
        help=f"least share of the path for a complete mission (default: {usual})",
    )
