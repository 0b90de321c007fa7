"""Errors for the user: one line each, with the place, what was found and what was expected."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

#: A place or a finding longer than this is printed without its middle, characters.
_LONGEST = 400
#: More errors than this are counted, not listed.
_MOST_JOINED = 30


def printable(text: str) -> str:
    """Return text from a file or a message as one line that is safe to print.

    Control characters (terminal escapes among them), line ends and invisible characters are spelled out
    (``\\x1b``).
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


def printable_lines(text: str) -> str:
    """Return text as `printable` does, with its line ends."""
    return "\n".join(map(printable, text.split("\n")))


def shortened(text: str, longest: int = _LONGEST) -> str:
    """Leave out the middle of a text that is longer than `longest` characters."""
    if len(text) <= longest:
        return text
    end = (longest - 3) // 2
    return f"{text[:end]}...{text[-end:]}"


class SuiteError(Exception):
    """Base of every error that is the fault of an input, never of the suite; safe to print.

    It can be pickled whatever its arguments, and so comes back from a worker process.
    """

    def __str__(self) -> str:
        return printable_lines(super().__str__())

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (type(self), self.args), self.__dict__


def _unpickled(kind: type[SuiteError], arguments: tuple[Any, ...]) -> SuiteError:
    """Return an error with the text of another process: `Exception` would pass the text as all arguments."""
    return kind.__new__(kind, *arguments)


class ConfigurationError(SuiteError):
    """A file, a parameter or an option that cannot be used.

    Args:
        where: the file and key (``mission.yaml: segments[2].line.length``), or the option.
        found: what is there.
        expected: what would have been accepted.
    """

    def __init__(self, where: str, found: str, expected: str) -> None:
        super().__init__(printable(f"{shortened(where)}: found {shortened(found)}, expected {expected}"))
        self.where = where
        self.found = found
        self.expected = expected


def joined(errors: Sequence[ConfigurationError], file: str) -> ConfigurationError:
    """Return one error for everything that is wrong with a file: the first error, followed by the others.

    Args:
        errors: at least one.
        file: common beginning of their places; only the first keeps it.
    """
    first, *others = errors
    listed = [
        f"{other.where.removeprefix(f'{file}: ')}: found {shortened(other.found)}, expected {other.expected}"
        for other in others[:_MOST_JOINED]
    ]
    if len(others) > len(listed):
        listed.append(f"and {len(others) - len(listed)} more")
    return ConfigurationError(first.where, first.found, "; ".join([first.expected, *listed]))


class MessageRefused(SuiteError):
    """A message that must not be used; nodes count it and report it in /diagnostics.

    Args:
        topic: topic of the message.
        found: what was wrong with it.
        expected: what would have been accepted.
    """

    def __init__(self, topic: str, found: str, expected: str) -> None:
        super().__init__(printable(f"{shortened(topic)}: found {shortened(found)}, expected {expected}"))
        self.topic = topic
        self.found = found
        self.expected = expected


class LockstepBroken(SuiteError):
    """A rule of lockstep was broken: flying on would pair messages of different steps."""
