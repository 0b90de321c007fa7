"""Find mission, vehicle and parameter files by path or by the name of a shipped one."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Literal

from auv_msgs_py.settings import user_files
from auv_msgs_py.values.errors import ConfigurationError

Kind = Literal["missions", "vehicles", "params", "seas", "studies", "fleets", "manoeuvres"]

_WORD: dict[Kind, str] = {
    "missions": "mission",
    "vehicles": "vehicle",
    "params": "parameter",
    "seas": "sea",
    "studies": "study",
    "fleets": "fleet",
    "manoeuvres": "manoeuvre",
}


def shipped(kind: Kind) -> dict[str, Path]:
    """Return the shipped files by name without suffix."""
    folder = Path(str(resources.files("auv_path_following"))) / "config" / kind
    return {path.stem: path for path in sorted(folder.glob("*.yaml"))}


def find(kind: Kind, name_or_path: str) -> Path:
    """Return the file of a path or name.

    Args:
        kind: of the file.
        name_or_path: an existing file wins; else the name of a shipped one, with or without ``.yaml``.

    Raises:
        ConfigurationError: there is neither; lists the shipped names.
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
