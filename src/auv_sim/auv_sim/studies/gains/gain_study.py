"""Measures the tables of docs/tuning.md on hulls and gains: `python3 -m auv_sim.studies.gains.gain_study`."""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console

from auv_msgs_py.settings import params_file
from auv_msgs_py.settings.result_files import write_text
from auv_path_following import config_files
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, Parser, add_overwrite, at_least_one, command, target, whole
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.tune import tuned_file
from auv_sim.own_vehicle.tune.ensemble import planar
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace
from auv_sim.own_vehicle.tune.gain_verdict import FOUND, PRESENT, RULE, judge
from auv_sim.own_vehicle.tune.search import Budget, search
from auv_sim.own_vehicle.tune.trial_flights import Conditions
from auv_sim.own_vehicle.tune.tuning_problem import Problem
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.gains.gain_flights import STEPS, Figures, fly_courses, unrest
from auv_sim.studies.gains.study_hulls import chosen, study_hulls
from auv_sim.terminal import console as terminal
from auv_sim.terminal import headed_table
from auv_sim.vehicle import sea

#: Delays of the table of limit cycles, s.
DELAYS = (0.05, 0.15)
#: kp with which `robust.yaml` is compared on the hull that is stable in yaw, rad/s.
KP = 0.262
#: Resolution of a vehicle's navigation, m: a smaller distance counts as this one.
RESOLUTION = 0.01
Row = dict[str, Any]


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="gain_study", description="Limit cycles of the rule, and tuned gains against robust.yaml.",
        allow_abbrev=False,
    )  # fmt: skip
    p.add_argument("--hulls", nargs="+", metavar="NAME", help="some of them (default: all)")
    p.add_argument("--drawn", type=whole, default=10, metavar="N", help="drawn hulls (default: 10)")
    p.add_argument("--generations", type=at_least_one, default=80, metavar="N", help="of a search (80)")
    p.add_argument("--workers", type=at_least_one, default=1, metavar="N", help="flights at once (1)")
    p.add_argument("--seed", type=whole, default=0, metavar="N", help="of the searches (0)")
    p.add_argument("--rule-only", action="store_true", help="the table of limit cycles alone")
    p.add_argument("--out", type=target, default=Path("gain_study.json"), metavar="FILE", help="figures")
    add_overwrite(p)
    return p


@command("gain study")
def main(argv: Sequence[str] | None = None) -> int:
    """Measure, print and write; return 0 done, 2 bad input."""
    options = parser().parse_args(argv)
    check_outputs([options.out], (), options.overwrite)
    console = terminal()
    base = params_file.load(config_files.find("params", "robust"), SUITE)
    robust = tuned_file.flown_of(base)
    rows: list[Row] = []
    for name, hull in chosen(study_hulls(options.drawn), options.hulls).items():
        rows.append(_measured(options, name, hull, robust))
        _print(console, rows[-1])
        write_text(options.out, json.dumps(rows, indent=2) + "\n")
    return EXIT_DONE


def _measured(options: argparse.Namespace, name: str, hull: Vehicle, robust: GainSet) -> Row:
    """Return all figures of one hull."""
    row: Row = {"hull": name, "delay": hull.rudder.dead_time, "cycles": {}}
    flat = planar(hull)
    for delay in DELAYS:
        undelayed = dataclasses.replace(flat, rudder=dataclasses.replace(flat.rudder, dead_time=0.0))
        spaces = {step: GainSpace(undelayed, robust.guidance, delay, step) for step in STEPS}
        row["cycles"][f"{1e3 * delay:.0f} ms"] = {
            "robust": max(unrest(undelayed, delay, step, robust) for step in STEPS),
            "rule": max(unrest(undelayed, delay, step, space.rule()) for step, space in spaces.items()),
            "p tau": max(space.ruled.heading.product for space in spaces.values()),
        }
    space = GainSpace(flat, robust.guidance, 0.0, 0.05)
    row |= {"b": space.response.effect, "p": space.response.divergence}
    return row if options.rule_only else row | _tuned(options, space, robust)


def _tuned(options: argparse.Namespace, space: GainSpace, robust: GainSet) -> Row:
    """Tune one hull; return the figures of its courses, and limit cycles at its own delay."""
    hull = space.vehicle
    conditions = Conditions(0.0, 0.05, STEPS, sea.load("moderate"))
    problem = Problem(space, [hull], conditions, options.seed, robust)
    found = search(problem, Budget(options.generations, threads=options.workers))
    verdict = judge(problem, found, options.workers)
    slower: dict[str, Any] = {"nism": dataclasses.replace(robust.autopilot.nism, kp=KP, kp_from_rudder=False)}
    with_kp = robust._replace(autopilot=dataclasses.replace(robust.autopilot, **slower))
    sets = {"robust": robust, f"kp {KP}": with_kp, "rule": space.rule(), "tuned": verdict.gains}
    flown = {label: fly_courses(hull, gains, options.workers) for label, gains in sets.items()}
    late = hull.rudder.dead_time
    return {
        "source": verdict.source, "why": list(verdict.why),
        "own cycles": {
            label: max(unrest(hull, late, step, gains) for step in STEPS) for label, gains in sets.items()
        },
        "courses": {
            label: {
                f"{mission}{', current' if flowing else ''}": figures._asdict()
                for (mission, flowing), figures in courses.items()
            }
            for label, courses in flown.items()
        },
        "against robust": compared(flown["tuned"], flown["robust"]),
        "margins": verdict.margins._asdict(),
    }  # fmt: skip


def compared(tuned: Mapping[Any, Figures], other: Mapping[Any, Figures]) -> dict[str, float]:
    """Return ratios over all courses: rms off corners (together, and the worst), rudder travel (together).

    A distance below `RESOLUTION` counts as this one.
    """
    off = [(max(tuned[key].off, RESOLUTION), max(other[key].off, RESOLUTION)) for key in tuned]
    return {
        "off corners": math.sqrt(sum(one**2 for one, _ in off) / sum(two**2 for _, two in off)),
        "worst off corners": max(one / two for one, two in off),
        "travel": sum(tuned[key].travel for key in tuned) / sum(other[key].travel for key in tuned),
    }


def _print(console: Console, row: Row) -> None:
    for delay, cycles in row["cycles"].items():
        console.print(
            f"{row['hull']}: b {row['b']:.2f}, p {row['p']:.2f}; late yaw rate at {delay}: robust "
            f"{cycles['robust']:.2f}, rule {cycles['rule']:.2f} deg/s, p tau {cycles['p tau']:.2f}"
        )
    if "courses" not in row:
        return
    missions = list(row["courses"]["tuned"])
    table = headed_table(
        f"{row['hull']}, {1e3 * row['delay']:.0f} ms: rms / off corners m / travel deg/m",
        ("gains",), ("late deg/s", *missions),
    )  # fmt: skip
    for label, courses in row["courses"].items():
        cells = [f"{c['rms']:.3f} / {c['off']:.3f} / {c['travel']:.2f}" for c in courses.values()]
        table.add_row(label, f"{row['own cycles'][label]:.2f}", *cells)
    console.print(table)
    against = ", ".join(f"{name} {value:.2f}" for name, value in row["against robust"].items())
    state = {FOUND: "the gains found", PRESENT: "robust", RULE: "the rule"}[row["source"]]
    console.print(f"tuned is {state}; against robust: {against}; {'; '.join(row['why'])}", markup=False)


if __name__ == "__main__":
    raise SystemExit(main())
