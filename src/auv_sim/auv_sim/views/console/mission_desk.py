"""Mission files for the console: list, texts, the check of a plan, and what a file adds to a path."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from auv_msgs_py.settings import user_files, yaml_file
from auv_msgs_py.values.errors import ConfigurationError, SuiteError
from auv_path_following import config_files, vehicle
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.mission_check.flyable import Findings, check
from auv_path_following.missions import mission_file
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.views.console.record.readiness import PlanLines

#: Largest distance of the points of a course that is drawn, m.
_DRAWN = 2.0
#: Most points and joints of a draft.
_MOST_POINTS, _MOST_JOINTS = 8000, 2000
#: Longest mission text, characters.
_LONGEST = 400_000


class MissionFacts(NamedTuple):
    """What a mission's file adds to what is on the topics.

    Attributes:
        digest: of the mission.
        joints: of its path, as the page takes them.
        dives: whether the vehicle has stern planes.
        plan: what the check found; None where the file is not on this machine.
    """

    digest: str
    joints: list[dict[str, Any]]
    dives: bool
    plan: PlanLines | None


def facts_of(digest: str, mission: str, text: str, hull: str) -> MissionFacts:
    """Return the facts of the mission that guidance has.

    Args:
        digest: that guidance reports.
        mission, text, hull: guidance's parameters `mission`, `mission_text` and `vehicle`.
    """
    try:
        model = vehicle.load(hull)
        read = mission_file.read_text(text, model) if text else mission_file.load(mission, model)
        if read.digest != digest:
            return MissionFacts(digest, [], model.dives, None)
        return MissionFacts(digest, joints_of(read, model), model.dives, checked(read, model))
    except (SuiteError, OSError):
        return MissionFacts(digest, [], False, None)


def joints_of(mission: Mission, hull: Vehicle) -> list[dict[str, Any]]:
    """Return place (ENU, m), place along the path (m) and kind of each joint, the path's end among them."""
    if hull.dives and mission.altitude is None:
        path = flown_path(mission.path, mission.spatial, hull, mission.thrust)
        lengths = [subpath.length for subpath in path.subpaths]
        ends = [path.evaluate(i, 1.0) for i in range(path.n)]
        places = [(point.y, point.x, -point.z) for point in ends]
        kinds = [segment.kind for segment in path.plan.segments]
    else:
        lengths = [segment.length for segment in mission.path.segments]
        places = [(p.y, p.x, 0.0) for p in (segment.evaluate(1.0) for segment in mission.path.segments)]
        kinds = [segment.kind for segment in mission.path.segments]
    found, way = [], 0.0
    for k, ((x, y, z), length) in enumerate(zip(places, lengths, strict=True)):
        way += length
        following = kinds[k + 1] if k + 1 < len(kinds) else "end"
        found.append({"x": x, "y": y, "z": z, "s": way, "kind": following})
    return found


def checked(mission: Mission, hull: Vehicle) -> PlanLines:
    """Return what the check of a plan prints, as `scripts/plan.py` does; the first line is a headline.

    Raises:
        ConfigurationError: the vehicle cannot fly it at all.
    """
    if not hull.dives:
        mission.require_planar()
    findings = check(mission, hull)
    listed = [f"refused {finding}" for finding in findings.refusals]
    listed += [f"warning {finding}" for finding in findings.warnings]
    listed += [f"notice {notice}" for notice in findings.notices]
    return PlanLines(not findings.refusals, (_headline(mission, findings), *listed))


def check_text(text: str, hull: str) -> PlanLines:
    """Return what the check of a mission's text prints, or the line that refuses the text."""
    if len(text) > _LONGEST:
        return PlanLines(False, (f"found {len(text)} characters, expected at most {_LONGEST}",))
    try:
        model = vehicle.load(hull)
        return checked(mission_file.read_text(text, model, "mission"), model)
    except SuiteError as error:
        return PlanLines(False, (str(error),))


def draft_of(text: str, hull: str) -> dict[str, Any]:
    """Return the course of a mission's text, for the chart before the mission is set: x, y, z, s in ENU, m.

    Raises:
        SuiteError: the text or the vehicle cannot be read.
    """
    model = vehicle.load(hull)
    mission = mission_file.read_text(text, model, "mission")
    north, east, _ = mission.path.polyline(_DRAWN)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(north), np.diff(east)))])
    points = np.stack([east, north, np.zeros_like(way), way], axis=1).round(3)
    step = math.ceil(len(points) / _MOST_POINTS)
    kept = points[(len(points) - 1) % step :: step]  # the last point among them
    joints = joints_of(mission, model)[:_MOST_JOINTS]
    return {"path": kept.tolist(), "joints": joints, "dives": model.dives}


def _headline(mission: Mission, findings: Findings) -> str:
    lasts = f"{findings.duration:.0f} s" if math.isfinite(findings.duration) else "no end"
    verdict = "refused" if findings.refusals else "no fault found" if not findings.warnings else "flyable"
    return f"{mission.name}: {mission.path.n} subpaths, {mission.path.length:.1f} m, {lasts}: {verdict}"


class MissionShelf:
    """The missions that the page offers: those that are shipped, and those of a folder.

    Args:
        folder: with further mission files; None for none.

    Raises:
        ConfigurationError: it is no folder.
    """

    def __init__(self, folder: Path | None = None) -> None:
        if folder is not None and not folder.is_dir():
            raise ConfigurationError("--missions", str(folder), "a folder of mission files")
        self._folder = folder

    def _files(self) -> dict[str, Path]:
        own: Sequence[Path] = sorted(self._folder.glob("*.yaml")) if self._folder is not None else ()
        return config_files.shipped("missions") | {path.stem: path for path in own}

    def listed(self) -> list[dict[str, str]]:
        """Return name and description of each."""
        return [{"name": name, "description": _description(path)} for name, path in self._files().items()]

    def text_of(self, name: str) -> str:
        """Return the text of one.

        Raises:
            ConfigurationError: there is none of this name, or it cannot be read.
        """
        file = self._files().get(name)
        if file is None:
            raise ConfigurationError("mission", repr(name), "a mission of the list")
        return user_files.read_text(file, "a mission file")


def _description(file: Path) -> str:
    try:
        content = yaml_file.parse(file)
    except SuiteError as error:
        return str(error)
    return str(content.get("description", "")) if isinstance(content, dict) else ""
