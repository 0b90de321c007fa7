"""What `scripts/vehicle.py prove` does: fly the campaign, write page and summary, say what holds."""

from __future__ import annotations

import argparse
import json
import math
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress, TaskID

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.strict_json import without_nan
from auv_path_following import config_files, vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, make_directory, to_type
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.prove import proof_page
from auv_sim.own_vehicle.prove.confidence import flights_needed
from auv_sim.own_vehicle.prove.proof import Proof, Proposition, draw_claim, fly_proof
from auv_sim.own_vehicle.tune import tuned_file
from auv_sim.own_vehicle.tune.ensemble import check_simulated, planar
from auv_sim.own_vehicle.tune.gain_space import LAWS, OWN_LAW, GainSet, GainSpace
from auv_sim.own_vehicle.tune.search import Budget, Problem, search
from auv_sim.own_vehicle.tune.trial_flights import PROVEN_TURN, Conditions
from auv_sim.own_vehicle.tune.tune_session import BASE, check_compiled, spread_of, steps_of
from auv_sim.sim_parameters import SUITE
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, headed_table, progress_bar, wrote
from auv_sim.vehicle import sea


def run(options: argparse.Namespace) -> int:
    """Prove; return the exit code: 0 proven, 1 not."""
    check_compiled("prove")
    console = terminal(options.quiet)
    own = vehicle.load(options.vehicle)
    check_simulated(own)
    make_directory(options.out)
    inputs = [config_files.find("vehicles", options.vehicle)]
    check_outputs(_outputs(options), inputs, options.overwrite)
    flown = planar(own) if options.in_plane else own
    gains, label = _gains_of(options, own)
    spread, widths = spread_of(options)
    conditions = Conditions(
        options.delay, 1.0 / options.rate, steps_of(options.rate, options.slowest), sea.load(options.sea)
    )
    claim = Proposition(flown, conditions, spread, widths, options.flights, options.within, options.seed)
    with progress_bar(console, disable=options.quiet) as bar:
        sets = {label: gains} | (_other_laws(options, claim, bar) if options.laws else {})
        flights = draw_claim(claim)
        proofs = {}
        for name, flown_with in sets.items():
            task = bar.add_task(f"flights: {name}", total=len(flights))
            proofs[name] = fly_proof(
                claim, flights, flown_with, options.threads, partial(_advance, bar, task)
            )
    return _conclude(console, options, claim, own, proofs)


def _outputs(options: argparse.Namespace) -> tuple[Path, Path]:
    """Return page and summary."""
    return options.out / "proof.png", options.out / "summary.json"


def _gains_of(options: argparse.Namespace, own: Vehicle) -> tuple[GainSet, str]:
    """Return the gains: of a parameter file, else of the file that the vehicle names, else the rule's."""
    name = options.params or own.params or "rule"
    base = params_file.load(config_files.find("params", BASE), SUITE)
    if name == "rule":
        space = GainSpace(own, base[topics.GUIDANCE].guidance, options.delay, 1.0 / options.rate)
        return space.rule(), "rule"
    return tuned_file.read(config_files.find("params", name)), Path(name).stem


def _other_laws(options: argparse.Namespace, claim: Proposition, bar: Progress) -> dict[str, GainSet]:
    """Tune every other law with one budget, and the usual one beside them; return their gains."""
    base = params_file.load(config_files.find("params", BASE), SUITE)[topics.GUIDANCE].guidance
    found = {}
    for law in LAWS:
        space = GainSpace(claim.vehicle, base, options.delay, 1.0 / options.rate, law)
        problem = Problem(space, [claim.vehicle], claim.conditions, options.seed)
        budget = Budget(options.generations, threads=options.threads)
        task = bar.add_task(f"tune: {law}", total=budget.generations)
        point = search(problem, budget, partial(_advance, bar, task)).point
        found[law if law != OWN_LAW else f"{law}, tuned alike"] = space.gains(point)
    return found


def _advance(bar: Progress, task: TaskID, _: float) -> None:
    bar.advance(task)


