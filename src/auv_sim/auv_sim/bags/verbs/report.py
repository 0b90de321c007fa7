"""Write one self-contained, interactive HTML page about a recording, and pictures beside it."""

from __future__ import annotations

import argparse
import html
import json
import re
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from rich.console import Console

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.strict_json import without_nan
from auv_sim.bags.content.events import events_of
from auv_sim.bags.content.recorded_mission import RecordedMission, mission_in
from auv_sim.bags.content.vehicle_parts import read_vehicles
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.showing.fleet_data import fleet_data
from auv_sim.bags.showing.report_data import page_data
from auv_sim.bags.showing.report_pictures import pictures
from auv_sim.bags.verbs.arguments import add_choice
from auv_sim.command_line import say, to_type
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, wrote

PAGE = "report.html"
#: The page's parts: the template, and the scripts of the view in three dimensions.
_PAGE, _IN_SPACE = "report.html", ("geometry.js", "space.js")
#: What the report shares with the console: colours, and the drawing of axes, lines and maps.
_COLOURS, _DRAWING = "colours.css", ("drawing.js", "map_drawing.js")
#: The page of a fleet.
_OF_FLEET = "fleet.html"
#: What each file is for.
_WHAT = {
    PAGE: "everything, for a browser",
    "overview.png": "the mission in one picture",
    "track.png": "the track",
    "signals.png": "the signals over time",
    "dive.png": "the dive in three dimensions, and its depth",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument("bag", type=Path, metavar="BAG", help="recording or run directory")
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="directory to write (default: report/ beside the recording)"
    )
    parser.add_argument("--mission", metavar="FILE", help="the flown mission, if it is not recorded")
    add_choice(parser)


def run(arguments: argparse.Namespace) -> int:
    """Write the page and the pictures; of a fleet, a page for all and one for each vehicle below it."""
    bags = read_vehicles(arguments.bag, odometry=arguments.odometry, namespace=arguments.namespace)
    flights = {}
    for name, bag in bags.items():
        for note in bag.notes:
            say(f"damaged: {note}")
        flights[name] = mission_in(bag, arguments.mission, arguments.namespace)
    console = terminal()
    if len(flights) > 1:
        return _report_fleet(flights, arguments, console)
    flight = next(iter(flights.values()))
    for file in _write(flight, arguments.out or _beside(flight.bag)):
        wrote(console, file, _WHAT[file.name])
    if flight.summary is not None:
        go_on(console, "Try other gains on it", to_type("bag.py", "rerun", arguments.bag, params="NEW.yaml"))
    else:
        go_on(console, "Every number in one table", to_type("bag.py", "export", arguments.bag))
    return 0


def _report_fleet(
    flights: Mapping[str, RecordedMission], arguments: argparse.Namespace, console: Console
) -> int:
    """Write the fleet's page and those of the vehicles."""
    place = arguments.bag.parent if arguments.bag.name == "bag" else arguments.bag
    directory = arguments.out or place / "report"
    for name, flight in flights.items():
        _write(flight, directory / name)
    pages = {name: f"{name}/{PAGE}" for name in flights}
    page = directory / PAGE
    write_text(page, _filled(_OF_FLEET, fleet_data(flights, pages, place.resolve().name)))
    wrote(console, page, "all vehicles, for a browser")
    for name in flights:
        wrote(console, directory / name, f"the page and the pictures of {name}")
    go_on(console, "Lay them over each other", to_type("bag.py", "compare", arguments.bag))
    return 0


def _write(flight: RecordedMission, directory: Path) -> list[Path]:
    """Write one vehicle's page and pictures; return the files.

    Raises:
        ConfigurationError: the directory cannot be written to.
    """
    try:
        directory.mkdir(parents=True, exist_ok=True)
        page = directory / PAGE
        write_text(page, page_of(flight))
        if not flight.parts:
            return [page, *pictures(flight, directory, _title(flight))]
        files = [page]
        for number, part in enumerate(flight.parts, 1):
            below = directory / f"mission_{number}"
            below.mkdir(exist_ok=True)
            files += pictures(part, below, _title(part))
        return files
    except OSError as error:
        raise ConfigurationError(str(directory), f"{error.strerror}", "a place to write to") from None


def page_of(flight: RecordedMission) -> str:
    """Return the self-contained page as text."""
    title = _title(flight)
    content = page_data(flight, events_of(flight), title)
    more = "".join(f"<script>\n{_part(name)}</script>\n" for name in _IN_SPACE if content["space"])
    return _filled(_PAGE, content, more)


def _filled(part: str, content: dict[str, Any], more: str = "") -> str:
    """Return a page with its content, its title and further scripts."""
    data = json.dumps(without_nan(content), allow_nan=False)
    # The data must not end the element that contains it.
    data = data.replace("<", "\\u003c")
    page = _part(part).replace("{{MORE}}", more).replace("{{COLOURS}}", _shared(_COLOURS))
    page = page.replace("{{DRAWING}}", "".join(_as_script(_shared(name)) for name in _DRAWING))
    return page.replace("{{TITLE}}", html.escape(content["title"])).replace("{{DATA}}", data)


def _part(name: str) -> str:
    """Return a part of the page."""
    return resources.files("auv_sim.bags.showing").joinpath("page", name).read_text(encoding="utf-8")


def _shared(name: str) -> str:
    """Return a part that the console's page has too."""
    return resources.files("auv_sim.views.console").joinpath("page", name).read_text(encoding="utf-8")


def _as_script(module: str) -> str:
    """Return a module's text for a page in one file: without imports, its exports as plain definitions."""
    return re.sub(r"^import .*\n|^export (?=\w)", "", module, flags=re.MULTILINE)


def _title(flight: RecordedMission) -> str:
    path = flight.bag.path
    name = path.parent.name if path.name == "bag" else path.stem
    name = f"{name} {flight.bag.vehicle}" if flight.bag.vehicle is not None else name
    return f"{flight.mission.name}: {name}" if flight.mission is not None else name


def _beside(bag: Bag) -> Path:
    return (
        bag.path.parent / "report" if bag.path.name == "bag" else bag.path.parent / f"{bag.path.stem}-report"
    )
