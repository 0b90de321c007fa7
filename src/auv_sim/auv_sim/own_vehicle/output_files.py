"""Files that a command writes: checked before their content is computed."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from auv_msgs_py.values.errors import ConfigurationError


def vehicle_file_of(name: str) -> Path:
    """Return the file that `vehicle.py new` writes for a vehicle of this name."""
    stem = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_") or "vehicle"
    return Path(f"{stem}.yaml")


def survey_beside(file: Path) -> Path:
    """Return the survey that `vehicle.py new` writes beside a vehicle file."""
    return file.with_name(f"{file.stem}_survey.yaml")


def check_outputs(files: Iterable[Path], inputs: Iterable[Path], overwrite: bool) -> None:
    """Check that files may be written and replace nothing that is needed.

    Args:
        files: to write.
        inputs: files and directories which are read, and never replaced.
        overwrite: whether other files that exist are replaced.

    Raises:
        ConfigurationError: one is an input or a directory, or exists.
    """
    read = {file.resolve() for file in inputs}
    for file in files:
        if file.resolve() in read:
            raise ConfigurationError("--out", f"{file}, which is read", "another file")
        if file.is_dir():
            raise ConfigurationError("--out", f"{file}, a directory", "a file that can be written")
        if file.exists() and not overwrite:
            raise ConfigurationError("--out", f"{file}, which exists", "a new file, or --overwrite")