def sentence_of(claim: Proposition, label: str, proof: Proof) -> str:
    """Return what the flights prove."""
    c, late = claim.conditions, claim.conditions.delay + claim.vehicle.rudder.dead_time
    sea_name = "still water" if c.sea is None else f"the sea {c.sea.name}"
    within = "no distance" if math.isinf(proof.off_bound) else f"{proof.off_bound:.2f} m"
    anywhere = "no distance" if math.isinf(proof.whole_bound) else f"{proof.whole_bound:.2f} m"
    uncertain = "with the coefficients of its file"
    if claim.own:
        uncertain = (
            "on a hull drawn for each flight, planar coefficients, rudder rate and dead time within the "
            "uncertainty that its file states, those without one as in the file"
        )
    elif claim.spread > 0.0:
        uncertain = (
            "on a hull drawn for each flight, planar coefficients, rudder rate and dead time off by up to "
            f"{100.0 * claim.spread:g} %"
        )
    n, starts = len(proof.rms), len(proof.unrest)
    return (
        f"With the gains {label} on {claim.vehicle.name}, 99 % of the flights keep within {within} of the "
        f"path away from corners, and within {anywhere} anywhere, at 95 % confidence: in {sea_name}, in "
        f"further currents of up to a quarter of the speed, {uncertain}, with {1e3 * late:.0f} ms of delay, "
        f"on courses whose turns have at least {PROVEN_TURN:g} times the hull's radius. {proof.lost} of {n} "
        f"did not complete their course. Of {starts} hard starts on a straight line {proof.cycles} ended in "
        f"a limit cycle: at most {100.0 * proof.cycle_bound:.1f} % do, at 95 % confidence."
    )


def verdict_of(within: float, proof: Proof) -> str:
    """Return what was asked for, whether it is proven, and the bounds, in one line."""
    bound = "no distance" if math.isinf(proof.off_bound) else f"{proof.off_bound:.2f} m"
    result = "Proven" if proof.holds(within) else "Not proven"
    return (
        f"{result}: 99 % within {within:g} m, limit cycles from at most 1 % of the starts "
        f"(bounds: {bound}, {100.0 * proof.cycle_bound:.2f} %)"
    )


def _conclude(
    console: Console, options: argparse.Namespace, claim: Proposition, own: Vehicle, proofs: dict[str, Proof]
) -> int:
    label, proof = next(iter(proofs.items()))
    holds, sentence = proof.holds(claim.within), sentence_of(claim, label, proof)
    verdict = verdict_of(claim.within, proof)
    console.print(_table(proofs))
    console.print(sentence, soft_wrap=False)
    console.print(verdict, style="bold green" if holds else "bold red")
    if claim.flights < flights_needed():
        console.print(f"notice {claim.flights} flights bound nothing: 99 % at 95 % need {flights_needed()}")
    page, summary = _outputs(options)
    proof_page.draw(page, sentence, verdict, claim.within, proofs)
    write_text(summary, _json(options, sentence, holds, proofs))
    wrote(console, page, "the page")
    wrote(console, summary, "its figures, for programs")
    if holds:
        rest = ["--params", options.params] if options.params else []
        go_on(console, "Fly them", to_type("mission.py", "--vehicle", options.vehicle, *map(str, rest)))
    else:
        rest = ["--overwrite"] if Path("tuned.yaml").exists() else []
        line = to_type("vehicle.py", "tune", options.vehicle, "--delay", f"{options.delay:g}", *rest)
        go_on(console, "Tune", line)
    return EXIT_DONE if holds else EXIT_FAILED


def _table(proofs: dict[str, Proof]) -> Any:
    table = headed_table(
        "True distance in the sea: 99 % of the flights at 95 % confidence", ("gains",),
        ("off corners m", "anywhere m", "not completed", "limit cycles", "at most %", "rudder deg/m"),
    )  # fmt: skip
    for name, p in proofs.items():
        table.add_row(
            name, f"{p.off_bound:.2f}", f"{p.whole_bound:.2f}", f"{p.lost} of {len(p.rms)}",
            f"{p.cycles} of {len(p.unrest)}", f"{100.0 * p.cycle_bound:.1f}", f"{p.travel:.2f}",
        )  # fmt: skip
    return table


def _json(options: argparse.Namespace, sentence: str, holds: bool, proofs: dict[str, Proof]) -> str:
    figures = {
        name: {
            "off_corners_bound": proof.off_bound, "bound": proof.whole_bound, "not_completed": proof.lost,
            "flights": len(proof.rms), "limit_cycles": proof.cycles, "starts": len(proof.unrest),
            "limit_cycle_bound": proof.cycle_bound, "rudder_travel_per_metre": proof.travel,
        }
        for name, proof in proofs.items()
    }  # fmt: skip
    asked = {name: value for name, value in vars(options).items() if name not in ("run", "quiet", "threads")}
    content = {"proven": holds, "sentence": sentence, "options": asked, "gains": figures}
    return json.dumps(without_nan(content), indent=2, default=str) + "\n"
