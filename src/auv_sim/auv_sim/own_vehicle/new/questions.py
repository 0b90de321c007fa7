"""The questions of `vehicle.py new` at a terminal."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple


class Question(NamedTuple):
    """One question.

    Attributes:
        option: whose value the answer is, as in the namespace.
        text: the question.
        parse: of the answer; several words become a list where `several`.
        several: whether more than one value may be given.
        required: whether an answer is needed.
        applies: whether the question makes sense after the earlier answers.
    """

    option: str
    text: str
    parse: Callable[[str], Any]
    several: bool = False
    required: bool = False
    applies: Callable[[argparse.Namespace], bool] = lambda options: True


def ask(
    questions: list[Question],
    options: argparse.Namespace,
    read: Callable[[str], str],
    say: Callable[[str], None],
) -> None:
    """Ask for the options that were not given, and put the answers into `options`.

    Args:
        questions: in their order.
        options: of the command line.
        read: prints a prompt and returns an answer, as `input` does.
        say: prints a line.
    """
    for question in _open(questions, options):
        while True:
            words = read(f"{question.text}{'' if question.required else ' [Enter: not known]'}: ").split()
            if not words and not question.required:
                break
            try:
                values = [question.parse(word) for word in words]
                if not values or (len(values) > 1 and not question.several):
                    raise argparse.ArgumentTypeError(f"found {len(values)} values, expected one")
            except (argparse.ArgumentTypeError, ValueError) as error:
                say(f"  {error}")
                continue
            setattr(options, question.option, values if question.several else values[0])
            break


def _open(questions: list[Question], options: argparse.Namespace) -> Iterator[Question]:
    for question in questions:
        if getattr(options, question.option) in (None, []) and question.applies(options):
            yield question
