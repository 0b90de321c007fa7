"""Identify a vehicle from recordings of manoeuvres: coefficients, rudder, current, each with an interval.

The manoeuvres are zig-zags, circles and thrust steps; two minutes are enough to tune by, eight show most of
the coefficients. Needed are the odometry's yaw rate, the velocity through the water, and the commands of
rudder and thrust. With commands of stern planes heave and pitch are identified too. Writes a vehicle file
that flies, and a picture.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.command_line import add_overwrite, add_quiet, not_negative, positive, say, target, to_type
from auv_sim.own_vehicle.identify.combinations import COUNT, combinations_of
from auv_sim.own_vehicle.identify.dive.dive_combinations import DiveCombinations
from auv_sim.own_vehicle.identify.hull_abilities import abilities_of
from auv_sim.own_vehicle.identify.identification import Identified, identify
from auv_sim.own_vehicle.identify.innovations import Channels, channels_of
from auv_sim.own_vehicle.identify.predictions import Prediction, predictions_of
from auv_sim.own_vehicle.identify.results.excitation import check_excitation, remarks
from auv_sim.own_vehicle.identify.results.identification_picture import draw_identification
from auv_sim.own_vehicle.identify.results.identification_tables import (
    coefficients_table,
    figures_table,
    identified_line,
    predictions_table,
    whiteness_table,
)
from auv_sim.own_vehicle.identify.results.identified_file import identified_text
from auv_sim.own_vehicle.identify.results.known_vehicle import (
    identified_vehicle,
    in_plane,
    known_hull,
)
from auv_sim.own_vehicle.identify.results.plausibility import (
    check_fit,
    check_motion,
    doubts,
    latency_doubts,
    thrust_doubts,
)
from auv_sim.own_vehicle.identify.results.rudder_plausibility import share_doubts
from auv_sim.own_vehicle.identify.time_grid import FOLLOWED, PlanarData, shared_time
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, RATE, DataSheet, typed
from auv_sim.own_vehicle.identify.water_current import mean_current
from auv_sim.own_vehicle.verbs.dive_report import IdentifiedDive, identified_dive, print_dive
from auv_sim.own_vehicle.verbs.identification_study import add_study_arguments, study
from auv_sim.own_vehicle.verbs.identify_checks import check_effect, check_options, check_target
from auv_sim.own_vehicle.verbs.left_out import ENOUGH, LAST, divided
from auv_sim.own_vehicle.verbs.reading.recordings_read import Recorded, add_reading_arguments, read
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, progress_bar, steps_in, wrote

#: Latency of the log where it is found from the data: mean and deviation before them, s.
_LATENCY = (0.1, 0.08)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's options."""
    parser.add_argument("bag", type=Path, nargs="*", metavar="BAG", help="recordings of one vehicle")
    shipped = ", ".join(config_files.shipped("vehicles"))
    parser.add_argument(
        "--vehicle", default="remus100", metavar="FILE",
        help=f"what is known: limits, length, masses; file or one of: {shipped} (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--out", type=target, metavar="FILE", default=Path("identified.yaml"),
        help="vehicle file to write, and a picture beside it; of a study FILE.json (default: %(default)s)",
    )  # fmt: skip
    add_overwrite(parser)
    parser.add_argument(
        "--log-latency", type=not_negative, metavar="S",
        help="age of a velocity through the water at its stamp (default: found from the data)",
    )  # fmt: skip
    parser.add_argument(
        "--dead-band", type=not_negative, metavar="DEG",
        help="dead band of the rudder's servo (default: the one of 0 to 0.5 deg that fits best)",
    )  # fmt: skip
    parser.add_argument(
        "--left-out", nargs=2, type=not_negative, metavar=("BEGIN", "END"),
        help="part of the last recording to leave out and predict, s from its begin; 0 0: none "
        f"(default: the last {LAST:g} s that turn enough, where there are {ENOUGH:g} s in all)",
    )  # fmt: skip
    _add_sheet(parser)
    add_study_arguments(parser)
    add_reading_arguments(parser)
    add_quiet(parser)


def _add_sheet(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--log-scale", type=not_negative, default=0.7, metavar="PERCENT",
        help="error of the log's scale by its data sheet, which no data show (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--thrust-bias", type=not_negative, default=2.0, metavar="PERCENT",
        help="error of the thrust, which no data show (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--rudder-rate", type=positive, metavar="DEG/S",
        help="rate of the rudder within a factor of two (default: the vehicle file's)",
    )  # fmt: skip


