"""Show the content of a recording: duration, topics, mission, events; also of damaged and foreign ones.

A directory with several recordings gets one row for each.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
from pathlib import Path
from typing import Any

from rich.console import Console

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.content.events import Event, events_of
from auv_sim.bags.content.recorded_mission import RecordedMission, mission_in
from auv_sim.bags.content.topic_facts import TopicFacts, facts_of
from auv_sim.bags.content.vehicle_parts import read_vehicles
from auv_sim.bags.metadata import METADATA_FILE
from auv_sim.bags.reading.bag_files import storage_of
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.showing import inspect_tables
from auv_sim.bags.verbs.arguments import add_choice
from auv_sim.command_line import say, to_type
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on

#: Large messages of other nodes, of which only the sizes are read.
_HEAVY = ("sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/CompressedImage")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument(
        "bag", type=Path, nargs="+", metavar="BAG", help="recording, run directory, or a directory of many"
    )
    parser.add_argument("--json", action="store_true", help="print JSON, for programs")
    parser.add_argument("--mission", metavar="FILE", help="the flown mission, if it is not recorded")
    add_choice(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print; return 2 when nothing can be read."""
    bags = [bag for path in arguments.bag for bag in find_bags(path)]
    console = terminal()
    if len(bags) > 1:
        return _many(bags, arguments, console)
    vehicles = read_vehicles(bags[0], _is_light, arguments.odometry, arguments.namespace)
    if len(vehicles) > 1:
        return _many(bags, arguments, console)
    bag = next(iter(vehicles.values()))
    flight = mission_in(bag, arguments.mission, arguments.namespace)
    facts, events = facts_of(bag), events_of(flight)
    if arguments.json:
        print(json.dumps(as_data(flight, facts, events), indent=2, allow_nan=False))
    else:
        inspect_tables.show(flight, facts, events, console)
        go_on(console, *_next(flight, arguments.bag[0]))
    return 0


def _next(flight: RecordedMission, path: Path) -> tuple[str, str]:
    """Return the next step and its command."""
    if flight.bag.notes:
        return "Make it whole", to_type("bag.py", "repair", path)
    if flight.run is not None:
        return "Look further", to_type("bag.py", "report", path, **_vehicle(flight.bag))
    return "Play it into a live graph", to_type("bag.py", "replay", path)


def _vehicle(bag: Bag) -> dict[str, str]:
    """Return the option that chooses a vehicle of several; none where there is one."""
    return {"namespace": bag.vehicle} if bag.vehicle is not None else {}


def _is_light(_: str, type_name: str) -> bool:
    return type_name not in _HEAVY


def find_bags(path: Path) -> list[Path]:
    """Return the recordings below a directory, or the path itself if it is one.

    Raises:
        ConfigurationError: nothing is there.
    """
    bag = storage_of(path)
    if bag.is_file() or _is_bag(bag):
        return [bag]
    below = sorted(
        {file.parent for pattern in ("*.mcap", "*.db3", METADATA_FILE) for file in bag.rglob(pattern)}
    )
    return below or [bag]


def _is_bag(path: Path) -> bool:
    return any(any(path.glob(pattern)) for pattern in ("*.mcap", "*.db3", METADATA_FILE))


def _many(bags: list[Path], arguments: argparse.Namespace, console: Console) -> int:
    rows: list[tuple[Path, RecordedMission | None, str]] = []
    for path in bags:
        try:
            for bag in read_vehicles(path, _is_light, arguments.odometry, arguments.namespace).values():
                flight = mission_in(bag, arguments.mission, arguments.namespace)
                rows.append((path, flight, "; ".join(flight.bag.notes)))
        except ConfigurationError as error:
            rows.append((path, None, f"found {error.found}, expected {error.expected}"))
    if arguments.json:
        data = [
            as_data(flight, facts_of(flight.bag), events_of(flight))
            if flight
            else {"path": str(path), "notes": [note]}
            for path, flight, note in rows
        ]
        print(json.dumps(data, indent=2, allow_nan=False))
    else:
        inspect_tables.show_many(rows, console)
        readable = [(path, flight.bag) for path, flight, _ in rows if flight is not None]
        if readable:
            path, bag = readable[-1]
            go_on(console, "Look into one of them", to_type("bag.py", "inspect", path, **_vehicle(bag)))
    if all(flight is None for _, flight, _ in rows):
        say("none of them can be read", error=True)
        return 2
    return 0


def as_data(flight: RecordedMission, facts: list[TopicFacts], events: list[Event]) -> dict[str, Any]:
    """Return the content of the tables as plain data; unknown values are null."""
    bag: Bag = flight.bag
    first, last = bag.span_ns
    summary, own = flight.summary, flight.by_odometry
    return {
        "path": str(bag.path),
        "namespace": bag.vehicle,
        "files": [file.name for file in bag.files],
        "bytes": bag.size,
        "start_s": first * 1e-9,
        "duration_s": (last - first) * 1e-9,
        "messages": bag.count,
        "notes": [*bag.notes, *flight.notes],
        "topics": [dataclasses.asdict(fact) for fact in facts],
        "mission": json.loads(summary.to_json()) if summary is not None else None,
        "missions": [_mission(part) for part in flight.missions],
        "by_odometry": {"rms_distance": own.rms, "largest_distance": own.largest} if own else None,
        "events": [dataclasses.asdict(event) for event in events],
    }


def _mission(part: RecordedMission) -> dict[str, Any]:
    """Return one of the missions as plain data."""
    summary = part.summary
    return {
        "name": part.mission.name if part.mission is not None else None,
        "began_at": part.place,
        "state": part.ended[0],
        "reason": part.ended[1],
        "figures": json.loads(summary.to_json()) if summary is not None else None,
    }
