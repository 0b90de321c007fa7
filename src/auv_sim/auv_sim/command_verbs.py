"""A command with verbs, each of which is a module: its parser, and how a verb is run."""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Callable, Container, Iterable, Mapping, Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.command_line import Parser


def parser_of_verbs(
    prog: str, description: str, package: str, verbs: Mapping[str, str], verbs_with_options: Container[str]
) -> argparse.ArgumentParser:
    """Return a parser; what it parses has `run`, which takes it and returns the exit code, and `usual`.

    Args:
        prog, description: of the command.
        package: where each verb is a module: its docstring is the help, `add_arguments` and `run` are called.
        verbs: name -> what it does, in the order of the help.
        verbs_with_options: only these get their options, as importing a verb takes long.
    """
    top = Parser(prog=prog, description=description, allow_abbrev=False)
    parsers = top.add_subparsers(dest="verb", required=True, metavar="VERB", parser_class=Parser)
    for name, what in verbs.items():
        if name not in verbs_with_options:
            parsers.add_parser(name, help=what)
            continue
        module = importlib.import_module(f"{package}.{name}")
        verb = parsers.add_parser(
            name, help=what, description=module.__doc__, allow_abbrev=False,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )  # fmt: skip
        module.add_arguments(verb)
        verb.set_defaults(run=module.run, usual=verb.get_default)
    return top


def refuse_without_effect(
    options: argparse.Namespace, names: Iterable[str], found: str, expected: str
) -> None:
    """Refuse options that another one leaves without effect.

    Args:
        options: of a verb; `usual` returns the default of a name.
        names: of the options.
        found: what leaves them without effect.
        expected: what would give them an effect.

    Raises:
        ConfigurationError: one is given.
    """
    for name in names:
        if getattr(options, name) != options.usual(name):
            option = f"--{name.replace('_', '-')}"
            raise ConfigurationError(option, found, f"{expected}, or the option left out")


def run_verb(
    parser_with: Callable[[Container[str]], argparse.ArgumentParser], argv: Sequence[str] | None
) -> int:
    """Parse a command line, run its verb, and return the exit code.

    Args:
        parser_with: returns the parser in which only some verbs have their options.
        argv: the words; None for those of the process.
    """
    words = sys.argv[1:] if argv is None else argv
    arguments = parser_with(words[:1]).parse_args(words)
    return int(arguments.run(arguments))
