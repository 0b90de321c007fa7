"""`scripts/gallery.py`: Table 1's five kinds of path over the same waypoints, flown, drawn and tabled."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_sim.command_line import EXIT_DONE, Parser, command


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="gallery.py",
        description="Fly, draw and tabulate the five kinds of path over the same waypoints.",
        allow_abbrev=False,
    )
    p.add_argument(
        "--page", type=Path, default=Path("docs/missions.md"),
        help="page with the table (default: %(default)s)",
    )  # fmt: skip
    p.add_argument(
        "--images", type=Path, default=Path("docs/images"),
        help="folder of the pictures (default: %(default)s)",
    )  # fmt: skip
    p.add_argument(
        "--runs", type=Path, default=Path("runs/gallery"),
        help="folder of the flights; a complete flight of the same configuration is not flown again"
        " (default: %(default)s)",
    )  # fmt: skip
    p.add_argument("--params", default="robust", help="gains (default: %(default)s)")
    return p


@command("gallery", "interrupted; complete flights are kept, start it again to go on")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly what is missing, draw, renew the table; return 0 done, 1 failed, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    from auv_sim.studies.gallery_session import renew

    renew(options.page, options.images, options.runs, options.params)
    return EXIT_DONE


if __name__ == "__main__":
    raise SystemExit(main())
