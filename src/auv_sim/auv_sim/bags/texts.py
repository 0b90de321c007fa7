"""The flown configuration as texts, which the recorder keeps in every storage file."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from pathlib import Path

#: Name of the MCAP metadata record that holds the texts kept in a file.
TEXTS = "auv_sim.texts"
#: Largest file that is kept as configuration, bytes.
TEXT_LIMIT = 4_000_000


def label_of(namespace: str) -> str:
    """Return the name of a vehicle's directory: `/auv1` -> ``auv1``."""
    return namespace.strip("/").replace("/", "_")


def texts_of_fleet(directory: Path, namespaces: Iterable[str]) -> dict[str, str]:
    """Return the configuration of a fleet's run: the fleet's own, and each vehicle's below its label."""
    texts = texts_below(directory / "config")
    for label in map(label_of, namespaces):
        own = texts_below(directory / label / "config")
        texts |= {f"{label}/{name}": text for name, text in own.items()}
    return texts


def texts_below(directory: Path) -> dict[str, str]:
    """Return the text files below a directory, by relative path; large and binary files are left out."""
    texts = {}
    for file in sorted(directory.rglob("*")):
        if file.is_file() and file.stat().st_size < TEXT_LIMIT:
            with contextlib.suppress(UnicodeDecodeError):
                texts[file.relative_to(directory).as_posix()] = file.read_text(encoding="utf-8")
    return texts
