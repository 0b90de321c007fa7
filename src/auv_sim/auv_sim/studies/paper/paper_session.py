"""What `scripts/reproduce_paper.py` does: fly the paper's cases or a study, write the results, print them."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_sim.command_line import EXIT_DONE, make_directory, to_type
from auv_sim.flight.run_record import Run
from auv_sim.studies.paper import claims_page, closest_corner, corner_study, figures, start_study
from auv_sim.studies.paper.cases import flights
from auv_sim.studies.paper.claims import current, following
from auv_sim.studies.paper.claims.paper_claim import FAILS, HOLDS, PaperClaim
from auv_sim.studies.paper.closest_corner import Bound
from auv_sim.studies.paper.paper_flights import MISSION, PaperFlight, fly
from auv_sim.studies.pool import tracked
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, headed_table, progress_bar, wrote

#: Searches for the closest corner: their heading -> whether the rudder may move before the corner.
_BOUNDS = {"the rudder may move before the corner": True, "it may not": False}


def run(options: argparse.Namespace, not_default: Mapping[str, Any]) -> int:
    """Run the reproduction or the chosen study.

    Args:
        options: the command line's.
        not_default: those of them that differ from their defaults.

    Returns:
        The exit code.
    """
    console = terminal()
    make_directory(options.out)
    if options.study == "starts":
        _starts(options, console)
    elif options.study == "corners":
        _corners(options, console)
    elif options.study == "pictures":
        _pictures(options, console)
    else:
        _show(_paper(options, console), options.out, console)
        same = {name: not_default[name] for name in ("out", "workers") if name in not_default}
        go_on(console, "Look further", to_type("reproduce_paper.py", study="starts", runs=20, **same))
    return EXIT_DONE


def _pictures(options: argparse.Namespace, console: Console) -> None:
    from auv_sim.studies.paper import doc_pictures

    with progress_bar(console) as bar:
        doc_pictures.draw_all(options.out, partial(tracked, bar, options.workers))
    console.print(f"Pictures: {options.out}", highlight=False)


def _bound(early: bool, effort: int) -> Bound:
    mission = mission_file.load(MISSION)
    angle = abs(mission.path.joints[0].angle_step)
    return closest_corner.best(vehicle.load("remus100"), angle, mission.thrust, early=early, effort=effort)


def _work(item: PaperFlight | tuple[bool, int]) -> Run | Bound:
    return fly(item) if isinstance(item, PaperFlight) else _bound(*item)


def _paper(options: argparse.Namespace, console: Console) -> list[PaperClaim]:
    """Fly the cases, draw the figures, write claims.json and the page; return the claims."""
    named = flights(0.1 if options.quick else 0.05, options.time_limit)
    path = mission_file.load(MISSION).path
    with progress_bar(console) as bar:
        # The searches take longest: they go first.
        effort = 200 if options.quick else 1600
        items = [*((early, effort) for early in _BOUNDS.values()), *named.values()]
        results: list[Any] = tracked(bar, options.workers, "flying the paper's cases", _work, items)
        bounds = dict(zip(_BOUNDS, results[: len(_BOUNDS)], strict=True))
        runs: dict[str, Run] = dict(zip(named, results[len(_BOUNDS) :], strict=True))
        task = bar.add_task("drawing", total=len(figures.FIGURES))
        stems = {}
        for number in figures.FIGURES:
            stems[number] = figures.draw(number, runs, path, options.out)
            bar.advance(task)
        claims = judge(runs, named["1-nism-prestero"])
    rate = "10" if options.quick else "20"
    facts = f"{len(named)} flights of {path.n} subpaths, {path.length:.1f} m, at {rate} odometries a second."
    record = {
        "made": facts,
        "claims": [claim.as_json() for claim in claims],
        "corner_bound_m": {kind: round(bound.deviation, 3) for kind, bound in bounds.items()},
    }
    write_text(options.out / "claims.json", json.dumps(record, indent=2, allow_nan=False) + "\n")
    claims_page.write(options.out / "reproduction.html", claims, stems, bounds, facts)
    return claims


def judge(runs: dict[str, Run], plain: PaperFlight) -> list[PaperClaim]:
    """Judge all claims.

    Args:
        runs: name of the flight -> its run.
        plain: a flight with Table 4's gains.
    """
    scenario = plain.scenario()
    path, hull = scenario.path, scenario.vehicle
    return [
        following.following(runs, path),
        *following.convergence(runs, path),
        following.robustness(runs, path),
        following.rudder_rate(runs, hull),
        following.joints(runs, path),
        following.early_switching(runs, path),
        current.observer(runs),
        current.without_observer(runs, path),
        *current.decays(
            runs, scenario.guidance, scenario.autopilot, scenario.observer, hull, scenario.thrust
        ),
    ]


def _show(claims: Sequence[PaperClaim], out: Path, console: Console) -> None:
    table = headed_table("The paper's claims", ("where", "claim", "verdict"))
    color = {HOLDS: "green", FAILS: "red"}
    for c in claims:
        table.add_row(c.place, c.claim, f"[{color.get(c.verdict, 'yellow')}]{c.verdict}[/]")
    console.print(table)
    for name, what in (
        ("reproduction.html", "claims, numbers, figures on one page"),
        ("claims.json", "the same for programs"),
        ("figure-05.png ...", "Figures 5 to 12: .png, .svg, and the data as .csv"),
    ):
        wrote(console, out / name, what)


def _starts(options: argparse.Namespace, console: Console) -> None:
    work = start_study.jobs(options.runs, options.seed, options.laws, options.plants)
    with progress_bar(console) as bar:
        task = bar.add_task("flying from everywhere", total=len(work))
        results = start_study.study(work, options.workers, lambda: bar.advance(task))
    file = options.out / f"starts-seed{options.seed}.csv"
    start_study.write(results, file)
    numbers = (
        "finish", "off once joined: median", "worst", "rms on 3-7: median", "worst", "rudder rate",
    )  # fmt: skip
    table = headed_table(f"{options.runs} random starts, seed {options.seed}", ("law", "hull"), numbers)
    for row in start_study.table(results):
        table.add_row(
            row.law,
            row.plant,
            f"{100 * row.finished:.1f} %",
            f"{row.distance_median:.2f} m",
            f"{row.distance_worst:.2f} m",
            f"{row.rms_median:.3f} m",
            f"{row.rms_worst:.3f} m",
            f"{math.degrees(row.largest_rudder_rate):.2f} °/s",
        )
    _show_study(console, table, "start", file)


def _corners(options: argparse.Namespace, console: Console) -> None:
    flown = corner_study.corners()
    with progress_bar(console) as bar:
        task = bar.add_task("flying over corners", total=len(flown))
        results = corner_study.fly(flown, options.workers, lambda: bar.advance(task))
    file = options.out / "corners.csv"
    corner_study.write(results, file)
    table = headed_table(
        "Largest distance at a corner, m, both sides",
        ("hull", "model"),
        ("corner", "still", "worst current", "in the first minute", "over REMUS's"),
    )
    for row in corner_study.table(results):
        distances = (row.still, row.worst, row.early, row.ratio)
        table.add_row(row.hull, row.model, f"{row.angle}°", *(f"{value:.2f}" for value in distances))
    _show_study(console, table, "corner", file)


def _show_study(console: Console, table: Table, of: str, file: Path) -> None:
    console.print(table)
    console.print(f"Every {of}: {file}", highlight=False)
