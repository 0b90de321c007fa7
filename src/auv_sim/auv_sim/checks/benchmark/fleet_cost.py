"""Measures what a vehicle of a fleet costs against one that flies alone, in processor time."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from auv_msgs_py.node.start_gate import GATE, PASSED
from auv_sim.checks.benchmark.measures.children import BenchmarkFailed, MeasuredProcesses, processes
from auv_sim.checks.benchmark.measures.stopwatch import MARK
from auv_sim.checks.benchmark.scale import Scale
from auv_sim.checks.patience import PATIENCE
from auv_sim.launch import launcher, mission_plan
from auv_sim.launch.fleet import fleet_launcher, fleet_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options

Tick = Callable[[str], None]
_MICRO = 1e6
#: Numbers of vehicles that are compared.
NUMBERS = (1, 4)
#: Time of the mission that is not measured, s: discovery and the first steps.
_BEFORE = 5.0
#: Simulated seconds of a step, the simulator's default.
_STEP = 0.05


def fleet_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure one vehicle and four in turns, all on the paper's mission in lockstep; best of the rounds.

    Returns:
        place -> number of vehicles -> processor time of a vehicle's step, us: of all processes ("cpu_us") and
        of each kind of process ("cpu_by_process_us").
    """
    runs: dict[str, dict[str, list[dict[str, float]]]] = {"separate": {}, "composed": {}}
    for _ in range(scale.rounds):
        for place, found in runs.items():
            for number in NUMBERS:
                tick(f"fleet, {place}, {number}")
                cost = in_own_process(number, place == "composed", scale.steps)
                found.setdefault(str(number), []).append(cost)
    figures: dict[str, Any] = {}
    for place, found in runs.items():
        for count, costs in found.items():
            best = min(costs, key=lambda cost: sum(cost.values()))
            figures.setdefault(place, {})[count] = {
                "cpu_us": sum(best.values()) * _MICRO,
                "cpu_by_process_us": {name: seconds * _MICRO for name, seconds in best.items()},
            }
    return figures


def in_own_process(number: int, composed: bool, steps: int) -> dict[str, float]:
    """Return `vehicle_cost`, measured in a process of its own: one process enters one graph once.

    Raises:
        BenchmarkFailed: the vehicles did not fly.
    """
    words = [str(number), "composed" if composed else "separate", str(steps)]
    done = subprocess.run(  # noqa: S603 - our own interpreter, our own module
        [sys.executable, "-m", "auv_sim.checks.benchmark.fleet_cost", *words],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    lines = done.stdout.splitlines()
    if not lines or not lines[-1].startswith(MARK):
        raise BenchmarkFailed(f"{number} vehicles: {' '.join(done.stderr.split()[-40:]) or 'no result'}")
    cost: dict[str, float] = json.loads(lines[-1].removeprefix(MARK))
    return cost


def vehicle_cost(number: int, composed: bool, steps: int) -> dict[str, float]:
    """Fly `number` vehicles for `steps` steps each; return the processor time of a vehicle's step.

    Returns:
        kind of process -> s, over all vehicles.

    Raises:
        BenchmarkFailed: they did not fly.
    """
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name, processes(Path(name)) as children:
        directory = Path(name)
        options = Options(quiet=True, composed=composed)
        members, commands = _alone(options, directory) if number == 1 else _fleet(number, options, directory)
        os.environ[GATE] = PASSED  # the graph is new, and the simulators share one clock
        for process, (module, words) in commands.items():
            children.start(process, module, words)
        del os.environ[GATE]
        from auv_sim.launch.monitor import Monitor  # only now: a process with DDS threads must not fork

        monitors = {label: Monitor(plan.options.namespace) for label, plan in members.items()}
        try:
            return _measured(children, members, monitors, steps)
        finally:
            *others, last = monitors.values()
            for monitor in others:
                monitor.leave()
            last.close()


def _alone(options: Options, directory: Path) -> tuple[dict[str, Plan], Any]:
    """Return the plan of a lone mission, and module and arguments of its processes."""
    plan = mission_plan.make(options, directory)
    commands = launcher.commands_of(plan, plan.write(directory / "config"))
    return {"auv": plan}, {f"auv.{name}": command for name, command in commands.items()}


def _fleet(number: int, options: Options, directory: Path) -> tuple[dict[str, Plan], Any]:
    """Return the plans of a fleet's missions, and module and arguments of all processes."""
    file = directory / "fleet.yaml"
    rows = [f"  - {{namespace: /auv{k}, mission: {options.mission}}}\n" for k in range(number)]
    file.write_text("version: 1\nname: benchmark\nvehicles:\n" + "".join(rows), encoding="utf-8")
    plan = fleet_plan.make(str(file), options, directory / "run")
    return plan.members, fleet_launcher.commands_of(plan)


def _measured(
    children: MeasuredProcesses, members: Mapping[str, Plan], monitors: Mapping[str, Any], steps: int
) -> dict[str, float]:
    """Start all missions and measure `steps` steps of each vehicle."""

    def missing() -> bool:
        return any(
            monitor.missing_nodes(set(members[label].parameters), True) for label, monitor in monitors.items()
        )

    children.until(lambda: not missing(), lambda: _look(monitors), PATIENCE)
    with contextlib.ExitStack() as held:
        fleet_launcher.place(members, children.ids, held)
        for label, monitor in monitors.items():
            if refused := monitor.start():
                raise BenchmarkFailed(f"{label} did not start: {refused}")
        return cost_of_steps(children, monitors, steps)


def cost_of_steps(children: MeasuredProcesses, monitors: Mapping[str, Any], steps: int) -> dict[str, float]:
    """Measure at least `steps` steps of each vehicle of missions that have started.

    The steps count from the place at which the measurement begins: on a busy machine a lockstep mission may
    have flown any time before this process looks at it again.

    Returns:
        kind of process -> processor time of a vehicle's step, s, over all vehicles.

    Raises:
        BenchmarkFailed: they did not fly as far.
    """

    def wait_until(flown: float) -> None:
        children.until(lambda: earliest() >= flown, lambda: _look(monitors), PATIENCE)

    def earliest() -> float:
        return min(float(monitor.mission_time) for monitor in monitors.values())

    def stamps() -> int:
        return sum(monitor.stamp for monitor in monitors.values())

    wait_until(_BEFORE)
    begin, before = stamps(), children.usage()
    wait_until(earliest() + steps * _STEP)
    flown, after = (stamps() - begin) * 1e-9 / _STEP, children.usage()
    cost: dict[str, float] = {}
    for name, used in after.items():
        kind = name.rsplit(".", 1)[-1]
        cost[kind] = cost.get(kind, 0.0) + (used.cpu - before[name].cpu) / flown
    return cost


def _look(monitors: Mapping[str, Any]) -> None:
    for monitor in monitors.values():
        monitor.look(0.02)


if __name__ == "__main__":
    number, place, steps = sys.argv[1:]
    figures = vehicle_cost(int(number), place == "composed", int(steps))
    print(f"{MARK}{json.dumps(figures)}", flush=True)
