"""Parts of every command line: checked numbers, one line for an error, exit codes."""

from __future__ import annotations

import argparse
import functools
import math
import os
import re
import shlex
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn, ParamSpec, TypeVar

from auv_msgs_py.node.log_directory import ensure_log_directory
from auv_msgs_py.values.errors import (
    ConfigurationError,
    MessageRefused,
    SuiteError,
    printable,
    printable_lines,
)
from auv_msgs_py.values.ros_domain import EXPECTED, is_ros_domain

P = ParamSpec("P")
A = TypeVar("A", bound=argparse.Action)

#: Of the scripts whose module has another name.
_MODULES = {
    "vehicle.py": "auv_sim.cli.vehicles.vehicle_command",
    "check_vehicle.py": "auv_sim.cli.vehicles.check_vehicle",
}
EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130


def command(name: str, interrupted: str = "interrupted") -> Callable[[Callable[P, int]], Callable[P, int]]:
    """Decorate a command's `main`, which returns the exit code, with the handling of errors.

    Unusable input prints one line and exits with 2, any other foreseen failure prints one line and exits
    with 1, Ctrl-C exits with 130. When the reader of its output leaves (`head`), a command that only prints
    exits with 0.

    Args:
        name: of the command, for the message.
        interrupted: the message for Ctrl-C, unless the KeyboardInterrupt has one.
    """

    def ending(main: Callable[P, int]) -> Callable[P, int]:
        @functools.wraps(main)
        def ends(*arguments: P.args, **options: P.kwargs) -> int:
            ensure_log_directory()
            try:
                return main(*arguments, **options)
            except (ConfigurationError, MessageRefused) as error:
                say(error, error=True)
                return EXIT_BAD_INPUT
            except SuiteError as error:
                say(f"{name} failed: {error}", error=True)
                return EXIT_FAILED
            except KeyboardInterrupt as stop:
                say(str(stop) or interrupted, error=True)
                return EXIT_INTERRUPTED
            except BrokenPipeError:
                discard_output()
                return EXIT_DONE

        return ends

    return ending


class Parser(argparse.ArgumentParser):
    """Prints an error as one line, without the usage, and exits with 2.

    Attributes:
        actions: every option and argument, in the order of `--help`.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self.actions: list[argparse.Action] = []
        super().__init__(*arguments, **options)

    def _add_action(self, action: A) -> A:
        self.actions.append(action)
        return super()._add_action(action)

    def error(self, message: str) -> NoReturn:
        print(printable(f"{self.prog}: {message} (see --help)"), file=sys.stderr)
        raise SystemExit(EXIT_BAD_INPUT)


def finite(text: str) -> float:
    """Parse a finite number."""
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"found {text}, expected a finite number")
    return value


def positive(text: str) -> float:
    """Parse a number greater than 0."""
    value = finite(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected a number greater than 0")
    return value


def not_negative(text: str) -> float:
    """Parse a number of at least 0."""
    value = finite(text)
    if value < 0.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected a number that is not negative")
    return value


def share(text: str) -> float:
    """Parse a number from 0 to 1."""
    value = finite(text)
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected a share from 0 to 1")
    return value


def whole(text: str) -> int:
    """Parse a whole number of at least 0."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"found '{text}', expected a whole number of at least 0")
    return int(text)


def at_least_one(text: str) -> int:
    """Parse a whole number of at least 1."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"found '{text}', expected a whole number of at least 1")
    return int(text)


def target(text: str) -> Path:
    """Parse the path of a file to write, checked before its content is computed."""
    file = Path(text)
    if file.is_dir():
        why = ", a directory"
    elif not file.parent.is_dir():
        why = " in a directory that does not exist"
    elif not os.access(file if file.exists() else file.parent, os.W_OK):
        why = ", which is not writable"
    else:
        return file
    raise argparse.ArgumentTypeError(f"found '{text}'{why}, expected a file that can be written")


def add_overwrite(parser: argparse.ArgumentParser) -> None:
    """Add the option that lets a command replace files that exist."""
    parser.add_argument("--overwrite", action="store_true", help="replace files that exist")


def add_quiet(parser: argparse.ArgumentParser) -> None:
    """Add the option that leaves errors and notices alone on the terminal."""
    parser.add_argument("--quiet", action="store_true", help="print nothing unless something goes wrong")


# argparse names the type in its message when float() itself fails.
finite.__name__ = positive.__name__ = not_negative.__name__ = share.__name__ = "number"


def ros_namespace(text: str) -> str:
    """Parse a ROS namespace; return it with one leading slash; `/` is the root."""
    name = "/" + text.strip("/")
    if not text or not re.fullmatch(r"/|(/[A-Za-z_][A-Za-z0-9_]*)+", name):
        raise argparse.ArgumentTypeError(f"found '{text}', expected a ROS namespace such as /auv")
    return name


def ros_domain(text: str) -> int:
    """Parse a ROS domain."""
    if not is_ros_domain(text):
        raise argparse.ArgumentTypeError(f"found '{text}', expected {EXPECTED}")
    return int(text)


def to_type(script: str, *words: object, **options: object) -> str:
    """Return a command of `scripts/`, quoted for the shell that started the present one.

    Where the package is installed without the scripts, as by colcon, it is the command's module.

    Args:
        script: its file.
        words: positional arguments.
        options: name -> value, or several; True stands for the option alone, None for none.
    """
    line = [*_program(script), *map(str, words)]
    for name, value in options.items():
        if value is not None:
            values = value if isinstance(value, (tuple, list)) else () if value is True else (value,)
            line += [f"--{name.replace('_', '-')}", *map(str, values)]
    return shlex.join(line)


def _program(script: str) -> list[str]:
    """Return what starts a script, its path as that of the running one: the shell may be in any directory."""
    running = Path(sys.argv[0])
    if running.resolve().parent.name == "scripts" and running.with_name(script).is_file():
        return ["python3", str(running.with_name(script))]
    if (Path(__file__).resolve().parents[3] / "scripts" / script).is_file():
        return ["python3", f"scripts/{script}"]
    return [sys.executable, "-m", _MODULES.get(script, f"auv_sim.cli.{Path(script).stem}")]


def not_default(parser: argparse.ArgumentParser, options: argparse.Namespace) -> dict[str, Any]:
    """Return the options that differ from their defaults, in the parser's order, as `to_type` takes them."""

    def plain(value: Any) -> Any:
        return tuple(value) if isinstance(value, list) else value  # what several words were parsed into

    return {
        name: value
        for name, value in vars(options).items()  # argparse fills them in the parser's order
        if plain(value) != plain(parser.get_default(name))
    }


def discard_output() -> None:
    """Redirect standard output to the null device, once its reader has gone."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def say(text: object, error: bool = False) -> None:
    """Print a line with its control characters escaped."""
    print(printable_lines(str(text)), file=sys.stderr if error else sys.stdout, flush=True)


def make_directory(path: Path, option: str = "--out", new: bool = False) -> None:
    """Make a directory and its parents.

    Args:
        path: the directory.
        option: the option that named it.
        new: whether it must not exist yet.

    Raises:
        ConfigurationError: it cannot be made.
    """
    try:
        path.mkdir(parents=True, exist_ok=not new)
    except OSError as error:
        raise ConfigurationError(
            option, f"{path} ({error.strerror})", "a directory that can be made"
        ) from None