def run(arguments: argparse.Namespace) -> int:
    """Identify, print, write.

    Raises:
        ConfigurationError: no recordings, such as show nothing, or an option without effect.
    """
    check_effect(arguments)
    if arguments.study is not None:
        return study(arguments)
    if not arguments.bag:
        raise ConfigurationError("BAG", "no recording", "at least one, or --study N")
    vehicle = vehicle_file.load(arguments.vehicle)
    inputs = [config_files.find("vehicles", arguments.vehicle), *arguments.bag]
    check_target(arguments.out, inputs, arguments.overwrite)
    check_options(arguments, vehicle)
    hull = known_hull(vehicle)
    recorded = read(arguments, vehicle, hull)
    _report_reading(arguments.bag, recorded)
    recordings = [one.plane for one in recorded]
    where = ", ".join(map(str, arguments.bag))
    check_excitation(recordings, where)
    check_motion(recordings, vehicle, -hull.Xuu, where)
    used, left_out = divided(recordings, arguments.left_out)
    if left_out is not None:
        check_excitation(used, where if arguments.left_out is None else "--left-out")
    for remark in remarks(used, vehicle):
        say(f"notice {remark}", error=True)
    sheet = _sheet(arguments, vehicle)
    band = None if arguments.dead_band is None else math.radians(arguments.dead_band)
    with progress_bar(terminal(arguments.quiet), arguments.quiet) as bar:
        found = identify(used, hull, sheet, band, steps_in(bar))
    check_sign(found, where)
    check_fit(found, where)
    _report_doubts(arguments, found, used, vehicle, hull)
    dives = [one.dive for one in recorded if one.dive is not None]
    dive = identified_dive(dives, vehicle, hull, found, left_out, arguments.quiet)
    report(arguments, vehicle, recordings, left_out, found, dive)
    return 0


def _report_reading(paths: Sequence[Path], recorded: Sequence[Recorded]) -> None:
    """Print what was converted, and how much of each recording has no commands."""
    for path, one in zip(paths, recorded, strict=True):
        for note in one.notes:
            say(f"notice {path}: {note}", error=True)
        if one.silence > 0.0:
            say(
                f"notice {path}: {one.silence:.0f} s without commands, and {FOLLOWED:g} s after each gap,"
                " are not used: the angles of the fins are not known there",
                error=True,
            )


def _report_doubts(
    arguments: argparse.Namespace, found: Identified, used: list[PlanarData], vehicle: Vehicle, hull: Hull
) -> None:
    """Print the doubts about the result."""
    lines = [*doubts(found, used, vehicle, -hull.Xuu), *latency_doubts(found), *thrust_doubts(found)]
    if not any(text.startswith("rudder_cmd=") for text in arguments.unit):
        lines += share_doubts(found, combinations_of(hull), vehicle.rudder)
    for line in lines:
        say(f"notice {line}", error=True)


def report(
    arguments: argparse.Namespace,
    vehicle: Vehicle,
    recordings: list[PlanarData],
    left_out: PlanarData | None,
    found: Identified,
    dive: IdentifiedDive | None,
) -> None:
    """Print tables; write the vehicle file and the picture."""
    console, hull = terminal(arguments.quiet), known_hull(vehicle)
    abilities = abilities_of(found.physical, found.spread, in_plane(vehicle, hull))
    kept, predictions = _predicted(left_out, found)
    console.print(coefficients_table(found))
    console.print(identified_line(found), highlight=False)
    console.print(figures_table(found, abilities, [mean_current(data) for data in recordings]))
    console.print(whiteness_table(found))
    if predictions:
        console.print(predictions_table(predictions))
    if dive is not None:
        print_dive(console, dive, hull)
    new = identified_vehicle(
        vehicle, hull, typed(found.physical), math.degrees(found.physical[RATE]), found.physical[DEAD_TIME],
        None if dive is None else DiveCombinations(*map(float, dive.found.physical[:COUNT])),
        None if dive is None else dive.planes,
    )  # fmt: skip
    if new.depth != vehicle.depth:
        slowest, known = new.depth.minimum_speed, vehicle.depth.minimum_speed
        say(f"notice depth.minimum_speed: {slowest:g} m/s; below it the identified planes hold no depth, "
            f"{known:g} m/s before", error=True)  # fmt: skip
    names = ", ".join(map(str, arguments.bag))
    write_text(arguments.out, identified_text(new, hull, found, names, dive and dive.found))
    picture = arguments.out.with_suffix(".png")
    draw_identification(found, abilities, kept, predictions, f"{vehicle.name}: {names}", picture)
    wrote(console, arguments.out, "vehicle file, with intervals as comments")
    wrote(console, picture, "intervals, innovations, left-out manoeuvres")
    go_on(console, "Tune gains for it", to_type("vehicle.py", "tune", arguments.out))


def check_sign(found: Identified, where: str) -> None:
    """Check that a positive rudder turns to port.

    Raises:
        ConfigurationError: it turns to starboard.
    """
    if typed(found.physical).Nuud > 0.0:
        raise ConfigurationError(
            f"{where}: rudder_cmd",
            "a positive rudder that turns to starboard",
            "one that turns to port, REP-103: --unit rudder_cmd=-rad (-deg, -percent, -share)",
        )


def _sheet(arguments: argparse.Namespace, vehicle: Vehicle) -> DataSheet:
    latency, deviation = _LATENCY if arguments.log_latency is None else (arguments.log_latency, 0.0)
    return DataSheet()._replace(
        rate=math.radians(arguments.rudder_rate or vehicle.rudder.max_rate_deg_s),
        latency=latency,
        latency_deviation=deviation,
        log_scale=0.01 * arguments.log_scale,
        thrust_bias=0.01 * arguments.thrust_bias,
    )


def _predicted(left_out: PlanarData | None, found: Identified) -> tuple[Channels | None, list[Prediction]]:
    if left_out is None or left_out.water_t.size < 10 or shared_time(left_out) < 1.0:
        return None, []
    channels = channels_of([left_out], found.scaling.sheet, found.dead_band, found.channels.latency)
    channels = channels.with_trims([found.channels.passages[-1].trim])  # a part of the last recording
    channels = channels.with_loads_off(found.channels.loads_off)
    return channels, predictions_of(channels, found.physical)
