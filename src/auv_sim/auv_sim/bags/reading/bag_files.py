"""The files of a recording: metadata.yaml names them, and no name leads out of the directory."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.values.errors import ConfigurationError, printable, shortened
from auv_sim.bags.metadata import METADATA_FILE

#: The expected form of a recording, for messages.
A_BAG = "a rosbag2 directory with storage files and metadata.yaml"
#: The note of a recording that lacks this file and nothing else.
NO_METADATA = f"no {METADATA_FILE} (the recording was not closed)"
#: Names of storage files; the first pattern that finds one decides.
_PATTERNS = ("*.mcap", "*.db3", "*.mcap.zstd", "*.db3.zstd", "*.bag")
#: Suffixes of the files that SQLite keeps beside a database: write-ahead log, rollback journal, index.
_COMPANIONS = ("-wal", "-journal", "-shm")
#: Up to this version names begin with the directory's own name.
_WITH_DIRECTORY = 3
#: Longer names are shortened in a note, characters.
_LONG_NAME = 200


def storage_of(path: Path) -> Path:
    """Return the recording that a path stands for: a run directory stands for the bag in it.

    Raises:
        ConfigurationError: nothing is there.
    """
    if not path.exists():
        raise ConfigurationError(str(path), "nothing", A_BAG)
    inside = path / "bag"
    if (
        path.is_dir()
        and inside.is_dir()
        and not (path / METADATA_FILE).exists()
        and not any(any(path.glob(pattern)) for pattern in _PATTERNS)
    ):
        return inside
    return path


def information_of(directory: Path, notes: list[str]) -> dict[str, Any]:
    """Read metadata.yaml; empty, with a note, where it is missing or damaged."""
    file = directory / METADATA_FILE
    if not file.exists():
        if any(any(directory.glob(pattern)) for pattern in _PATTERNS[:-1]):
            notes.append(NO_METADATA)
        return {}
    try:
        content = yaml_file.parse(file)["rosbag2_bagfile_information"]
        if not isinstance(content, dict):
            raise TypeError
    except (ConfigurationError, KeyError, TypeError):
        notes.append(f"{METADATA_FILE} is damaged")
        return {}
    return content


def files_of(path: Path, information: dict[str, Any], notes: list[str]) -> list[Path]:
    """List the storage files in their order: those that metadata.yaml names, then others beside it.

    Each is a regular file, listed once, and lies in the directory: a name that leads out of it gets a note.
    """
    if path.is_file():
        return [path]
    names = information.get("relative_file_paths") or []
    listed: dict[Path, str] = {}
    for name in map(str, names) if isinstance(names, list) else ():
        file = _inside(path, name, information.get("version"))
        if file is None:
            notes.append(f"{METADATA_FILE} names {_shown(name)}, which is not in the recording: left out")
        else:
            listed.setdefault(file, name)
    missing = [_shown(name) for file, name in listed.items() if not file.is_file()]
    notes += [f"{name} is missing" for name in missing]
    found = [file for file in listed if file.is_file()]
    for pattern in _PATTERNS:
        others = [
            file for file in sorted(path.glob(pattern), key=_number) if file not in found and file.is_file()
        ]
        if others and listed and not missing:
            notes += [f"{file.name} is not in {METADATA_FILE}" for file in others]
        found += others
        if found:
            break
    return found


def companions(file: Path) -> list[tuple[Path, str]]:
    """Return the files that SQLite keeps beside an open file, with the suffixes of their names."""
    beside = [(file.with_name(file.name + suffix), suffix) for suffix in _COMPANIONS]
    return [(path, suffix) for path, suffix in beside if path.is_file()]


def _inside(directory: Path, name: str, version: object) -> Path | None:
    """Return the file of this name in the directory, or None where the name leads out of it.

    A link in the directory is followed for reading only: renaming and deleting apply to the link.
    """
    relative = Path(name)
    if isinstance(version, int) and version <= _WITH_DIRECTORY and len(relative.parts) > 1:
        relative = Path(*relative.parts[1:])
    root = directory.resolve()
    try:
        folder = (root / relative).parent.resolve()
        # A name that no file can have (too long, with a zero byte) raises here.
        (root / relative).is_file()
    except (OSError, ValueError):
        return None
    if not folder.is_relative_to(root) or relative.name in ("", ".."):
        return None
    return directory / folder.relative_to(root) / relative.name


def _shown(name: str) -> str:
    """Return a name from a file, safe for a terminal."""
    return shortened(printable(name), _LONG_NAME)


def _number(file: Path) -> tuple[int, str]:
    digits = re.search(r"(\d+)$", file.stem)
    return (int(digits[1]) if digits else -1, file.name)
