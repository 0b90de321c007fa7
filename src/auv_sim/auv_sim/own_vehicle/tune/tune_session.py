"""What `scripts/vehicle.py tune` does: search, judge by held-out flights, write file and picture, report."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files, vehicle
from auv_path_following.control import autopilot
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, say, to_type
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.tune import tuned_file
from auv_sim.own_vehicle.tune.ensemble import (
    Factors,
    check_delay,
    check_simulated,
    ensemble,
    planar,
    spread_of_file,
)
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace
from auv_sim.own_vehicle.tune.gain_verdict import PRESENT, GainVerdict, judge
from auv_sim.own_vehicle.tune.outcome.tuned_picture import draw_verdict
from auv_sim.own_vehicle.tune.outcome.verdict_words import comments_of, planes_comments_of, report
from auv_sim.own_vehicle.tune.pitch.pitch_plane_tuning import (
    HELD_OUT_DIVES,
    PITCH,
    SEARCHED_DIVES,
    PitchSpace,
    can_be_tuned,
)
from auv_sim.own_vehicle.tune.search import Budget, Found, search
from auv_sim.own_vehicle.tune.trial_flights import HELD_OUT, LATER, Amount, Conditions
from auv_sim.own_vehicle.tune.tuning_problem import Problem
from auv_sim.own_vehicle.verbs.gain_options import CONDITIONS, FROM_FILE, changed
from auv_sim.sim_parameters import SUITE
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, progress_bar, wrote
from auv_sim.vehicle import sea

#: Parameter file for everything that is not tuned, and the present gains of a vehicle that names none.
BASE = "robust"
#: Hulls where the vehicle file states an uncertainty; generations of a search for one hull, and for several.
MEMBERS, GENERATIONS, SHARED_GENERATIONS = 5, 80, 50
#: Generations of the search for the stern planes over those for the rudder, and candidates of each.
DIVES, POPULATION_OF_DIVES = 0.4, 10
#: Odometry rates of the flights on lines besides the vehicle's own, 1/s.
RATES = (10.0, 20.0, 50.0)


def run(options: argparse.Namespace) -> int:
    """Tune; return the exit code: 0 also where the rule's gains stay.

    Raises:
        ConfigurationError: vehicle, sea or --out do not fit.
    """
    check_compiled("tune")
    own = vehicle.load(options.vehicle)
    check_simulated(own)
    options, console = settled(options), terminal(options.quiet)
    picture = options.out.with_suffix(".png")
    if options.out.suffix.lower() == ".png":
        raise ConfigurationError("--out", f"{options.out}", "a parameter file; the picture stands beside it")
    inputs = [config_files.find("vehicles", options.vehicle)]
    check_outputs((options.out, picture), inputs, options.overwrite)
    base = params_file.load(config_files.find("params", BASE), SUITE)
    name, present = present_of(own)
    problem = problem_of(options, own, base)
    _explain(console, problem, name)
    budget = Budget(options.generations, threads=options.workers)
    found, verdict = _tuned(console, problem, budget, options.quiet, "rudder")
    report(console, verdict, name, "the rudder")
    gains, comments = verdict.gains, comments_of(options, own, problem, verdict, name)
    if own.dives:
        gains, words = _tuned_planes(console, options, own, problem, gains, name)
        comments += words
    others = present if verdict.source == PRESENT and present is not None else base
    written = tuned_file.write(options.out, gains, others, comments)
    draw_verdict(picture, own, problem, written, verdict, found.history)
    wrote(console, options.out, "gains: `mission.py --params` flies them")
    wrote(console, picture, "a held-out course, before and after")
    rest = ["--params", str(options.out), "--sea", options.sea, *conditions_again(options)]
    rest += ["--overwrite"] if Path("proof/proof.html").exists() else []
    go_on(console, "Prove them", to_type("vehicle.py", "prove", options.vehicle, *rest))
    return EXIT_DONE


def _tuned(
    console: Console, problem: Problem, budget: Budget, quiet: bool, name: str, amount: Amount = HELD_OUT
) -> tuple[Found, GainVerdict]:
    """Search and judge, with a progress bar."""
    with progress_bar(console, disable=quiet) as bar:
        task = bar.add_task(f"{name}: search", total=budget.generations)
        found = search(problem, budget, lambda _: bar.advance(task))
        task = bar.add_task(f"{name}: held-out flights", total=1)
        verdict = judge(problem, found, budget.threads, amount)
        bar.advance(task)
    return found, verdict


def _tuned_planes(
    console: Console,
    options: argparse.Namespace,
    own: Vehicle,
    heading: Problem,
    gains: GainSet,
    present: str,
) -> tuple[GainSet, list[str]]:
    """Tune the stern planes beside gains of the heading; return all gains, and paragraphs for the file."""
    if not can_be_tuned(own):
        why = "depth.max or the speed is too small to tune the stern planes"
        say(f"notice {own.name}: {why}", error=True)
        return gains, [f"Pitch gains by the rule: {why}."]
    problem = pitch_problem(own, heading, gains)
    budget = Budget(math.ceil(DIVES * options.generations), POPULATION_OF_DIVES, options.workers)
    _, verdict = _tuned(console, problem, budget, options.quiet, "stern planes", HELD_OUT_DIVES)
    report(console, verdict, present, "the planes; distances are errors of depth")
    return verdict.gains, planes_comments_of(verdict, present)


def pitch_problem(own: Vehicle, heading: Problem, gains: GainSet) -> Problem:
    """Return what is tuned in the vertical plane.

    Args:
        own: the diving vehicle.
        heading: what was tuned in the horizontal plane.
        gains: of the heading.
    """
    c = heading.conditions
    space = PitchSpace(own, gains, c.delay, c.step)
    present = None if heading.present is None else space.with_planes_of(heading.present)
    return Problem(space, [own], c, heading.seed, present, PITCH, SEARCHED_DIVES)


def conditions_again(options: argparse.Namespace) -> list[str]:
    """Return the options of delay, rates and uncertainty as typed, where they are not the usual ones."""
    given = changed(options, CONDITIONS)
    return [word for name, value in given.items() for word in (f"--{name}", f"{value}")]


def check_compiled(verb: str) -> None:
    """Check that flights are compiled: without, a search takes hours.

    Raises:
        ConfigurationError: Numba is not installed.
    """
    if not COMPILED:
        raise ConfigurationError(verb, "no Numba", "pip install -r requirements/vehicle.txt")


def problem_of(options: argparse.Namespace, own: Vehicle, base: dict[str, Any]) -> Problem:
    """Return what is tuned.

    Raises:
        ConfigurationError: the vehicle or the sea does not fit.
    """
    step = 1.0 / options.rate
    flown = planar(own)
    guidance = base[topics.GUIDANCE].guidance
    space = GainSpace(flown, guidance, options.delay, step, whole=own if own.dives else None)
    random = np.random.default_rng([options.seed, 2])
    spread, own_widths = spread_of(options)
    hulls = ensemble(flown, options.members, spread, random, own_widths)
    check_delay([own, *hulls], options.delay, LATER)
    steps = steps_of(options.rate, options.slowest)
    conditions = Conditions(options.delay, step, steps, sea.load(options.sea))
    _, settings = present_of(own)
    present = None if settings is None else tuned_file.flown_of(settings)
    return Problem(space, hulls, conditions, options.seed, present)


def settled(options: argparse.Namespace) -> argparse.Namespace:
    """Return options with the defaults that follow from the vehicle file and from each other."""
    chosen = argparse.Namespace(**vars(options))
    if chosen.spread is None:
        stated = spread_of_file(config_files.find("vehicles", chosen.vehicle))
        chosen.spread = FROM_FILE if stated else 0.0
    if chosen.members is None:
        chosen.members = MEMBERS if chosen.spread else 1
    if chosen.generations is None:
        chosen.generations = SHARED_GENERATIONS if chosen.members > 1 else GENERATIONS
    return chosen


def present_of(own: Vehicle) -> tuple[str, dict[str, Any] | None]:
    """Return the name of the gains that a vehicle has, those of `BASE` without, and all nodes' settings.

    The settings are None where the gains need values that the vehicle's file does not have.
    """
    name = own.params if own.params not in (None, "rule") else BASE
    settings = params_file.load(config_files.find("params", str(name)), SUITE)
    try:
        autopilot.prepare(settings[topics.AUTOPILOT].autopilot, own)
    except ConfigurationError:
        return str(name), None
    return str(name), settings


def steps_of(rate: float, slowest: float) -> tuple[float, ...]:
    """Return the times between two odometries of flights on lines, s: of `RATES` and `rate`, none slower."""
    steps = tuple(sorted({1.0 / other for other in (*RATES, rate) if other >= slowest}))
    return steps or (1.0 / rate,)


def spread_of(options: argparse.Namespace) -> tuple[float, dict[str, Factors]]:
    """Return the uncertainty as a share, and the factors of single numbers.

    Raises:
        ConfigurationError: the vehicle file states none.
    """
    if options.spread != FROM_FILE:
        return 0.01 * options.spread, {}
    file = config_files.find("vehicles", options.vehicle)
    widths = spread_of_file(file)
    if not widths:
        found = "no number with its uncertainty as a comment"
        raise ConfigurationError(f"{file}: --spread file", found, "such comments, or --spread PERCENT")
    return 0.0, widths


def _explain(console: Console, problem: Problem, present: str) -> None:
    space, f = problem.space, problem.space.response
    heading, conditions = space.ruled.heading, problem.conditions
    rates = ", ".join(f"{1.0 / step:g}" for step in reversed(conditions.steps))
    late = 1e3 * (conditions.delay + space.vehicle.rudder.dead_time)
    console.print(
        f"{space.vehicle.name}: b {f.effect:.2f} 1/s², p {f.divergence:.2f} 1/s, turn {f.turn:.2f} rad/s, "
        f"delay {late:.0f} ms, {rates} odometries a second"
    )
    for notice in space.ruled.notices:
        say(f"notice {notice}", error=True)
    others = "the rule" if problem.present is None else f"the rule and {present}"
    hulls = f"{len(problem.hulls)} hulls, the worst counts" if len(problem.hulls) > 1 else "one hull"
    console.print(
        f"crossover by the rule {heading.crossover:.2f} 1/s, p τ {heading.product:.2f}; {hulls}\n"
        f"objective: distance and rudder travel against {others}, no limit cycle, margins (docs/tuning.md)"
    )
