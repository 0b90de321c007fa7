"""What `scripts/plan.py` does: check a mission, draw it, export it, print what was found."""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.settings.result_files import NotWritten
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current, SpatialCurrent
from auv_path_following import config_files, vehicle
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.switching import with_overrides
from auv_path_following.mission_check.depth_survey import survey_of
from auv_path_following.mission_check.flyable import Findings, check, refusal, refusals, require_planes
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.mission_check import chart, drawing
from auv_sim.command_line import EXIT_BAD_INPUT, EXIT_DONE, say, to_type
from auv_sim.sim_parameters import SUITE
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, wrote

#: More joints than this are counted, not listed: verdict and summary stay on one screen.
_ROWS = 12
_ALL_THE_SAME = "scripts/mission.py --force would fly it all the same"
#: Options of this command that `scripts/mission.py` has as well.
_FLOWN_WITH = ("mission", "vehicle", "params", "current", "upwelling", "switching")


def plan(options: argparse.Namespace, not_default: Mapping[str, Any]) -> int:
    """Check, draw and export a mission.

    Args:
        options: the command line's.
        not_default: those of them that differ from their defaults.

    Returns:
        The exit code.

    Raises:
        ConfigurationError: the mission is refused, or a file cannot be used.
    """
    hull = vehicle.load(options.vehicle)
    mission = mission_file.load(options.mission, hull)
    guidance = _guidance(options, mission)
    switching = with_overrides(guidance.switching, options.switching, None)
    require_planes(hull, {"--upwelling": options.upwelling})
    north, east = options.current
    current = SpatialCurrent(north, east, -(options.upwelling or 0.0))
    findings = check(mission, hull, current, switching, guidance.lookahead)
    console = terminal(options.quiet, soft_wrap=True, width=None if sys.stdout.isatty() else 110)
    _show(console, mission, hull, findings)
    _draw(console, options, mission, hull, findings)
    if options.export is not None:
        chart.export(mission, options.export)
        wrote(console, options.export, "the path for a chart")
    if findings.refusals:
        if options.quiet:
            raise refusal(mission, findings, _ALL_THE_SAME)
        for one in refusals(mission, findings, _ALL_THE_SAME):
            say(one, error=True)
        return EXIT_BAD_INPUT
    same = {name: not_default[name] for name in _FLOWN_WITH if name in not_default}
    go_on(console, "Fly it", to_type("mission.py", **same))
    return EXIT_DONE


def _draw(
    console: Console, options: argparse.Namespace, mission: Mission, hull: Vehicle, findings: Findings
) -> None:
    png = options.out or (None if options.quiet else Path(f"plan-{mission.source.stem}.png"))
    if png is not None:
        try:
            drawing.draw(mission, findings, hull, png, Current(*options.current))
        except (NotWritten, ValueError) as error:  # ValueError: a suffix that is no picture
            reason = error.strerror if isinstance(error, NotWritten) else error
            raise ConfigurationError("--out", f"{png} ({reason})", "a picture that can be written") from None
        wrote(console, png, "the plan in one picture")


def _guidance(options: argparse.Namespace, mission: Mission) -> PathFollowerConfig:
    """Return the guidance's configuration as in flight: the parameters, then the mission."""
    source = config_files.find("params", options.params) if options.params else None
    if source is None:
        parameters = SUITE[topics.GUIDANCE]()
    else:
        parameters = params_file.load(source, SUITE)[topics.GUIDANCE]
    guidance: PathFollowerConfig = parameters.with_mission_overrides(mission).guidance
    return guidance


def _show(console: Console, mission: Mission, hull: Vehicle, findings: Findings) -> None:
    path = mission.path
    times = path.n // max(mission.once, 1)
    console.print(
        f"[bold]{escape(mission.name)}[/bold]"
        + (f": {escape(mission.description)}" if mission.description else "")
    )
    console.print(
        f"  path      {path.n} subpaths, {path.length:.2f} m"
        + (f", {times} times round" if times > 1 else "")
    )
    if mission.spatial is not None:
        console.print(_depths(mission.spatial, mission.once))
    lasts = f"{findings.duration:.0f} s" if math.isfinite(findings.duration) else "no end"
    console.print(
        f"  duration  {lasts} at {findings.speed:.2f} m/s through the water"
        f" ({mission.thrust:.2f} {hull.thrust_symbol})"
    )
    turn = f"{findings.turn.radius:.2f} m, {findings.turn.source}"
    console.print(f"  vehicle   {escape(hull.name)}, tightest turn {turn}")
    console.print(_joints(mission))
    for finding in findings.warnings:
        console.print(f"[yellow]warning[/yellow]  {escape(str(finding))}")
    for notice in findings.notices:
        console.print(f"[cyan]notice[/cyan]   {escape(notice)}")
    if not findings.refusals and not findings.warnings:
        console.print("[green]no fault found[/green]")
    console.print()


def _depths(path: SpatialPath, subpaths: int) -> str:
    survey = survey_of(path, subpaths)
    shallowest, deepest = float(survey.z.min()), float(survey.z.max())
    span = f"{deepest:g} m" if deepest - shallowest < 1e-6 else f"{shallowest:.1f} to {deepest:.1f} m"
    steepest = math.degrees(float(np.abs(survey.gamma).max()))
    return f"  depth     {span}, steepest slope {steepest:.1f} deg, {path.length:.2f} m in three dimensions"


def _joints(mission: Mission) -> Table | str:
    joints = mission.path.joints[: max(mission.once - 1, 0)]
    if not joints:
        return "  joints    none"
    if len(joints) > _ROWS:
        counts = Counter(joint.geometric for joint in joints)
        listed = ", ".join(f"{counts[name]} {name}" for name in ("G0", "G1", "G2") if counts[name])
        worst = max(joints, key=lambda joint: joint.gap)
        return f"  joints    {listed}, largest gap {worst.gap * 1e3:.3f} mm at joint {worst.index}"
    table = Table(title="joints", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for heading in ("", "between"):
        table.add_column(heading, no_wrap=True)
    for heading in ("north\n[m]", "east\n[m]", "gap\n[mm]", "course\nstep [deg]", "curvature\nstep [1/m]"):
        table.add_column(Text(heading), justify="right", no_wrap=True)
    table.add_column("")
    colors = {"G0": "red", "G1": "yellow", "G2": "green"}
    for joint in joints:
        before, after = (mission.path.segments[joint.index - 1 + k].kind for k in (0, 1))
        table.add_row(
            str(joint.index),
            f"{before}, {after}",
            f"{joint.x:.2f}",
            f"{joint.y:.2f}",
            f"{joint.gap * 1e3:.3f}",
            _clean(math.degrees(joint.angle_step), 2),
            _clean(joint.curvature_step, 5),
            f"[{colors[joint.geometric]}]{joint.geometric}[/] {joint.parametric}",
        )
    return table


def _clean(value: float, digits: int) -> str:
    """Return a rounded number without a minus in front of a zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}"
