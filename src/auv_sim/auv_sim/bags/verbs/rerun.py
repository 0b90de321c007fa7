"""Feed the recorded sensors through observer, guidance and autopilot again, as fast as possible and
without a plant, and compare the commands with the recorded ones. Parameters and missions that were set in
flight are set again. A lockstep recording gives the same bits; other gains show what they would have
commanded in the same situation. The recorded vehicle does not follow the new commands, so a law that
integrates (NISM) drifts away from them.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.missions import mission_file
from auv_sim.bags.content.flown_settings import dotted
from auv_sim.bags.content.parameter_changes import PARAMETER_EVENTS, changes_in, chosen
from auv_sim.bags.content.recorded_mission import MISSION, PARAMS, configuration, controller_model
from auv_sim.bags.content.rerun_pilot import Answers, answers
from auv_sim.bags.content.vehicle_parts import read_vehicles
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.load import is_used
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.showing.rerun_table import compared, is_same, show, write_csv
from auv_sim.bags.verbs.arguments import add_choice
from auv_sim.command_line import say, target
from auv_sim.sim_parameters import SUITE

_FURTHER = {topics.MISSION_STATE.name, topics.DESIRED_THRUST.name, topics.ALTITUDE.name, PARAMETER_EVENTS}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument("bag", type=Path, metavar="BAG", help="recording or run directory")
    parser.add_argument("--params", metavar="FILE", help="parameters to try; all others stay as flown")
    parser.add_argument("--mission", metavar="FILE", help="mission to use in place of the recorded one")
    parser.add_argument("--vehicle", metavar="FILE", help="vehicle file to use in place of the recorded one")
    add_choice(parser)
    parser.add_argument("--png", type=target, metavar="FILE", help="draw recorded and new commands")
    parser.add_argument("--csv", type=target, metavar="FILE", help="write recorded and new commands")
    parser.add_argument("--json", action="store_true", help="print JSON, for programs")


def run(arguments: argparse.Namespace) -> int:
    """Return 0 if all commands are bit-identical, else 1; with --params, --mission or --vehicle always 0."""
    bags = read_vehicles(arguments.bag, _is_needed, arguments.odometry, arguments.namespace)
    if len(bags) > 1 and (arguments.csv or arguments.png or arguments.json):
        found = f"{len(bags)} vehicles and --csv, --png or --json"
        raise ConfigurationError(str(arguments.bag), found, "--namespace with one of them")
    codes = []
    for label, bag in bags.items():
        if len(bags) > 1:
            say(f"{label}:")
        codes.append(_run_one(bag, arguments))
    return max(codes)


def _run_one(bag: Bag, arguments: argparse.Namespace) -> int:
    """Rerun one vehicle's recording; return the exit code."""
    found = rerun(
        bag, arguments.params, arguments.mission, arguments.vehicle, arguments.namespace,
        arguments.odometry,
    )  # fmt: skip
    if not np.isfinite(found.recorded[topics.RUDDER_CMD.name]).any():
        raise ConfigurationError(str(arguments.bag), "no commands", f"messages on {topics.RUDDER_CMD.name}")
    figures = {name: compared(found, name) for name in found.new}
    if arguments.csv:
        write_csv(found, arguments.csv)
    if arguments.png:
        from auv_sim.bags.showing.rerun_picture import draw

        draw(found, arguments.png)
    if arguments.json:
        print(json.dumps({"steps": int(found.t.size), "topics": figures}, indent=2, allow_nan=False))
    else:
        show(found, figures)
    changed = arguments.params or arguments.mission or arguments.vehicle
    return 0 if changed or is_same(figures) else 1


def rerun(
    path: Path | Bag,
    params: str | None = None,
    mission: str | None = None,
    hull: str | None = None,
    namespace: str | None = None,
    odometry: str | None = None,
) -> Answers:
    """Return what the pilot would have commanded.

    Args:
        path: the recording, or what was read of it; its configuration is in it or beside it.
        params, mission, hull: files that replace the recorded configuration.
        namespace: of the vehicle.
        odometry: the topic, where its name differs from the contract's.

    Raises:
        ConfigurationError: a file cannot be used, or the recording lacks something.
    """
    bag = path if isinstance(path, Bag) else read_bag(path, _is_needed, odometry)
    with configuration(bag) as directory:
        parameters = _parameters(directory / PARAMS, params)
        known = vehicle.load(str(_file(bag, "vehicles", controller_model(directory), hull)))
        flown = mission_file.load(str(_file(bag, "missions", directory / MISSION, mission)), known)
        changes = chosen(changes_in(bag, namespace), gains=params is None, mission=mission is None)
        return answers(bag, parameters, flown, known, namespace, changes)


def _file(bag: Bag, kind: config_files.Kind, recorded: Path, given: str | None) -> Path:
    """Return the file that was given, or the recorded one.

    Raises:
        ConfigurationError: there is neither.
    """
    if given is not None:
        return config_files.find(kind, given)
    if not recorded.exists():
        found = f"no {recorded.name} in or beside the recording"
        raise ConfigurationError(str(bag.path), found, f"--{kind[:-1]} FILE")
    return recorded


def _is_needed(name: str, type_name: str) -> bool:
    return is_used(name, type_name) or name.rsplit("/", 1)[-1] in _FURTHER


def _parameters(recorded: Path, new: str | None) -> dict[str, Any]:
    """Return the recorded parameters, overridden by those of a file."""
    if new is None:
        return (
            params_file.load(recorded, SUITE)
            if recorded.exists()
            else {name: cls() for name, cls in SUITE.items()}
        )
    file = config_files.find("params", new)
    changes = params_file.load(file, SUITE)
    if not recorded.exists():
        return changes
    with tempfile.TemporaryDirectory(prefix="auv-rerun-") as name:
        merged = Path(name) / PARAMS
        content = _flat(recorded)
        for node, values in _flat(file).items():
            content.setdefault(node, {}).update(values)
        body = {f"/**/{node}": {"ros__parameters": values} for node, values in content.items()}
        yaml_file.dump(body, merged)
        return params_file.load(merged, SUITE)


def _flat(path: Path) -> dict[str, dict[str, Any]]:
    """Return node name -> dotted name -> value."""
    flat: dict[str, dict[str, Any]] = {}
    for pattern, body in yaml_file.parse(path).items():
        flat.setdefault(str(pattern).rsplit("/", 1)[-1], {}).update(dotted(body["ros__parameters"]))
    return flat
