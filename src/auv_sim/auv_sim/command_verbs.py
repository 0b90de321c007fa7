"""The parser of a command with verbs, each of which is a module."""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Container, Mapping

from auv_sim.command_line import Parser


def parser_of_verbs(
    prog: str, description: str, package: str, verbs: Mapping[str, str], verbs_with_options: Container[str]
) -> argparse.ArgumentParser:
    """Return a parser; what it parses has `run`, which takes it and returns the exit code.

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
        verb.set_defaults(run=module.run)
    return top
