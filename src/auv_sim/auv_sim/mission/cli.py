"""`scripts/mission.py`: fly a mission, from its files to its picture."""

from __future__ import annotations

import argparse
import shutil
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rich.markup import escape

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.graph_look import GraphTaken
from auv_path_following import config_files
from auv_sim.command_line import (
    EXIT_DONE,
    EXIT_FAILED,
    EXIT_INTERRUPTED,
    Parser,
    add_flown_option,
    command,
    finite,
    make_directory,
    positive,
    ros_domain,
    ros_namespace,
    say,
    whole,
)
from auv_sim.command_line import console as terminal
from auv_sim.drivers.mavlink_link import parse_address
from auv_sim.mission import launcher, plan, results
from auv_sim.mission.options import DEFAULT_MISSION, DEFAULT_PARAMS, DEFAULT_VEHICLE, Options
from auv_sim.mission.progress import Progress
from auv_sim.mission.vehicle_driver import DRIVERS

_EXIT = {
    "complete": EXIT_DONE,
    "incomplete": EXIT_FAILED,
    "aborted": EXIT_FAILED,
    "interrupted": EXIT_INTERRUPTED,
}


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="mission.py", description="Fly a mission over ROS 2, record it, draw it.", allow_abbrev=False
    )
    shipped = {
        kind: ", ".join(config_files.shipped(kind)) for kind in ("missions", "vehicles", "params", "seas")
    }
    p.add_argument(
        "--mission",
        default=DEFAULT_MISSION,
        metavar="FILE",
        help=f"file or one of: {shipped['missions']}",
    )
    p.add_argument(
        "--vehicle",
        default=DEFAULT_VEHICLE,
        metavar="FILE",
        help=f"file or one of: {shipped['vehicles']}",
    )
    p.add_argument(
        "--believed",
        metavar="FILE",
        help="the hull as the nodes know it, where the simulator has another (default: --vehicle's)",
    )
    p.add_argument(
        "--params", default=DEFAULT_PARAMS, metavar="FILE", help=f"file or one of: {shipped['params']}"
    )
    p.add_argument(
        "--current", nargs=2, type=finite, metavar=("VX", "VY"), help="current towards north and east, m/s"
    )
    p.add_argument(
        "--initial",
        nargs=3,
        type=finite,
        metavar=("X", "Y", "PSI_DEG"),
        help="start: north, east (m), heading (deg)",
    )
    p.add_argument(
        "--sea",
        metavar="FILE",
        help="what is not ideal: noise, fixes, currents, rudder;"
        f" file or one of: {shipped['seas']} (default: all is ideal)",
    )
    p.add_argument("--seed", type=whole, metavar="N", help="of all that is random in the sea (default 0)")
    p.add_argument("--switching", choices=("off", "g0", "all"), help="joints with a circle of acceptance")
    p.add_argument(
        "--speed",
        type=positive,
        metavar="N",
        help="free running at N times real time; without it lockstep, as fast as it goes",
    )
    p.add_argument(
        "--no-sim", action="store_true", help="all but the simulator: a vehicle speaks the contract's topics"
    )
    p.add_argument(
        "--use-sim-time", action="store_true", help="with --no-sim: follow the /clock that somebody publishes"
    )
    p.add_argument(
        "--vehicle-driver",
        choices=tuple(DRIVERS),
        help="a vehicle behind this driver, not the simulator (emulated, unless --vehicle-address)",
    )
    p.add_argument(
        "--vehicle-address",
        metavar="ADDRESS",
        help="with --vehicle-driver: udpin:HOST:PORT to wait there, udpout:HOST:PORT to talk to it",
    )
    p.add_argument("--out", type=Path, metavar="DIR", help="run directory (default: runs/MISSION-DATE)")
    p.add_argument("--composed", action="store_true", help="all nodes in one process")
    p.add_argument(
        "--any-processor", action="store_true", help="lockstep: let the system choose where each process runs"
    )
    p.add_argument("--namespace", type=ros_namespace, default="/auv", help="of all nodes (default /auv)")
    p.add_argument(
        "--domain", type=ros_domain, help="ROS domain (default: one of its own; with --no-sim ROS_DOMAIN_ID)"
    )
    add_flown_option(p, None)
    p.add_argument("--force", action="store_true", help="fly what the check of the plan refuses")
    p.add_argument("--quiet", action="store_true", help="print nothing unless something goes wrong")
    return p


