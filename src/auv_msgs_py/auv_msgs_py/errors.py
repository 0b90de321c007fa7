"""The errors that a person is meant to read: always one line, always with the place."""

from __future__ import annotations


class SuiteError(Exception):
    """Base of every error that is the fault of an input, never of the suite."""


class ConfigurationError(SuiteError):
    """A file, a parameter or an option that cannot be used.

    Args:
        where: the file and key (``mission.yaml: segments[2].line.length``), or the option.
        found: what stood there.
        expected: what would have been accepted.
    """

    def __init__(self, where: str, found: str, expected: str) -> None:
        super().__init__(f"{where}: found {found}, expected {expected}")
        self.where = where
        self.found = found
        self.expected = expected


class MessageRefused(SuiteError):
    """A message that must not be used; nodes count it and name it in /diagnostics.

    Args:
        topic: topic the message came on.
        found: what was wrong with it.
        expected: what would have been accepted.
    """

    def __init__(self, topic: str, found: str, expected: str) -> None:
        super().__init__(f"{topic}: found {found}, expected {expected}")
        self.topic = topic
        self.found = found
        self.expected = expected


class LockstepBroken(SuiteError):
    """A rule of lockstep was broken: flying on would pair messages of different steps."""
