"""Flies hulls by what `vehicle.py new` assumes of them: `python3 -m auv_sim.studies.gains.new_study`."""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.console import Console

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.control.pitch_plane import pitch_gains
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.missions import mission_file
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, Parser, add_overwrite, at_least_one, command, target, whole
from auv_sim.flight.batch import engine
from auv_sim.flight.metrics import under_way
from auv_sim.flight.scenario import Scenario
from auv_sim.own_vehicle.new.trial_flight import trial_text
from auv_sim.own_vehicle.new.vehicle_text import EFFECT_FACTOR
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.trial_flights import LINE, PATIENCE, Flight, start_at, with_laws
from auv_sim.studies.gains.gain_flights import STARTS, STEPS
from auv_sim.studies.gains.new_hulls import assumed, new_hulls
from auv_sim.studies.gains.study_hulls import USUAL_DELAY, chosen, late
from auv_sim.terminal import console as terminal
from auv_sim.terminal import headed_table
from auv_sim.vehicle import sea

#: Distance within which the way is counted, m.
NEAR = 1.0
#: Duration of a flight on a line, s and in lengths over speed: a long hull needs longer to reach the line.
#: The yaw rate counts in the second half.
LINE_SECONDS, LINE_LENGTHS = 120.0, 150.0
Model = Callable[[Vehicle], Vehicle]


class Known(NamedTuple):
    """Figures of one hull that is known by little; NaN where `new` refuses it or the survey was not flown.

    Attributes:
        hull: its name.
        length, speed: m, m/s.
        effect, divergence: b L^2/u^2 and p L/u of the true hull.
        effect_ratio: true b over the assumed.
        within: least share of the way within `NEAR` of the path, of all seeds.
        rms, largest: largest true distance rms of all seeds, and largest distance, m.
        yaw_rate: rms, late on a straight line, deg/s: the worst of `STEPS` and of four starts.
        refused: the line with which `new` refuses it; empty: none.
    """

    hull: str
    length: float
    speed: float
    effect: float
    divergence: float
    effect_ratio: float
    within: float
    rms: float
    largest: float
    yaw_rate: float
    refused: str = ""


#: Limits: name -> whether the figures of a hull keep it.
TARGETS: dict[str, Callable[[Known], bool]] = {
    f"within {NEAR:g} m for 95 % of the way": lambda k: k.within >= 0.95,
    "true rms at most 0.45 m": lambda k: k.rms <= 0.45,
    "no limit cycle (yaw rate at most 0.3 deg/s)": lambda k: k.yaw_rate <= 0.3,
}


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="new_study", description="Flights by what vehicle.py new assumes of hulls.",
        allow_abbrev=False,
    )  # fmt: skip
    p.add_argument("--drawn", type=whole, default=30, metavar="N", help="drawn hulls (default: 30)")
    first = "number of the first drawn hull (0); from 1 on the drawn ones alone"
    p.add_argument("--first", type=whole, default=0, metavar="N", help=first)
    p.add_argument("--hulls", nargs="+", metavar="NAME", help="some of them (default: all)")
    p.add_argument("--seeds", type=at_least_one, default=2, metavar="N", help="surveys of each hull (2)")
    gains = p.add_mutually_exclusive_group()
    gains.add_argument("--no-allowance", action="store_true", help="gains as if the assumptions were known")
    gains.add_argument("--true-hull", action="store_true", help="gains for the hull that is in the water")
    p.add_argument("--out", type=target, default=Path("new_study.json"), metavar="FILE", help="figures")
    add_overwrite(p)
    return p


