"""Finds mission, vehicle and parameter files: a path, or the name of one that is shipped."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Literal

from auv_msgs_py.settings import user_files
from auv_msgs_py.values.errors import ConfigurationError

Kind = Literal["missions", "vehicles", "params", "seas", "studies"]

_WORD: dict[Kind, str] = {
    "missions": "mission",
    "vehicles": "vehicle",
    "params": "parameter",
    "seas": "sea",
    "studies": "study",
}


def shipped(kind: Kind) -> dict[str, Path]:
    """The files that come with the suite, by their names without suffix."""
    folder = Path(str(resources.files("auv_path_following"))) / "config" / kind
    return {path.stem: path for path in sorted(folder.glob("*.yaml"))}


def find(kind: Kind, name_or_path: str) -> Path:
    """The file that a person means.

    Args:
        kind: which sort of file is wanted.
        name_or_path: an existing file wins; else the name of a shipped one, with or without ``.yaml``.

    Raises:
        ConfigurationError: neither; it lists the shipped names.
    """
    path = user_files.from_home(name_or_path)
    exists = user_files.exists(path)
    if exists and not user_files.is_directory(path):
        return path
    files = shipped(kind)
    name = name_or_path.removesuffix(".yaml")
    if name in files:
        return files[name]
    word = _WORD[kind]
    found = f"no {word} file there" if exists else f"no such {word} file"
    raise ConfigurationError(name_or_path or "''", found, f"a path, or a shipped name: {', '.join(files)}")
