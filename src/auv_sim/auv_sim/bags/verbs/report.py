"""Write one self-contained, interactive HTML page about a recording, and pictures beside it."""

from __future__ import annotations

import argparse
import html
import json
import re
from importlib import resources
from pathlib import Path

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.events import events_of
from auv_sim.bags.content.recorded_mission import RecordedMission, mission_in
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.showing.report_data import page_data
from auv_sim.bags.showing.report_pictures import pictures
from auv_sim.bags.verbs.arguments import add_choice
from auv_sim.command_line import say, to_type
from auv_sim.flight.metrics import without_nan
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, wrote

PAGE = "report.html"
#: The page's parts: the template, and the scripts of the view in three dimensions.
_PAGE, _IN_SPACE = "report.html", ("geometry.js", "space.js")
#: What the report shares with the console: colours, and the drawing of axes, lines and maps.
_COLOURS, _DRAWING = "colours.css", ("drawing.js", "map_drawing.js")
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
        "--out", type=Path, metavar="DIR", help="where to (default: report/ beside the recording)"
    )
    parser.add_argument("--mission", metavar="FILE", help="the flown mission, where it is not recorded")
    add_choice(parser)


def run(arguments: argparse.Namespace) -> int:
    """Write the page and the pictures."""
    bag = read_bag(arguments.bag, odometry=arguments.odometry)
    for note in bag.notes:
        say(f"damaged: {note}")
    flight = mission_in(bag, arguments.mission, arguments.namespace)
    directory = arguments.out or _beside(bag)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        page = directory / PAGE
        write_text(page, page_of(flight))
        written = [page, *pictures(flight, directory, _title(flight))]
    except OSError as error:
        raise ConfigurationError(str(directory), f"{error.strerror}", "a place to write to") from None
    console = terminal()
    for file in written:
        wrote(console, file, _WHAT[file.name])
    if flight.summary is not None:
        go_on(console, "Try other gains on it", to_type("bag.py", "rerun", arguments.bag, params="NEW.yaml"))
    else:
        go_on(console, "Every number in one table", to_type("bag.py", "export", arguments.bag))
    return 0


def page_of(flight: RecordedMission) -> str:
    """Return the self-contained page as text."""
    title = _title(flight)
    content = page_data(flight, events_of(flight), title)
    data = json.dumps(without_nan(content), allow_nan=False)
    # The data must not end the element that contains it.
    data = data.replace("<", "\\u003c")
    more = "".join(f"<script>\n{_part(name)}</script>\n" for name in _IN_SPACE if content["space"])
    page = _part(_PAGE).replace("{{MORE}}", more).replace("{{COLOURS}}", _shared(_COLOURS))
    page = page.replace("{{DRAWING}}", "".join(_as_script(_shared(name)) for name in _DRAWING))
    return page.replace("{{TITLE}}", html.escape(title)).replace("{{DATA}}", data)


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
    return f"{flight.mission.name}: {name}" if flight.mission is not None else name


def _beside(bag: Bag) -> Path:
    return (
        bag.path.parent / "report" if bag.path.name == "bag" else bag.path.parent / f"{bag.path.stem}-report"
    )
