"""Fly manoeuvres on the simulator or on a vehicle, record them, and draw them."""

from __future__ import annotations

import argparse
import contextlib
import os
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console

from auv_msgs_py.node.run import EXIT_BAD_INPUT, run_nodes
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.ros_domain import domain_of_environment
from auv_path_following import config_files
from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, make_directory, to_type
from auv_sim.launch.processes.domains import free_domain, variables_of
from auv_sim.nodes.manoeuvres.manoeuvres_node import INTERRUPTED, ManoeuvresNode
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.legs import fin_shares
from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import ManoeuvreBounds, ManoeuvreRun
from auv_sim.own_vehicle.manoeuvres.program_file import Program
from auv_sim.terminal import console, go_on, progress_bar, wrote
from auv_sim.vehicle import sea

CONSENT = "--yes-the-vehicle-may-move"


def fly(options: argparse.Namespace) -> int:
    """Fly a program; return the exit code.

    Raises:
        ConfigurationError: a file, an option or the ROS domain cannot be used, or there is no consent.
        KeyboardInterrupt: a signal came; zero commands were sent.
    """
    options.model = options.controller_model or options.vehicle
    hull = vehicle_file.load(options.model)
    program = program_file.load(options.program)
    rehearsal = ManoeuvreRun(hull, program, ManoeuvreBounds(box=options.box), options.depth)
    if options.sea is not None:
        sea.load(options.sea)
    if options.no_sim:
        domain_of_environment()  # a wrong one is refused before anything is made
        _ask(options, hull, rehearsal.duration)
        return _fly(options, hull, program)
    if options.consent:
        raise ConfigurationError(CONSENT, "no --no-sim", "both: on the simulator no vehicle moves")
    with free_domain() as domain:  # a rehearsal meets no other graph
        os.environ |= variables_of(domain)
        return _fly(options, hull, program)


def _fly(options: argparse.Namespace, hull: Vehicle, program: Program) -> int:
    """Fly a program in the ROS domain of the environment; return the exit code."""
    directory = options.out or Path("runs") / time.strftime("manoeuvres-%Y%m%d-%H%M%S")
    make_directory(directory, new=True)
    _keep(options, directory)
    out, made = console(options.quiet), list[ManoeuvresNode]()
    share = min(fin_shares(program, hull).values(), default=1.0)
    if share < 1.0:
        out.print(f"angles of fins reduced to {share:.0%} of the program's: the vehicle has no more")
    with _progress(out, program.name, made):
        code = run_nodes(_nodes(options, hull, directory, made), [])
    if not made or code == EXIT_BAD_INPUT:
        return code
    run = made[0].run
    _show(out, options, hull, run, directory)
    if code == EXIT_DONE and run.over == INTERRUPTED:
        sent = "zero commands were sent" if run.begun else "nothing was sent"
        raise KeyboardInterrupt(f"interrupted: {sent}")
    return EXIT_DONE if run.complete else EXIT_FAILED


def _ask(options: argparse.Namespace, hull: Vehicle, duration: float) -> None:
    """Ask for consent at the terminal unless it was given: the vehicle moves only with a person's word."""
    if options.consent:
        return
    if not sys.stdin.isatty():
        expected = f"{CONSENT} as well, or a terminal"
        raise ConfigurationError("--no-sim", "no terminal to ask at", expected)
    depth = f" at {options.depth:g} m of depth" if hull.dives else ""
    print(
        f"The vehicle will move for up to {duration:.0f} s{depth}, within {options.box:g} m of where it is to"
        " north and to east, with up to all of its thrust."
    )
    try:
        answer = input("Type yes if it may: ").strip().lower()
    except EOFError:
        raise ConfigurationError("--no-sim", "no answer", "yes") from None
    if answer != "yes":
        raise ConfigurationError("--no-sim", "another answer", "yes")


