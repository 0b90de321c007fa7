"""`scripts/reproduce_paper.py`: the paper's figures and claims, and the studies beside them."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_sim.command_line import Parser, at_least_one, command, make_directory, to_type, whole
from auv_sim.flight.run_record import Run
from auv_sim.studies.paper import claims_page, closest_corner, corners, figures, starts
from auv_sim.studies.paper.cases import flights
from auv_sim.studies.paper.claims import current, following
from auv_sim.studies.paper.claims.claim import FAILS, HOLDS, Claim
from auv_sim.studies.paper.closest_corner import Bound
from auv_sim.studies.paper.paper_flights import MISSION, PLANTS, Flight, fly
from auv_sim.studies.pool import tracked
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, progress_bar, wrote

_BOUNDS = {"the rudder may move before the corner": True, "it may not": False}


def _seconds(text: str) -> float:
    value = float(text)
    if not 10.0 <= value <= 1e5:
        raise argparse.ArgumentTypeError(f"found {text}, expected a time from 10 to 100000 s")
    return value


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="reproduce_paper.py",
        allow_abbrev=False,
        description="Fly the paper's cases, draw its Figures 5 to 12, judge its claims.",
    )
    p.add_argument(
        "--out",
        type=Path,
        default=Path("reproduction"),
        metavar="DIR",
        help="where to write (default: reproduction)",
    )
    p.add_argument("--workers", type=at_least_one, default=2, metavar="N", help="processes (default 2)")
    p.add_argument(
        "--quick",
        action="store_true",
        help="10 instead of 20 odometries a second, a shorter search at the corner",
    )
    p.add_argument(
        "--time-limit",
        type=_seconds,
        default=1500.0,
        metavar="S",
        help="every flight ends here at the latest; what comes later then counts as never reached",
    )
    p.add_argument(
        "--study",
        choices=("starts", "corners", "pictures"),
        help="instead: starts, the random starts; corners, one corner at a time, in currents from all sides; "
        "pictures, those of docs/reproduction.md and docs/tuning.md",
    )
    p.add_argument(
        "--runs", type=at_least_one, default=1000, metavar="N", help="study starts: how many (default 1000)"
    )
    p.add_argument("--seed", type=whole, default=1, metavar="N", help="study starts: seed (default 1)")
    p.add_argument(
        "--laws", nargs="+", choices=tuple(starts.LAWS), default=["robust"], help="study starts: which laws"
    )
    p.add_argument(
        "--plants", nargs="+", choices=tuple(PLANTS), default=list(PLANTS), help="study starts: which hulls"
    )
    return p


@command("reproduction")
def main(argv: Sequence[str] | None = None) -> int:
    """Returns the exit code: 0 done, 1 failed, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    console = terminal()
    make_directory(options.out)
    if options.study == "starts":
        return _starts(options, console)
    if options.study == "corners":
        return _corners(options, console)
    if options.study == "pictures":
        from auv_sim.studies.paper import doc_pictures

        with progress_bar(console) as bar:
            doc_pictures.draw_all(options.out, partial(tracked, bar, options.workers))
        console.print(f"Pictures: {options.out}", highlight=False)
        return 0
    return _paper(options, console)


def _bound(early: bool, effort: int) -> Bound:
    mission = mission_file.load(MISSION)
    angle = abs(mission.path.joints[0].angle_step)
    return closest_corner.best(vehicle.load("remus100"), angle, mission.thrust, early=early, effort=effort)


def _work(item: Flight | tuple[bool, int]) -> Run | Bound:
    return fly(item) if isinstance(item, Flight) else _bound(*item)


def _paper(options: argparse.Namespace, console: Console) -> int:
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
    _show(claims, options, console)
    return 0


def judge(runs: dict[str, Run], plain: Flight) -> list[Claim]:
    """All claims, from the flights; `plain` is one with Table 4's gains."""
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


def _show(claims: Sequence[Claim], options: argparse.Namespace, console: Console) -> None:
    out, usual = options.out, parser().get_default
    table = Table(title="The paper's claims", title_justify="left")
    for heading in ("where", "claim", "verdict"):
        table.add_column(heading)
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
    changed = {name: getattr(options, name) for name in ("out", "workers")}
    changed = {name: value for name, value in changed.items() if value != usual(name)}
    again = to_type("reproduce_paper.py", study="starts", runs=20, **changed)
    go_on(console, "Look further", again)


def _starts(options: argparse.Namespace, console: Console) -> int:
    work = starts.jobs(options.runs, options.seed, options.laws, options.plants)
    with progress_bar(console) as bar:
        task = bar.add_task("flying from everywhere", total=len(work))
        results = starts.study(work, options.workers, lambda: bar.advance(task))
    name = f"starts-seed{options.seed}"
    starts.write(results, options.out / f"{name}.csv")
    table = Table(title=f"{options.runs} random starts, seed {options.seed}", title_justify="left")
    for heading in (
        "law",
        "hull",
        "finish",
        "off once joined: median",
        "worst",
        "rms on 3-7: median",
        "worst",
        "rudder rate",
    ):
        table.add_column(heading, justify="left" if heading in ("law", "hull") else "right")
    for row in starts.table(results):
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
    console.print(table)
    console.print(f"Every start: {options.out / name}.csv", highlight=False)
    return 0


def _corners(options: argparse.Namespace, console: Console) -> int:
    flown = corners.corners()
    with progress_bar(console) as bar:
        task = bar.add_task("flying over corners", total=len(flown))
        results = corners.fly(flown, options.workers, lambda: bar.advance(task))
    corners.write(results, options.out / "corners.csv")
    table = Table(title="Largest distance at a corner, m, both sides", title_justify="left")
    for heading in (
        "hull",
        "model",
        "corner",
        "still",
        "worst current",
        "in the first minute",
        "over REMUS's",
    ):
        table.add_column(heading, justify="left" if heading in ("hull", "model") else "right")
    for row in corners.table(results):
        table.add_row(
            row.hull,
            row.model,
            f"{row.angle}°",
            *(f"{value:.2f}" for value in (row.still, row.worst, row.early, row.ratio)),
        )
    console.print(table)
    console.print(f"Every corner: {options.out}/corners.csv", highlight=False)
    return 0