@command("mission", interrupted="mission interrupted")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly.

    Returns:
        The exit code: 0 complete, 1 failed, aborted or incomplete, 2 bad input, 130 interrupted.
    """
    return _fly(_options(argv))


def _options(argv: Sequence[str] | None) -> Options:
    given = vars(parser().parse_args(argv))
    for name in ("current", "initial"):
        given[name] = tuple(given[name]) if given[name] is not None else None
    options = Options(**given)
    if options.vehicle_address is not None:
        if options.vehicle_driver is None:
            raise ConfigurationError("--vehicle-address", "no --vehicle-driver", "both")
        parse_address(options.vehicle_address, "--vehicle-address")
    if options.no_sim and options.vehicle_driver is not None:
        raise ConfigurationError("--vehicle-driver", "together with --no-sim", "one of them")
    conflicts: dict[str, Any] = {"--sea": options.sea, "--seed": options.seed}
    if not options.emulator:
        conflicts |= {"--speed": options.speed, "--initial": options.initial, "--current": options.current}
    if not options.simulator:
        reason = (
            "--no-sim" if options.no_sim
            else "--vehicle-address" if options.vehicle_address else "--vehicle-driver"
        )  # fmt: skip
        for flag, value in conflicts.items():
            if value is not None:
                raise ConfigurationError(
                    flag, f"together with {reason}", "it only without, it is for the simulator"
                )
    if options.use_sim_time and (options.simulator or options.emulator):
        raise ConfigurationError(
            "--use-sim-time", "without --no-sim", "both (the simulator always has its own clock)"
        )
    return options


def _fly(options: Options) -> int:
    directory = _run_directory(options)
    resolved = plan.make(options, directory)
    domain = launcher.domain_of(resolved)
    console = terminal(options.quiet)
    make_directory(directory, new=True)
    path = resolved.mission.path
    timing = "lockstep" if resolved.lockstep else "free running"
    console.print(
        f"[bold]{escape(resolved.mission.name)}[/bold]: {path.n} subpaths, {path.length:.1f} m,"
        f" {escape(resolved.vehicle.name)}, {timing}, ROS domain {domain},"
        f" namespace {options.namespace}",
        highlight=False,
    )
    for level, verdicts in (("refused", resolved.verdicts.refusals), ("warning", resolved.verdicts.warnings)):
        for verdict in verdicts:
            console.print(f"[yellow]{level}[/yellow] {escape(str(verdict))}", highlight=False, soft_wrap=True)
    for notice in resolved.verdicts.notices:
        console.print(f"[cyan]notice[/cyan] {escape(notice)}", highlight=False, soft_wrap=True)
    try:
        with Progress(path, console, options.quiet) as progress:
            outcome = launcher.fly(resolved, directory, domain, progress)
    except GraphTaken:
        shutil.rmtree(directory)  # nothing was flown, and the same command is to work again
        raise
    if outcome.state != "complete":
        say(f"mission {outcome.state}: {outcome.reason}", error=True)
    outcome, summary = results.conclude(resolved, directory, outcome)
    if summary is not None:
        results.show(resolved, directory, outcome, summary, console)
    if outcome.state == "incomplete":
        say(f"mission incomplete: {outcome.reason}", error=True)
    return _EXIT[outcome.state]


def _run_directory(options: Options) -> Path:
    if options.out is not None:
        if options.out.exists():
            raise ConfigurationError("--out", f"{options.out}, which exists", "a new directory")
        return options.out.absolute()
    name = Path(options.mission).stem
    base = Path.cwd() / "runs" / f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"
    directory, number = base, 1
    while directory.exists():
        number += 1
        directory = base.with_name(f"{base.name}-{number}")
    return directory
