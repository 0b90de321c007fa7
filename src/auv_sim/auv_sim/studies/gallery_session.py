"""What `scripts/gallery.py` does: fly the missions over ROS 2, draw them, renew the page's table."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

from auv_msgs_py.values.errors import SuiteError
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_sim.bags.reading.load import load
from auv_sim.bags.texts import texts_below
from auv_sim.command_line import make_directory, say
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import Run
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.studies.gallery_picture import draw
from auv_sim.views import doc_pages

KINDS = ("linear", "circular", "dubins", "clothoid", "fermat")
#: Currents of each kind's flights: (north, east), m/s.
CURRENTS = {"none": (0.0, 0.0), "current": (0.1, 0.2)}
#: Name of the table's part of the page.
PART = "gallery"
_TITLES = {
    "linear": "Piecewise linear",
    "circular": "Circular smoothing",
    "dubins": "Dubins",
    "clothoid": "Clothoid smoothing",
    "fermat": "Fermat's spiral smoothing",
}


class GalleryFlight(NamedTuple):
    """One mission flown: its rows under way and its figures."""

    run: Run
    summary: dict[str, Any]


def renew(page: Path, images: Path, runs: Path, params: str) -> None:
    """Fly what is missing, draw every kind, renew the page's table.

    Args:
        page: with a part to renew.
        images: folder of the pictures.
        runs: folder of the flights; complete ones of the same configuration are used as they are.
        params: gains, a file or a shipped name.

    Raises:
        ConfigurationError: the page, a folder or the gains cannot be used.
        SuiteError: a flight failed.
    """
    doc_pages.check(page, PART)  # before ten flights, not after
    make_directory(images, "--images")
    rows = []
    for kind in KINDS:
        mission = mission_file.load(f"course_{kind}")
        flights = {name: _flown(kind, name, runs, params) for name in CURRENTS}
        picture = images / f"course_{kind}.png"
        tracks = {name: flight.run for name, flight in flights.items()}
        draw(mission, tracks, CURRENTS["current"], _TITLES[kind], picture)
        rows.append(_row(kind, mission, flights))
    doc_pages.renew(page, PART, _table(rows))


def _flown(kind: str, name: str, runs: Path, params: str) -> GalleryFlight:
    """Return the flight of one mission over the ROS graph, flown now or at an earlier start.

    It is flown in a scratch directory, which gets its final name only when the flight is complete.
    """
    directory = (runs / f"{kind}-{name}").absolute()
    scratch = directory.with_name(f"{directory.name}.part")
    shutil.rmtree(scratch, ignore_errors=True)
    asked = Options(
        mission=f"course_{kind}", params=params, current=CURRENTS[name] if any(CURRENTS[name]) else None
    )
    if not _is_the_same(directory, _configuration(asked, scratch)):
        say(f"flying {asked.mission}, {name}")
        arguments = ["--mission", asked.mission, "--params", params, "--out", str(scratch), "--quiet"]
        if asked.current is not None:
            arguments += ["--current", *map(str, asked.current)]
        if launch(arguments) != 0:
            raise SuiteError(f"{asked.mission}: the flight failed, see {scratch}")
        shutil.rmtree(directory, ignore_errors=True)
        scratch.rename(directory)
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    mission = mission_file.load(asked.mission)
    return GalleryFlight(under_way(load(directory / "bag"), mission.path.n), summary)


def _configuration(asked: Options, scratch: Path) -> dict[str, str]:
    """Return the text of every file that the launcher would write for this flight, by name."""
    mission_plan.make(asked, scratch).write(scratch / "config")
    texts = texts_below(scratch / "config")
    shutil.rmtree(scratch)
    return texts


def _is_the_same(directory: Path, configuration: dict[str, str]) -> bool:
    """Whether a complete flight with this configuration is there."""
    summary = directory / "summary.json"
    if not summary.is_file() or json.loads(summary.read_text(encoding="utf-8"))["outcome"] != "complete":
        return False
    return texts_below(directory / "config") == configuration


def launch(arguments: list[str]) -> int:
    """Run `scripts/mission.py` as a process and return its exit code.

    Ctrl-C is passed on, so that the launcher stops its nodes first.
    """
    program = "from auv_sim.cli.mission import main; raise SystemExit(main())"
    command = [sys.executable, "-c", program, *arguments]
    process = subprocess.Popen(command, start_new_session=True)  # noqa: S603 - our own launcher
    try:
        return process.wait()
    except KeyboardInterrupt:
        process.send_signal(signal.SIGINT)
        process.wait()
        raise


def _row(kind: str, mission: Mission, flights: dict[str, GalleryFlight]) -> list[str]:
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
