"""What all command lines share: numbers that are checked, one line for a mistake, the exit codes."""

from __future__ import annotations

import argparse
import math
import os
import re
import sys
from typing import NoReturn

from rich.console import Console

EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130


class Parser(argparse.ArgumentParser):
    """One line and exit code 2, without the usage in front of it."""

    def error(self, message: str) -> NoReturn:
        print(f"{self.prog}: {message} (see --help)", file=sys.stderr)
        raise SystemExit(EXIT_BAD_INPUT)


def finite(text: str) -> float:
    """A number, neither NaN nor infinite."""
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"found {text}, expected a finite number")
    return value


def positive(text: str) -> float:
    """A number greater than 0."""
    value = finite(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected a number greater than 0")
    return value


def not_negative(text: str) -> float:
    """A number of at least 0."""
    value = finite(text)
    if value < 0.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected a number that is not negative")
    return value


def whole(text: str) -> int:
    """A whole number of at least 0."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"found '{text}', expected a whole number of at least 0")
    return int(text)


# argparse names the type in its message when float() itself fails.
finite.__name__ = positive.__name__ = not_negative.__name__ = "number"


def ros_namespace(text: str) -> str:
    """A ROS namespace with one slash in front."""
    name = "/" + text.strip("/")
    if not re.fullmatch(r"(/[A-Za-z_][A-Za-z0-9_]*)+", name):
        raise argparse.ArgumentTypeError(f"found '{text}', expected a ROS namespace such as /auv")
    return name


def ros_domain(text: str) -> int:
    """A ROS domain."""
    if not text.isdecimal() or int(text) > 232:
        raise argparse.ArgumentTypeError(f"found '{text}', expected a ROS domain from 0 to 232")
    return int(text)


def console(quiet: bool = False) -> Console:
    """Where tables go: as wide as the terminal; in a pipe or a file wide enough for the widest table."""
    free = not sys.stdout.isatty() and "COLUMNS" not in os.environ
    return Console(width=140 if free else None, quiet=quiet, highlight=False)
