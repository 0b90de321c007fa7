"""What `scripts/vehicle.py prove` does: fly the campaign, write page and summary, say what holds."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.progress import Progress, TaskID

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, make_directory
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.prove.law_comparison import compare
from auv_sim.own_vehicle.prove.one_flight import draw_flight, flight_words
from auv_sim.own_vehicle.prove.proof import Proposition, draw_claim, fly_proof
from auv_sim.own_vehicle.prove.proof_report import Outputs, Result, conclude
from auv_sim.own_vehicle.prove.provenance import gains_name
from auv_sim.own_vehicle.tune import tuned_file
from auv_sim.own_vehicle.tune.ensemble import check_simulated, planar
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace
from auv_sim.own_vehicle.tune.search import Budget
from auv_sim.own_vehicle.tune.trial_flights import Conditions
from auv_sim.own_vehicle.tune.tune_session import BASE, check_compiled, spread_of, steps_of
from auv_sim.sim_parameters import SUITE
from auv_sim.terminal import console as terminal
from auv_sim.terminal import progress_bar, wrote
from auv_sim.vehicle import sea


def run(options: argparse.Namespace) -> int:
    """Prove; return the exit code: 0 proven, 1 not.

    Raises:
        ConfigurationError: vehicle, gains, seas, --refly or --out do not fit.
    """
    check_compiled("prove")
    console = terminal(options.quiet)
    own = vehicle.load(options.vehicle)
    check_simulated(own)
    claim = claim_of(options, own)
    gains, label = _gains_of(options, own)
    if options.refly is not None:
        return _refly(console, options, claim, label, gains)
    outputs = _outputs(options)
    make_directory(options.out)
    inputs = [config_files.find("vehicles", options.vehicle)]
    check_outputs(outputs, inputs, options.overwrite)
    flights = draw_claim(claim)
    with progress_bar(console, disable=options.quiet) as bar:
        begin = partial(_begin, bar)
        advance = begin(f"flights: {label}", len(flights))
        proof = fly_proof(claim, flights, gains, options.workers, advance)
        laws = None
        if options.laws:
            base = params_file.load(config_files.find("params", BASE), SUITE)[topics.GUIDANCE].guidance
            budget = Budget(options.generations, threads=options.workers)
            laws = compare(claim, (label, gains), proof, base, budget, begin)
    return conclude(console, options, own, outputs, Result(claim, label, gains, proof, laws, flights))


def claim_of(options: argparse.Namespace, own: Vehicle) -> Proposition:
    """Return what is to be proven.

    Raises:
        ConfigurationError: a sea does not exist or is named twice, or the file states no uncertainty.
    """
    seas = tuple(map(sea.load, options.sea))
    names = [one.name for one in seas]
    for name in names:
        if names.count(name) > 1:
            raise ConfigurationError("--sea", f"{name} twice", "seas of different names")
    steps = steps_of(options.rate, options.slowest)
    conditions = Conditions(options.delay, 1.0 / options.rate, steps, seas[0])
    flown = planar(own) if options.in_plane else own
    limits = options.within, options.within_depth if flown.dives else math.inf
    is_part = own.dives and not flown.dives
    spread = spread_of(options)
    return Proposition(flown, conditions, seas, *spread, options.flights, *limits, options.seed, is_part)


def _outputs(options: argparse.Namespace) -> Outputs:
    names = "proof.html", "proof.png", "worst_flight.png", "summary.json"
    return Outputs(*(options.out / name for name in names))


def _gains_of(options: argparse.Namespace, own: Vehicle) -> tuple[GainSet, str]:
    name = gains_name(options, own)
    if name == "rule":
        base = params_file.load(config_files.find("params", BASE), SUITE)
        space = GainSpace(own, base[topics.GUIDANCE].guidance, options.delay, 1.0 / options.rate)
        return space.rule(), "rule"
    return tuned_file.read(config_files.find("params", name)), Path(name).stem


def _begin(bar: Progress, task: str, total: int) -> Callable[[float], None]:
    return partial(_advance, bar, bar.add_task(task, total=total))


def _advance(bar: Progress, task: TaskID, _: float) -> None:
    bar.advance(task)


def _refly(
    console: Console, options: argparse.Namespace, claim: Proposition, label: str, gains: GainSet
) -> int:
    flights = draw_claim(claim)
    if options.refly >= len(flights):
        raise ConfigurationError("--refly", f"{options.refly}", f"a flight from 0 to {len(flights) - 1}")
    target = options.out / f"flight_{options.refly}.png"
    make_directory(options.out)
    check_outputs([target], [config_files.find("vehicles", options.vehicle)], options.overwrite)
    draw_flight(target, claim, label, gains, flights, options.refly)
    wrote(console, target, flight_words(claim, flights, options.refly))
    return EXIT_DONE
