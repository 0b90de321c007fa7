"""The 60 flights of the golden tracks: what is flown. `golden_tracks` flies, stores and compares them."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.values.types import Current
from auv_path_following import config_files, vehicle
from auv_path_following.curves.composite import CompositePath
from auv_path_following.missions import mission_file
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import CRUISE, SUITE
from auv_sim.studies.settings_changes import changed
from auv_sim.vehicle import sea
from auv_sim.vehicle.remus import PlantState
from hulls import STABLE, drawn

THRUST = 6.48
#: Every flaw that a sea can have, at rates that half a minute shows.
EVERY_FLAW = str(Path(__file__).parent / "data" / "sea.yaml")


@dataclass(frozen=True, kw_only=True)
class Flight:
    """One flight, by the names of its files and what differs from them.

    Attributes:
        path: a shipped mission, or a key of `ROUTES`.
        start: where it begins, from the path's start: ahead, to starboard (m), heading (deg), surge (m/s).
        gains: settings that differ from the parameter file: ``{"guidance.law": "los"}``.
        hull, controller: a vehicle file or a key of `_HULLS`; controller None: the plant's hull.
        time: the flight's time limit, s.
    """

    path: str
    params: str = "robust"
    gains: Mapping[str, Any] = field(default_factory=dict)
    start: tuple[float, float, float, float] = (0.0, 0.0, 0.0, CRUISE)
    current: tuple[float, float] = (0.0, 0.0)
    sea: str | None = None
    seed: int = 0
    hull: str = "remus100"
    controller: str | None = None
    thrust: float = THRUST
    step: float = 0.05
    time: float = 50.0

    def scenario(self) -> Scenario:
        """Return what `closed_loop` and the batch engine fly."""
        path, parameters = _path(self.path), _parameters(self.params)
        configs = {
            "guidance": parameters[topics.GUIDANCE].guidance,
            "observer": parameters[topics.OBSERVER].observer,
            "autopilot": parameters[topics.AUTOPILOT].autopilot,
        }
        for name, value in self.gains.items():
            part, _, rest = name.partition(".")
            configs[part] = changed(configs[part], {rest: value}, name)
        x, y, chi = path.start_pose
        ahead, aside, turned, surge = self.start
        x += ahead * math.cos(chi) - aside * math.sin(chi)
        y += ahead * math.sin(chi) + aside * math.cos(chi)
        return Scenario(
            path=path,
            vehicle=_hull(self.hull),
            thrust=self.thrust,
            initial=PlantState(x, y, chi + math.radians(turned), surge, 0.0, 0.0),
            current=Current(*self.current),
            sea=None if self.sea is None else sea.load(self.sea),
            seed=self.seed,
            step=self.step,
            controller_vehicle=None if self.controller is None else _hull(self.controller),
            time_limit=self.time,
            **configs,
        )


_CORNERS = [[0, 0], [35, 0], [60, 25], [60, 60], [30, 75]]


def _course(kind: str, closed: bool = False, **keys: Any) -> dict[str, Any]:
    return {"waypoints": {"points": _CORNERS, "smoothing": {"kind": kind, **keys}, "closed": closed}}


def _segments(*segments: dict[str, Any]) -> dict[str, Any]:
    return {"segments": list(segments)}


def _line(north: float, east: float, length: float, course: float) -> dict[str, Any]:
    return {"line": {"start": [north, east], "length": length, "course_deg": course}}


#: Short missions beside the shipped ones; every kind of segment and of corner within a minute.
ROUTES: dict[str, dict[str, Any]] = {
    "line": _segments(_line(0, 0, 200, 30)),
    "arc": _segments({"arc": {"centre": [0, 0], "radius": 20, "from_deg": 90, "to_deg": -200}}),
    "line and arc": _segments(
        _line(0, 0, 15, 0), {"arc": {"centre": [15, 20], "radius": 20, "from_deg": -90, "to_deg": 0}}
    ),
    "fermat": _segments(
        {"fermat": {"start": [0, 0], "course_deg": 20, "scale": 40, "theta_end": 1.2, "turn": -1}}
    ),
    "fermat mirrored": _segments(
        {"fermat_mirrored": {"end": [0, 0], "course_deg": 20, "scale": 40, "theta_end": 1.2, "turn": 1}}
    ),
    "polynomial": _segments({"polynomial": {"north": [0, 80, -30, 10], "east": [0, 0, 40, 30, -20]}}),
    "clothoid": _segments(
        {
            "clothoid": {
                "start": [0, 0], "course_deg": 45, "length": 90,
                "start_curvature": 0.05, "end_curvature": -0.06,
            }
        }
    ),
    "spline": _segments({"spline": {"points": _CORNERS, "start_course_deg": 10, "end_course_deg": 200}}),
    "inner spiral": {"spiral": {"centre": [5, 5], "inner_radius": 8, "spacing": 8, "turns": 1.5, "turn": -1}},
    "reversed fermat": _course("fermat", radius=12) | {"reverse": True},
    "closed clothoids": _course("clothoid", closed=True, radius=9) | {"repeat": 2},
    "eight": {"figure_of_eight": {"centre": [0, 0], "radius": 10, "separation": 25}, "repeat": 2},
    "wgs84 survey": {
        "frame": "wgs84",
        "origin": {"latitude_deg": 63.447, "longitude_deg": 10.399},
        "survey": {
            "polygon": [[63.4480, 10.4000], [63.4484, 10.4000], [63.4484, 10.4008], [63.4480, 10.4008]],
            "spacing": 18,
            "heading_deg": 20,
            "smoothing": {"kind": "dubins", "radius": 9},
        },
    },
    "linear": _course("linear"),
    "circular": _course("circular", radius=10),
    "dubins": _course("dubins", radius=10),
    "clothoids": _course("clothoid", radius=9),
    "fermats": _course("fermat", radius=10),
    "spline through": _course("spline"),
}  # fmt: skip

_ADAPTIVE = {"guidance.ailos.adaptive.enabled": True}
_ILOS, _LOS = {"guidance.law": "ilos"}, {"guidance.law": "los"}
_PID = {"autopilot.controller": "pid"}
_SMC = {"autopilot.controller": "smc"}
_PLAIN = {"autopilot.reference.enabled": False}
_NO_APPROACH = {"guidance.approach.enabled": False}

#: Name -> flight. Numbers that are random here or there are drawn from seeds that the flight holds.
FLIGHTS: dict[str, Flight] = {
    # Kinds of segment and of corner.
    "line from 8 m beside": Flight(path="line", gains=_NO_APPROACH, start=(0, 8, 0, 1.9), time=40),
    "arc to port": Flight(path="arc"),
    "line and arc, paper": Flight(path="line and arc", params="paper", time=30),
    "fermat": Flight(path="fermat", time=30),
    "fermat mirrored": Flight(path="fermat mirrored", time=30),
    "polynomial": Flight(path="polynomial", current=(0.1, -0.1)),
    "clothoid": Flight(path="clothoid"),
    "clothoid, PID in a current": Flight(path="clothoid", gains=_PID, current=(-0.2, 0.1)),
    "spline": Flight(path="spline", current=(0.0, 0.2)),
    "spiral to port": Flight(path="inner spiral", time=60),
    "reversed fermat": Flight(path="reversed fermat", time=60),
    "closed clothoids, twice": Flight(path="closed clothoids", time=80),
    "eight, twice": Flight(path="eight", time=110),
    "survey in degrees": Flight(path="wgs84 survey", time=80),
    "corners": Flight(path="linear", time=85),
    "corners, paper": Flight(path="linear", params="paper", time=65),
    "corners, no circle": Flight(path="linear", gains={"guidance.switching.mode": "off"}, time=65),
    "corners, circle computed": Flight(
        path="linear", gains={"guidance.switching.radius": 0.0}, current=(0.2, 0.2), time=65
    ),
    "circles at all joints": Flight(
        path="circular", gains={"guidance.switching.mode": "all", "guidance.switching.radius": 4.0}, time=65
    ),
    "dubins": Flight(path="dubins", time=65),
    "clothoids": Flight(path="clothoids", time=65),
    "clothoids, LOS and SMC": Flight(path="clothoids", gains=_LOS | _SMC, time=65),
    "fermats": Flight(path="fermats", params="rough", time=85),
    "spline through waypoints": Flight(path="spline through", time=65),
    # Shipped missions, their beginnings.
    "paper composite, past its corner": Flight(path="paper_composite", params="paper", time=165),
    "paper composite in a current": Flight(path="paper_composite", current=(0.1, 0.2), time=40),
    "course circular": Flight(path="course_circular", current=(-0.1, 0.1), time=90),
    "course fermat": Flight(path="course_fermat", time=90),
    "course spline": Flight(path="course_spline", time=60),
    "loiter": Flight(path="loiter", current=(0.2, 0.0), time=60),
    "search spiral": Flight(path="search_spiral", time=60),
    # Guidance laws.
    "adaptive look-ahead": Flight(path="linear", gains=_ADAPTIVE, current=(0.1, 0.1), time=65),
    "adaptive look-ahead from afar": Flight(
        path="line", gains=_ADAPTIVE | _NO_APPROACH, start=(-5, -15, 40, 1.2)
    ),
    "ILOS": Flight(path="linear", gains=_ILOS, current=(0.2, -0.1), time=65),
    "ILOS with sideslip": Flight(
        path="eight", gains=_ILOS | {"guidance.ilos.sideslip": True}, current=(0.1, 0.1), time=60
    ),
    "LOS": Flight(path="fermats", gains=_LOS, current=(0.2, -0.1), time=65),
    "LOS without sideslip": Flight(path="arc", gains=_LOS | {"guidance.los.sideslip": False}),
    "no compensation": Flight(
        path="line", gains={"guidance.compensate_current": False}, current=(0.2, -0.3), time=40
    ),
    "saturated virtual point": Flight(
        path="circular",
        gains={"guidance.virtual_point.k": 3.0, "guidance.virtual_point.saturation": 1.0} | _NO_APPROACH,
        start=(8, 3, 0, 1.9),
    ),
    # Controllers.
    "PID": Flight(path="circular", gains=_PID, time=60),
    "PID, plain reference": Flight(path="linear", gains=_PID | _PLAIN, current=(0.1, 0.1), time=60),
    "SMC": Flight(path="circular", gains=_SMC, time=60),
    "SMC, plain reference": Flight(path="linear", gains=_SMC | _PLAIN, time=60),
    "NISM, ks and a slow filter": Flight(
        path="linear", gains={"autopilot.nism.ks": 0.05, "autopilot.derivative.bandwidth": 4.0}, time=60
    ),
    "reference with limits given": Flight(
        path="linear",
        gains={
            "autopilot.reference.max_rate": 0.15, "autopilot.reference.max_acceleration": 0.1,
            "autopilot.reference.max_jerk": 0.2,
        },
        time=60,
    ),
    # Approaches.
    "approach from behind": Flight(path="circular", start=(-40, 15, 90, 1.0), time=80),
    "approach from ahead, from rest": Flight(path="line", start=(30, -10, 180, 0.0), time=80),
    "approach in a current, ILOS": Flight(
        path="line and arc", gains=_ILOS, start=(5, 25, -120, 1.9), current=(0.2, 0.1), time=80
    ),
    # Rates, hulls and controllers made for another hull.
    "10 Hz": Flight(path="circular", step=0.1, current=(0.1, 0.0), time=60),
    "50 Hz, little thrust": Flight(path="circular", step=0.02, thrust=3.0, time=25),
    "printed hull": Flight(path="circular", hull="remus100_table2", time=50),
    "stable hull": Flight(path="eight", hull="stable", time=50),
    "drawn hull": Flight(path="fermats", hull="drawn 3", current=(0.1, 0.1), time=60),
    "weak rudder, as on the first hull": Flight(
        path="linear", params="paper", hull="remus100_mismatch", controller="remus100", time=65
    ),
    "weak rudder, SMC of another hull": Flight(
        path="circular", gains=_SMC, hull="remus100_mismatch", controller="remus100_table2", time=50
    ),
    # Seas.
    "every flaw": Flight(path="circular", sea=EVERY_FLAW, seed=1, time=60),
    "every flaw, SMC, ILOS, approach": Flight(
        path="linear", gains=_SMC | _ILOS, sea=EVERY_FLAW, seed=2, start=(-20, 10, 60, 1.5), time=90
    ),
    "rough, its gains": Flight(path="fermats", params="rough", sea="rough", seed=3, time=90),
    "blue water, adaptive, other hull": Flight(
        path="eight", gains=_ADAPTIVE, sea="blue_water", seed=4, hull="remus100_mismatch",
        controller="remus100", time=50,
    ),
    "estuary, on the paper's path": Flight(
        path="paper_composite", params="paper", sea="estuary", current=(0.05, 0.0), seed=5, time=50
    ),
}  # fmt: skip

_HULLS = {"stable": STABLE, "drawn 3": drawn(3)}


def _hull(name: str) -> Vehicle:
    return _HULLS.get(name) or vehicle.load(name)


@cache
def _parameters(name: str) -> dict[str, Any]:
    return params_file.load(config_files.find("params", name), SUITE)


@cache
def _path(name: str) -> CompositePath:
    if name not in ROUTES:
        return mission_file.load(name).path
    with tempfile.TemporaryDirectory() as directory:
        file = Path(directory) / "mission.yaml"
        keys = {"version": 1, "name": name, "frame": "ned", "thrust": THRUST}
        yaml_file.dump(keys | ROUTES[name], file)
        return mission_file.load(str(file)).path
