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
    """Return the files by their name below `/page/`; those shared with the report are below `shared/`."""
    suite = Path(str(resources.files("auv_sim")))
    own, shared = suite / "views" / "console" / "page", suite / "bags" / "showing" / "page"
    found = {path.relative_to(own).as_posix(): path for path in sorted(own.rglob("*"))}
    found |= {f"shared/{path.name}": path for path in sorted(shared.glob("*.js"))}
    return {
        name: PageFile(path, _TYPES[path.suffix]) for name, path in found.items() if path.suffix in _TYPES
    }
