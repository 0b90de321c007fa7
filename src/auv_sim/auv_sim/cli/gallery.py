"""`scripts/gallery.py`: Table 1's five kinds of path over the same waypoints, flown, drawn and tabled."""

from __future__ import annotations

import argparse
import json
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from auv_msgs_py.values.errors import SuiteError
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_sim.bags.reading.load import load
from auv_sim.bags.writing.bag_writer import texts_below
from auv_sim.command_line import EXIT_DONE, Parser, command, make_directory, say
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import Run
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.studies.gallery_picture import draw
from auv_sim.views import doc_pages

KINDS = ("linear", "circular", "dubins", "clothoid", "fermat")
CURRENTS = {"none": (0.0, 0.0), "current": (0.1, 0.2)}
#: Of the page.
PART = "gallery"
_TITLES = {
    "linear": "Piecewise linear",
    "circular": "Circular smoothing",
    "dubins": "Dubins",
    "clothoid": "Clothoid smoothing",
    "fermat": "Fermat's spiral smoothing",
}


class Flight(NamedTuple):
    """One mission flown: its rows under way and its figures."""

    run: Run
    summary: dict[str, Any]


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(prog="gallery.py", description=__doc__, allow_abbrev=False)
    p.add_argument(
        "--page",
        type=Path,
        default=Path("docs/missions.md"),
        help="page with the table (default: %(default)s)",
    )
    p.add_argument(
        "--images",
        type=Path,
        default=Path("docs/images"),
        help="folder of the pictures (default: %(default)s)",
    )
    p.add_argument(
        "--runs",
        type=Path,
        default=Path("runs/gallery"),
        help="folder of the flights; one that is there, complete and of the same configuration, is not"
        " flown again (default: %(default)s)",
    )
    p.add_argument("--params", default="robust", help="gains (default: %(default)s)")
    return p


@command("gallery", "interrupted; what was flown is kept, start it again to go on")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly what is not yet there, draw, renew the table; 0 done, 1 failed, 2 bad input, 130 interrupted."""
    _renew(parser().parse_args(argv))
    return EXIT_DONE


def _renew(options: argparse.Namespace) -> None:
    doc_pages.check(options.page, PART)  # before ten flights, not after
    make_directory(options.images, "--images")
    rows = []
    for kind in KINDS:
        mission = mission_file.load(f"course_{kind}")
        flights = {name: _flown(kind, name, options) for name in CURRENTS}
        picture = options.images / f"course_{kind}.png"
        draw(
            mission,
            {name: flight.run for name, flight in flights.items()},
            CURRENTS["current"],
            _TITLES[kind],
            picture,
        )
        rows.append(_row(kind, mission, flights))
    doc_pages.renew(options.page, PART, _table(rows))


def _flown(kind: str, name: str, options: argparse.Namespace) -> Flight:
    """The flight of one mission over the ROS graph, or the same one of an earlier start.

    It is flown under another name, so that only what came to its end ever bears the right one.
    """
    directory = (options.runs / f"{kind}-{name}").absolute()
    scratch = directory.with_name(f"{directory.name}.part")
    shutil.rmtree(scratch, ignore_errors=True)
    asked = Options(
        mission=f"course_{kind}",
        params=options.params,
        current=CURRENTS[name] if any(CURRENTS[name]) else None,
    )
    wanted = _configuration(asked, scratch)
    if not _is_the_same(directory, wanted):
        say(f"flying {asked.mission}, {name}")
        arguments = ["--mission", asked.mission, "--params", asked.params, "--out", str(scratch), "--quiet"]
        if asked.current is not None:
            arguments += ["--current", *map(str, asked.current)]
        if launch(arguments) != 0:
            raise SuiteError(f"{asked.mission}: the flight failed, see {scratch}")
        shutil.rmtree(directory, ignore_errors=True)
        scratch.rename(directory)
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    mission = mission_file.load(asked.mission)
    return Flight(under_way(load(directory / "bag"), mission.path.n), summary)


def _configuration(asked: Options, scratch: Path) -> dict[str, str]:
    """What the launcher will write down: every file that it flies with, and every parameter."""
    mission_plan.make(asked, scratch).write(scratch / "config")
    told = texts_below(scratch / "config")
    shutil.rmtree(scratch)
    return told


def _is_the_same(directory: Path, wanted: dict[str, str]) -> bool:
    """Whether a flight is there, came to its end, and was flown with the same files and parameters."""
    summary = directory / "summary.json"
    if not summary.is_file() or json.loads(summary.read_text(encoding="utf-8"))["outcome"] != "complete":
        return False
    return texts_below(directory / "config") == wanted


def launch(arguments: list[str]) -> int:
    """`scripts/mission.py` as a process; returns its exit code. Ctrl-C lets it end its nodes first."""
    program = "from auv_sim.cli.mission import main; raise SystemExit(main())"
    command = [sys.executable, "-c", program, *arguments]
    process = subprocess.Popen(command, start_new_session=True)  # noqa: S603 - our own launcher
    try:
        return process.wait()
    except KeyboardInterrupt:
        process.send_signal(signal.SIGINT)
        process.wait()
        raise


def _row(kind: str, mission: Mission, flights: dict[str, Flight]) -> list[str]:
    joints = {joint.geometric for joint in mission.path.joints}
    cells = [_TITLES[kind], min(joints), f"{mission.path.length:.1f}"]
    for flight in flights.values():
        rms, largest = flight.summary["rms_distance"], flight.summary["largest_distance"]
        travel = flight.summary["rudder_travel_per_metre"]
        cells += [f"{rms:.3f}", f"{largest:.2f}", f"{travel:.2f}"]
    return cells


def _table(rows: list[list[str]]) -> str:
    heads = ["path", "joints", "length (m)"]
    for where in ("", " in the current"):
        heads += [f"rms (m){where}", f"largest (m){where}", f"rudder (°/m){where}"]
    return doc_pages.markdown_table(heads, rows, left=2)


if __name__ == "__main__":
    raise SystemExit(main())
