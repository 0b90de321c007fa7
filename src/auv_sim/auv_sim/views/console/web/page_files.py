"""The files of the page: a fixed list, so that no address leads to any other file."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import NamedTuple

_TYPES = {
    ".html": "text/html",
    ".css": "text/css",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
}
#: The page itself, below `views/console/page`.
FRONT = "console.html"


class PageFile(NamedTuple):
    """One file and its media type."""

    path: Path
    type: str


def page_files() -> dict[str, PageFile]:
    """Return the files by their name below `/page/`."""
    folder = Path(str(resources.files("auv_sim"))) / "views" / "console" / "page"
    return {
        path.relative_to(folder).as_posix(): PageFile(path, _TYPES[path.suffix])
        for path in sorted(folder.rglob("*"))
        if path.suffix in _TYPES
    }