@command("new study")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly, print and write; return 0 done, 2 bad input."""
    options = parser().parse_args(argv)
    check_outputs([options.out], (), options.overwrite)
    console = terminal()
    own = _as_if_known if options.no_allowance else _true if options.true_hull else assumed
    found = [
        known(name, hull, options.seeds, own)
        for name, hull in chosen(new_hulls(options.drawn, options.first), options.hulls).items()
    ]
    write_text(options.out, json.dumps([one._asdict() for one in found], indent=2) + "\n")
    _print(console, found)
    return EXIT_DONE


def _as_if_known(hull: Vehicle) -> Vehicle:
    """Return what `assumed` does, for which the rule makes no allowance."""
    return dataclasses.replace(assumed(hull), assumed_within=1.0)


def _true(hull: Vehicle) -> Vehicle:
    """Return the hull itself, with the delay that it has in the sea `moderate`."""
    return late(hull, USUAL_DELAY)


def known(name: str, hull: Vehicle, seeds: int, controller_model: Model = assumed) -> Known:
    """Return the figures of one hull.

    Args:
        name: of the hull.
        hull: that is in the water, without a dead time.
        seeds: of the sea; a survey each.
        controller_model: returns the vehicle for which the gains are, and which the controllers assume.
    """
    response, size = response_of(hull), hull.top_speed / hull.length
    figures = name, hull.length, hull.top_speed, response.effect / size**2, response.divergence / size
    try:
        own = controller_model(hull)
        surveys = [_survey(hull, own, seed) for seed in range(1, seeds + 1)]
    except ConfigurationError as error:
        nan = math.nan
        return Known(*figures, nan, nan, nan, nan, nan, str(error))
    restless = max(_unrest(hull, own, step) for step in STEPS)
    within, rms, largest = zip(*surveys, strict=True)
    ratio = response.effect / response_of(own).effect
    return Known(*figures, ratio, min(within), max(rms), max(largest), restless)


def _gains(own: Vehicle, step: float) -> GainSet:
    gains = gains_for(own, step=step)
    return GainSet(with_gains(PathFollowerConfig(), gains), gains.heading.autopilot, pitch_gains())


def _unrest(hull: Vehicle, own: Vehicle, step: float) -> float:
    """Return the rms yaw rate late on a line, deg/s: the worst of `STARTS`."""
    seconds = max(LINE_SECONDS, LINE_LENGTHS * hull.length / hull.top_speed)
    rates = []
    for y, heading, rate in STARTS:
        scenario = Scenario(
            path=LINE, vehicle=late(hull, USUAL_DELAY), thrust=hull.thrust_max, step=step, time_limit=seconds,
            initial=start_at(hull, y, math.radians(heading), hull.top_speed, rate),
        )  # fmt: skip
        flown = engine.track(with_laws(Flight(scenario, True), _gains(own, step), own))
        calm = flown.r[flown.t - flown.t[0] >= 0.5 * seconds]
        rates.append(float(np.sqrt(np.mean(calm**2))) if calm.size else math.inf)
    return math.degrees(max(rates))


def _survey(hull: Vehicle, own: Vehicle, seed: int) -> tuple[float, float, float]:
    """Fly the survey of `new` in the sea; return the share near the path, rms and largest distance, m."""
    mission = mission_file.read_text(trial_text(own), own)
    gains = _gains(own, 0.05)
    scenario = Scenario(
        path=mission.path, vehicle=hull, thrust=mission.thrust, sea=sea.load("moderate"), seed=seed,
        guidance=gains.guidance, autopilot=gains.autopilot, controller_vehicle=own,
        time_limit=2.0 * PATIENCE * mission.path.length / hull.top_speed + 60.0,
    )  # fmt: skip
    flown = under_way(engine.track(scenario), mission.path.n)
    if not flown.steps or flown.s[-1] < 0.99 * mission.path.n:
        return 0.0, math.inf, math.inf
    distance = np.abs(mission.path.distance(flown.x_true, flown.y_true, flown.subpath(mission.path.n)))
    return float(np.mean(distance < NEAR)), float(np.sqrt(np.mean(distance**2))), float(distance.max())


def _print(console: Console, found: Sequence[Known]) -> None:
    table = headed_table(
        "Hulls that are known by length, speed and radius", ("hull",),
        ("length m", "speed m/s", "b L²/u²", "p L/u", "b over assumed", "within 1 m", "rms m", "largest m",
         "late yaw rate deg/s"),
    )  # fmt: skip
    for k in found:
        table.add_row(
            k.hull, f"{k.length:.1f}", f"{k.speed:.2f}", f"{k.effect:.2f}", f"{k.divergence:.2f}",
            f"{k.effect_ratio:.2f}", f"{k.within:.1%}", f"{k.rms:.2f}", f"{k.largest:.2f}",
            f"{k.yaw_rate:.2f}",
        )  # fmt: skip
    console.print(table)
    for k in found:
        if k.refused:
            console.print(f"{k.hull}: {k.refused}", markup=False)
    counts = {target_: sum(map(has, found)) for target_, has in TARGETS.items()}
    counts["all of them"] = sum(all(has(k) for has in TARGETS.values()) for k in found)
    factor = EFFECT_FACTOR
    counts[f"b within the stated factor of {factor:g}"] = sum(
        1 / factor <= k.effect_ratio <= factor for k in found
    )
    for what, count in counts.items():
        console.print(f"{what}: {count} of {len(found)}", highlight=False)


if __name__ == "__main__":
    raise SystemExit(main())