def _keep(options: argparse.Namespace, directory: Path) -> None:
    """Keep the files that are flown; the recorder puts them into the bag."""
    kept = directory / "config"
    kept.mkdir()
    shutil.copy(config_files.find("vehicles", options.model), kept / "vehicle.yaml")
    shutil.copy(config_files.find("manoeuvres", options.program), kept / "program.yaml")


def _nodes(
    options: argparse.Namespace, hull: Vehicle, directory: Path, made: list[ManoeuvresNode]
) -> list[Callable[[], Any]]:
    """Return what makes each node; the one that flies is put into `made`."""
    from auv_sim.nodes.manoeuvres.rehearsed_vehicle import RehearsedVehicle
    from auv_sim.nodes.recorder_node import RecorderNode

    file, hull_file = (
        str(config_files.find("vehicles", name).absolute()) for name in (options.model, options.vehicle)
    )
    simulated = not options.no_sim
    program = str(config_files.find("manoeuvres", options.program).absolute())
    flying: dict[str, Any] = {
        "vehicle": file, "program": program,
        "consent": True, "depth": options.depth, "bounds.box": options.box, "use_sim_time": simulated,
    }  # fmt: skip
    if simulated:
        flying["look_around"] = 0.0
    recording = {
        "directory": str(directory / "bag"), "sternplanes": hull.dives, "use_sim_time": simulated,
    }  # fmt: skip

    def flyer() -> ManoeuvresNode:
        made.append(_node(ManoeuvresNode, options.namespace, flying))
        return made[0]

    # The one that flies is closed first: nothing that another does may delay its zeros.
    factories: list[Callable[[], Any]] = [flyer, partial(_node, RecorderNode, options.namespace, recording)]
    if simulated:
        north, east = options.current
        plant: dict[str, Any] = {
            "vehicle": hull_file, "speed": options.speed,
            "initial.surge": 0.0, "initial.depth": options.depth,
            "sea": options.sea or "", "seed": options.seed, "current.Vx": north, "current.Vy": east,
            "flood_rate": 200.0 * max(options.speed, 1.0),
        }  # fmt: skip
        make = partial(RehearsedVehicle, lambda: made[0])
        factories.append(partial(_node, make, options.namespace, plant))
    return factories


def _node(make: Callable[..., Any], namespace: str, parameters: dict[str, Any]) -> Any:
    words = ["--ros-args", "-r", f"__ns:={namespace}"]
    for name, value in parameters.items():
        text = str(value).lower() if isinstance(value, bool) else value
        words += ["-p", f"{name}:={text!r}" if isinstance(value, str) else f"{name}:={text}"]
    return make(cli_args=words, use_global_arguments=False)


@contextlib.contextmanager
def _progress(out: Console, name: str, made: list[ManoeuvresNode]) -> Iterator[None]:
    """Show how much of the program is flown."""
    over = threading.Event()
    with progress_bar(out, disable=not out.is_terminal) as bar:
        task = bar.add_task(name, total=100)

        def follow() -> None:
            while not over.wait(0.2):
                bar.update(task, completed=round(100.0 * made[0].run.progress) if made else 0)

        thread = threading.Thread(target=follow, daemon=True)
        thread.start()
        try:
            yield
        finally:
            over.set()
            thread.join()


def _show(
    out: Console, options: argparse.Namespace, hull: Vehicle, run: ManoeuvreRun, directory: Path
) -> None:
    out.print(f"[{'green' if run.complete else 'yellow'}]{run.over or 'ended'}[/]", highlight=False)
    wrote(out, directory / "bag", "every topic as a recording")
    if run.rows:
        from auv_sim.own_vehicle.manoeuvres.manoeuvre_picture import draw

        picture = directory / "manoeuvres.png"
        title = f"{hull.name}: {options.program}, {run.rows[-1].t:.0f} s"
        draw(run.rows, title, hull.thrust_symbol, hull.dives, picture)
        wrote(out, picture, "the manoeuvres in one picture")
    if run.complete:
        line = to_type("vehicle.py", "identify", directory / "bag", vehicle=options.model)
        go_on(out, "Identify the vehicle", line)
