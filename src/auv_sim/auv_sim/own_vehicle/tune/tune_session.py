"""What `scripts/vehicle.py tune` does: search, judge by held-out flights, write file and picture, report."""

from __future__ import annotations

import argparse
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
from auv_sim.command_line import EXIT_DONE, to_type
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.tune import tuned_file, tuned_picture
from auv_sim.own_vehicle.tune.ensemble import Factors, check_simulated, ensemble, planar, spread_of_file
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace
from auv_sim.own_vehicle.tune.gain_verdict import FOUND, PRESENT, RULE, GainVerdict, judge
from auv_sim.own_vehicle.tune.search import Budget, Problem, search
from auv_sim.own_vehicle.tune.trial_flights import Amount, Conditions, draw_flights, with_laws
from auv_sim.own_vehicle.tune.verdict_words import comments_of, report
from auv_sim.own_vehicle.verbs.gain_options import FROM_FILE
from auv_sim.sim_parameters import SUITE
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, progress_bar, wrote
from auv_sim.vehicle import sea

#: Parameter file for everything that is not tuned, and the present gains of a vehicle that names none.
BASE = "robust"
#: Hulls where the vehicle file states an uncertainty; generations of a search for one hull, and for several.
MEMBERS, GENERATIONS, SHARED_GENERATIONS = 5, 80, 50
#: Odometry rates of the flights on lines besides the vehicle's own, 1/s.
RATES = (10.0, 20.0, 50.0)
#: Stream of the draw of the picture's course.
_PICTURE = 3
#: Of each source of gains: label of its track, state in the picture's title.
_STATES = {
    FOUND: ("tuned", "tuned"),
    PRESENT: ("present", "the present gains stay"),
    RULE: ("", "the rule's gains stay"),
}


def run(options: argparse.Namespace) -> int:
    """Tune; return the exit code: 0 also where the rule's gains stay.

    Raises:
        ConfigurationError: vehicle, sea or --out do not fit.
    """
    check_compiled("tune")
    options, console = settled(options), terminal(options.quiet)
    own = vehicle.load(options.vehicle)
    check_simulated(own)
    picture = options.out.with_suffix(".png")
    if options.out.suffix.lower() == ".png":
        raise ConfigurationError("--out", f"{options.out}", "a parameter file; the picture stands beside it")
    inputs = [config_files.find("vehicles", options.vehicle)]
    check_outputs((options.out, picture), inputs, options.overwrite)
    base = params_file.load(config_files.find("params", BASE), SUITE)
    name, present = present_of(own)
    problem = problem_of(options, own, base)
    _explain(console, problem, name)
    budget = Budget(options.generations, threads=options.threads)
    with progress_bar(console, disable=options.quiet) as bar:
        task = bar.add_task("search", total=budget.generations)
        found = search(problem, budget, lambda _: bar.advance(task))
        task = bar.add_task("held-out flights", total=1)
        verdict = judge(problem, found, budget.threads)
        bar.advance(task)
    report(console, verdict, name)
    comments = comments_of(options, own, problem, verdict, name)
    others = present if verdict.source == PRESENT and present is not None else base
    written = tuned_file.write(options.out, verdict.gains, others, comments)
    _draw(picture, own, problem, written, verdict, found.history)
    wrote(console, options.out, "gains: `mission.py --params` flies them")
    wrote(console, picture, "a held-out course, before and after")
    rest = ["--delay", f"{options.delay:g}"] if options.delay else []
    rest += ["--spread", str(options.spread)] if options.spread else []
    rest += ["--overwrite"] if Path("proof/proof.html").exists() else []
    line = to_type(
        "vehicle.py", "prove", options.vehicle, "--params", str(options.out), "--sea", options.sea, *rest
    )
    go_on(console, "Prove them", line)
    return EXIT_DONE


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
        console.print(f"notice {notice}", markup=False)
    others = "the rule" if problem.present is None else f"the rule and {present}"
    console.print(
        f"crossover by the rule {heading.crossover:.2f} 1/s, p τ {heading.product:.2f}; {len(problem.hulls)} "
        "hulls, the worst counts\n"
        f"objective: distance and rudder travel against {others}, no limit cycle, margins (docs/tuning.md)"
    )


def _draw(
    picture: Path,
    own: Vehicle,
    problem: Problem,
    written: GainSet,
    verdict: GainVerdict,
    history: tuple[float, ...],
) -> None:
    space = problem.space
    one = Amount(starts=0, courses=1, legs=5, at_sea=0)
    random = np.random.default_rng([problem.seed, _PICTURE])
    # The second: sharp corners in a current.
    flight = draw_flights(space.vehicle, problem.conditions, one, random)[1]
    label, state = _STATES[verdict.source]
    gains = [("rule", space.rule())] + ([(label, written)] if label else [])
    flights = [(name, with_laws(flight, flown, space.vehicle)) for name, flown in gains]
    speed = np.hypot(*flight.scenario.current[:2])
    title = f"{own.name}: {state}. A held-out course in {speed:.2f} m/s of current"
    tuned_picture.draw(picture, title, flight.scenario.path, flights, history)
