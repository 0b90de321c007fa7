"""YAML in, validated settings out; YAML 1.2 scalars, duplicate keys refused, every size bounded."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

import yaml

from auv_msgs_py.settings import user_files, yaml_document
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.settings.schema import validated
from auv_msgs_py.values.errors import ConfigurationError

T = TypeVar("T")

#: Largest YAML file that is read, bytes.
MOST_BYTES = 4_000_000


class _Dumper(yaml.SafeDumper):
    """Dumper that quotes text which YAML 1.1 or 1.2 would read as something else."""


_Dumper.add_implicit_resolver("tag:yaml.org,2002:float", yaml_document.FLOAT, "-+0123456789.")


def parse(path: Path) -> Any:
    """Read a file as plain Python objects.

    Raises:
        ConfigurationError: the file is missing, not readable, too large, not text or not YAML, with line and
            column.
    """
    return parse_text(user_files.read_text(path, "a YAML file", MOST_BYTES), str(path))


def parse_text(text: str, where: str) -> Any:
    """Read YAML text as plain Python objects.

    Args:
        text: the YAML.
        where: its origin, for the error.

    Raises:
        ConfigurationError: it is not YAML, with line and column.
    """
    try:
        return yaml_document.build(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{where}: line {mark.line + 1}, column {mark.column + 1}" if mark else where
        if mark is not None and _is_indented_by_tab(text.removeprefix("\ufeff"), mark.index):
            raise ConfigurationError(place, "a tab", "spaces: YAML is not indented by tabs") from None
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigurationError(
            place, f"text that cannot be read ({problem})", "YAML, each key once"
        ) from None


def _is_indented_by_tab(text: str, at: int) -> bool:
    """Return whether a place in a text is a tab that only white space precedes in its line."""
    before = text[text.rfind("\n", 0, at) + 1 : at]
    return text[at : at + 1] == "\t" and not before.strip()


def load(path: Path, cls: type[T]) -> T:
    """Read a YAML file into a settings class.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    return checked(parse(path), path, cls)


def checked(data: Any, path: Path, cls: type[T]) -> T:
    """Build a settings class from the content of a YAML file; raises as `load` does."""
    if data is None:
        raise ConfigurationError(str(path), "an empty file", "a mapping of keys to values")
    return validated(cls, data, str(path))


def dump(data: Any, path: Path) -> None:
    """Write plain objects as `text_of` has them.

    Raises:
        NotWritten: the file cannot be written.
    """
    write_text(path, text_of(data))


def text_of(data: Any) -> str:
    """Return plain objects as YAML that this module and ROS 2's parameter parser read alike."""
    return str(yaml.dump(data, Dumper=_Dumper, sort_keys=False, allow_unicode=True))
