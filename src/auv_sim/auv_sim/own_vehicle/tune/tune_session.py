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
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, to_type
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.tune import tuned_file, tuned_picture
from auv_sim.own_vehicle.tune.ensemble import Factors, check_simulated, ensemble, planar, spread_of_file
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace, ratios_at
from auv_sim.own_vehicle.tune.gain_verdict import GainVerdict, Held, judge
from auv_sim.own_vehicle.tune.sampled_loop import LARGEST_FACTOR, Margins
from auv_sim.own_vehicle.tune.search import Budget, Problem, search
from auv_sim.own_vehicle.tune.trial_flights import Amount, Conditions, draw_flights, with_laws
from auv_sim.own_vehicle.verbs.gain_options import FROM_FILE
from auv_sim.sim_parameters import SUITE
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, headed_table, progress_bar, wrote
from auv_sim.vehicle import sea

#: Parameter file for everything that is not tuned.
BASE = "robust"
#: Odometry rates of the flights on lines besides the vehicle's own, 1/s.
RATES = (10.0, 20.0, 50.0)
#: Stream of the draw of the picture's course.
_PICTURE = 3


def run(options: argparse.Namespace) -> int:
    """Tune; return the exit code: 0 also where the rule's gains stay.

    Raises:
        ConfigurationError: vehicle, sea or --out do not fit.
    """
    check_compiled("tune")
    console = terminal(options.quiet)
    own = vehicle.load(options.vehicle)
    check_simulated(own)
    picture = options.out.with_suffix(".png")
    if options.out.suffix.lower() == ".png":
        raise ConfigurationError("--out", f"{options.out}", "a parameter file; the picture stands beside it")
    inputs = [config_files.find("vehicles", options.vehicle)]
    check_outputs((options.out, picture), inputs, options.overwrite)
    base = params_file.load(config_files.find("params", BASE), SUITE)
    problem = problem_of(options, own, base)
    _explain(console, problem)
    budget = Budget(options.generations, threads=options.threads)
    with progress_bar(console, disable=options.quiet) as bar:
        task = bar.add_task("search", total=budget.generations)
        found = search(problem, budget, lambda _: bar.advance(task))
        task = bar.add_task("held-out flights", total=1)
        verdict = judge(problem, found, budget.threads)
        bar.advance(task)
    _report(console, verdict)
    gains = problem.space.gains(verdict.point) if verdict.accepted else problem.space.rule()
    comments = comments_of(options, own, problem, verdict)
    written = tuned_file.write(options.out, gains, base, comments)
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
    return Problem(space, hulls, conditions, options.seed)


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


def _explain(console: Console, problem: Problem) -> None:
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
    console.print(
        f"crossover by the rule {heading.crossover:.2f} 1/s, p τ {heading.product:.2f}; {len(problem.hulls)} "
        "hulls, the worst counts\n"
        "objective: distance and rudder travel against the rule, no limit cycle, margins (docs/tuning.md)"
    )


def _report(console: Console, verdict: GainVerdict) -> None:
    for reason in verdict.why:
        console.print(f"not accepted: {reason}", markup=False)
    table = headed_table(
        "Held-out flights of the gains found, against the rule's", ("hull",),
        ("flights", "distance", "off corners", "rudder travel", "late yaw rate °/s", "the rule's"),
    )  # fmt: skip
    for k, held in enumerate(verdict.held):
        table.add_row("the vehicle" if k == 0 else f"drawn {k}", *_cells(held))
    console.print(table)
    if verdict.accepted:
        share = "" if verdict.share == 1.0 else f" ({100 * verdict.share:.0f} % of the way from the rule)"
        console.print(f"accepted{share}; margins {words_of(verdict.margins)}")
    else:
        console.print(f"the rule's gains stay; margins {words_of(verdict.margins)}")


def _cells(held: Held) -> list[str]:
    return [
        str(held.flights), *(f"× {ratio:.2f}" for ratio in held.ratios),
        f"{held.unrest:.2f}", f"{held.ruled_unrest:.2f}",
    ]  # fmt: skip


def words_of(margins: Margins) -> str:
    """Return margins in words."""
    if not margins.is_stable:
        return "none: the linear loop is unstable"
    down = "any factor" if margins.down >= LARGEST_FACTOR * 0.99 else f"a factor of {margins.down:.1f}"
    return (
        f"of gain a factor of {margins.up:.1f} up and {down} down, of delay {1e3 * margins.delay:.0f} ms more"
    )


def comments_of(
    options: argparse.Namespace, own: Vehicle, problem: Problem, verdict: GainVerdict
) -> list[str]:  # fmt: skip
    """Return the paragraphs at the head of the file: the command, the margins, the held-out flights."""
    words = {
        "--delay": options.delay, "--rate": options.rate, "--slowest": options.slowest, "--sea": options.sea,
        "--spread": options.spread, "--members": options.members, "--generations": options.generations,
        "--seed": options.seed,
    }  # fmt: skip
    flags = [part for name, value in words.items() for part in (name, f"{value}")]
    kind = (
        "found by a search"
        if verdict.accepted
        else "by the rule of docs/tuning.md, the search found none better"
    )
    comments = [
        f"Gains for {own.name}, {kind}:",
        " " + to_type("vehicle.py", "tune", options.vehicle, *flags),
        f"Delay {1e3 * (options.delay + own.rudder.dead_time):.0f} ms, of which the fin's dead time "
        f"{1e3 * own.rudder.dead_time:.0f} ms. Margins {words_of(verdict.margins)}.",
    ]
    # Those of gains that are not in the file would be read as the file's.
    for k, held in enumerate(verdict.held if verdict.accepted else ()):
        distance, off, travel = held.ratios
        name = "the vehicle" if k == 0 else f"drawn hull {k}"
        comments.append(
            f"Held out, {name}, {held.flights} flights against the rule: distance {distance:.2f} times, off "
            f"corners {off:.2f}, rudder travel {travel:.2f}; late yaw rate on lines at most "
            f"{held.unrest:.2f} deg/s."
        )
    comments += [f"Not accepted: {reason}." for reason in verdict.why]
    ratios = ", ".join(f"{name} {value:.3g}" for name, value in ratios_at(verdict.point).items())
    pitch = "Pitch gains by the rule." if own.dives else ""
    return [*comments, f"Ratios: {ratios}. {pitch}".strip()]


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
    gains = [("rule", space.rule())] + ([("tuned", written)] if verdict.accepted else [])
    flights = [(label, with_laws(flight, flown, space.vehicle)) for label, flown in gains]
    state = "tuned" if verdict.accepted else "the rule's gains stay"
    speed = np.hypot(*flight.scenario.current[:2])
    title = f"{own.name}: {state}. A held-out course in {speed:.2f} m/s of current"
    tuned_picture.draw(picture, title, flight.scenario.path, flights, history)
