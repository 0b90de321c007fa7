"""`scripts/mission.py`: fly a mission, from its files to its picture."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from auv_path_following import config_files
from auv_path_following.curves.switching_modes import MODES
from auv_sim.command_line import (
    Parser,
    command,
    finite,
    not_negative,
    positive,
    ros_domain,
    ros_namespace,
    whole,
)
from auv_sim.launch.options import (
    BY_RULE,
    DEFAULT_MISSION,
    DEFAULT_VEHICLE,
    DRIVERS,
    checked_options,
    common_options,
)
from auv_sim.launch.processes.adopted import Loader
from auv_sim.shared_options import Renamed, add_flown_option, add_mission_option


def parser() -> Parser:
    """Return the command line's parser."""
    p = parser_of_one()
    shipped = ", ".join(config_files.shipped("fleets"))
    p.add_argument("--fleet", metavar="FILE", help=f"several vehicles: file or one of: {shipped}")
    return p


def parser_of_one() -> Parser:
    """Return the parser without fleets, for `ros2 launch` as well."""
    p = Parser(
        prog="mission.py", description="Fly a mission over ROS 2, record it and draw it.", allow_abbrev=False
    )
    _add_files(p)
    _add_simulation(p)
    _add_vehicle(p)
    _add_run(p)
    return p


def _add_files(p: argparse.ArgumentParser) -> None:
    shipped = {kind: ", ".join(config_files.shipped(kind)) for kind in ("missions", "vehicles", "params")}
    add_mission_option(p, DEFAULT_MISSION, shipped["missions"])
    p.add_argument(
        "--vehicle",
        default=DEFAULT_VEHICLE,
        metavar="FILE",
        help=f"file or one of: {shipped['vehicles']}",
    )
    model = p.add_mutually_exclusive_group()
    model.add_argument(
        "--controller-model",
        metavar="FILE",
        help="vehicle file that the nodes use, if the simulated hull differs (default: that of --vehicle)",
    )
    model.add_argument("--believed", dest="controller_model", action=Renamed, help=argparse.SUPPRESS)
    p.add_argument(
        "--params",
        metavar="FILE",
        help=f"gains: file or one of: {shipped['params']}; or {BY_RULE}: computed for the vehicle by rule"
        f" (default: those that the vehicle's file names, else {BY_RULE})",
    )


def _add_simulation(p: argparse.ArgumentParser) -> None:
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument(
        "--current", nargs=2, type=finite, metavar=("VX", "VY"), help="current towards north and east, m/s"
    )
    p.add_argument(
        "--upwelling", type=finite, metavar="V", help="current upwards, for a vehicle with stern planes, m/s"
    )
    p.add_argument(
        "--initial",
        nargs=3,
        type=finite,
        metavar=("X", "Y", "PSI_DEG"),
        help="start: north, east (m), heading (deg)",
    )
    p.add_argument(
        "--depth",
        type=not_negative,
        metavar="M",
        help="start level at this depth, m (default: at the path's first depth, pitched along the path)",
    )
    p.add_argument(
        "--sea",
        metavar="FILE",
        help="sensor errors, position fixes, varying current, rudder play:"
        f" file or one of: {seas} (default: none)",
    )
    p.add_argument("--seed", type=whole, metavar="N", help="seed of the sea (default 0)")
    p.add_argument("--switching", choices=MODES, help="which joints have a circle of acceptance")
    p.add_argument(
        "--speed",
        type=positive,
        metavar="N",
        help="run freely at N times real time (default: lockstep, as fast as possible)",
    )


def _add_vehicle(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--no-sim", action="store_true", help="no simulator: a vehicle publishes the contract's topics"
    )
    p.add_argument(
        "--use-sim-time", action="store_true", help="with --no-sim: use the /clock of another publisher"
    )
    p.add_argument(
        "--vehicle-driver",
        choices=tuple(DRIVERS),
        help="fly a vehicle through this driver; an emulated one without --vehicle-address",
    )
    p.add_argument(
        "--vehicle-address",
        metavar="ADDRESS",
        help="with --vehicle-driver: udpin:HOST:PORT to listen there, udpout:HOST:PORT to send there",
    )


def _add_run(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--start-at",
        metavar="PLACE",
        help="where on the path to begin: 'subpath 3', or '120 m' along it (default: its start)",
    )
    p.add_argument(
        "--wait",
        action="store_true",
        help="begin when the service start is called; accept further missions until Ctrl-C",
    )
    p.add_argument(
        "--console",
        action="store_true",
        help="as --wait, and watch and steer in the browser: prints the address",
    )
    p.add_argument("--out", type=Path, metavar="DIR", help="run directory (default: runs/MISSION-DATE)")
    p.add_argument("--display", action="store_true", help="show the mission in RViz or Foxglove")
    p.add_argument("--composed", action="store_true", help="run all nodes but the display in one process")
    p.add_argument(
        "--any-processor", action="store_true", help="lockstep: let the system choose where each process runs"
    )
    p.add_argument("--namespace", type=ros_namespace, default="/auv", help="namespace (default /auv)")
    p.add_argument(
        "--domain", type=ros_domain, help="ROS domain (default: a free one; with --no-sim ROS_DOMAIN_ID)"
    )
    add_flown_option(p, None)
    p.add_argument(
        "--force", action="store_true", help="fly what the plan check refuses, even if set in flight"
    )
    p.add_argument("--quiet", action="store_true", help="print only failures, and the addresses of --console")


@command("mission", interrupted="mission interrupted")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly.

    Returns:
        The exit code: 0 complete, 1 failed, aborted or incomplete, 2 bad input, 130 interrupted.
    """
    given = vars(parser().parse_args(argv))
    if (fleet := given.pop("fleet")) is not None:
        return _fly_fleet(fleet, given)
    options = checked_options(given)
    with Loader() as loader:
        # While the loader loads for the nodes, this process loads for itself.
        from auv_sim.launch.mission_flight import fly

        return fly(options, loader)


def _fly_fleet(fleet: str, given: dict[str, Any]) -> int:
    options = common_options(given)
    with Loader() as loader:
        from auv_sim.launch.fleet.fleet_flight import fly

        return fly(fleet, options, loader)


if __name__ == "__main__":
    raise SystemExit(main())
