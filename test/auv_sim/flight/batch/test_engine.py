"""The batch engine against `closed_loop`: tracks to 1e-9, some of whole missions, and their figures."""

from __future__ import annotations

import dataclasses
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current
from auv_path_following import config_files, vehicle
from auv_path_following.control.derivative import DerivativeConfig
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.approach import ApproachConfig
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.missions import mission_file
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.judge import judged
from auv_sim.flight.run_record import Run
from auv_sim.flight.scenario import Scenario
from auv_sim.sim_parameters import SUITE
from auv_sim.vehicle import sea
from auv_sim.vehicle.remus import PlantState

CURRENT = Current(0.1, 0.2)
ASIDE = PlantState(-35.0, 28.0, 2.5, 1.2, 0.1, -0.05)
#: The laws alone; and a start from which guidance leads to the path first.
BARE = {"approach": ApproachConfig(enabled=False)}
FAR = PlantState(124.0, 301.0, 1.344, 1.2, 0.1, -0.05)
#: Flights that between them take every branch of every law: name -> arguments of `scenario`. Each law of
#: guidance has one controller: a further pair would be compiled, which takes longer than its flight.
FLIGHTS = {
    "robust, aside": {"initial": ASIDE, "current": CURRENT, "time_limit": 900.0, "guidance": BARE},
    "approach": {"initial": FAR, "current": CURRENT, "mission": "course_fermat", "time_limit": 300.0},
    "paper": {"params": "paper", "current": CURRENT, "time_limit": 900.0},
    "paper, corners cut late": {"guidance": BARE, "params": "paper", "mode": "off", "initial": ASIDE},
    "table 2, limit cycle": {"params": "paper", "hull": "remus100_table2", "guidance": BARE,
                             "initial": ASIDE},
    "weak rudder": {"hull": "remus100_mismatch", "controller_model": "remus100", "current": CURRENT},
    "ilos, smc": {"params": "paper", "guidance": {"law": "ilos"}, "autopilot": {"controller": "smc"},
                  "controller_model": "remus100_table2"},
    "ilos, smc, shaped": {"guidance": {"law": "ilos", **BARE}, "autopilot": {"controller": "smc"},
                          "current": CURRENT, "initial": ASIDE},
    "filtered dr/dt": {"autopilot": {"derivative": DerivativeConfig(bandwidth=4.0)},
                       "initial": ASIDE, "guidance": BARE},
    "los, pid": {"params": "paper", "guidance": {"law": "los"}, "autopilot": {"controller": "pid"},
                 "current": CURRENT},
    "no compensation": {"guidance": {"compensate_current": False}, "current": CURRENT},
    "circles everywhere, 8 Hz": {"mode": "all", "step": 0.125, "time_limit": 900.0},
    "50 Hz": {"step": 0.02, "mission": "course_clothoid", "time_limit": 130.0},
    "course_fermat": {"mission": "course_fermat", "current": CURRENT, "time_limit": 900.0},
    **{f"course_{kind}": {"mission": f"course_{kind}", "current": CURRENT}
       for kind in ("linear", "circular", "dubins", "spline")},
    "search_spiral": {"mission": "search_spiral"},
    "figure_of_eight": {"mission": "figure_of_eight"},
    "laps, circles everywhere": {"mission": "loiter", "mode": "all"},
}  # fmt: skip


def scenario(
    params="robust", mission="paper_composite", hull="remus100", controller_model=None, mode=None, **changes
) -> Scenario:
    told = params_file.load(config_files.find("params", params), SUITE)
    guidance, autopilot = told[topics.GUIDANCE].guidance, told[topics.AUTOPILOT].autopilot
    if mode is not None:
        guidance = dataclasses.replace(guidance, switching=SwitchingConfig(mode=mode, radius=5.2))
    loaded = mission_file.load(mission)
    return Scenario(
        path=loaded.path,
        vehicle=vehicle.load(hull),
        thrust=loaded.thrust,
        guidance=dataclasses.replace(guidance, **changes.pop("guidance", {})),
        observer=told[topics.OBSERVER].observer,
        autopilot=dataclasses.replace(autopilot, **changes.pop("autopilot", {})),
        controller_vehicle=vehicle.load(controller_model) if controller_model else None,
        **({"time_limit": 160.0} | changes),
    )


def largest_difference(run: Run, other: Run) -> float:
    assert run.steps == other.steps
    assert np.isfinite(run.x).all()
    both = ((getattr(run, field.name), getattr(other, field.name)) for field in dataclasses.fields(Run))
    return max(float(np.max(np.abs(np.nan_to_num(one) - np.nan_to_num(two)))) for one, two in both)


@pytest.mark.parametrize("name", FLIGHTS)
def test_a_flight_is_that_of_the_closed_loop(name: str) -> None:
    told = scenario(**FLIGHTS[name])
    reference = closed_loop.fly(told)
    assert largest_difference(engine.track(told), reference) < 1e-9

    flights, wanted = engine.fly([told]), judged(reference, told)
    for figure, value in wanted.items():
        found = getattr(flights, figure)[0]
        assert found == pytest.approx(value, rel=1e-9, abs=1e-9, nan_ok=True), figure


def test_no_lap_is_skipped() -> None:
    told = scenario(mission="loiter", mode="all", time_limit=600.0)
    flights = engine.fly([told])
    assert flights.completed[0]
    assert flights.duration[0] == pytest.approx(told.path.length / 2.0, rel=0.1)


def test_a_second_approach_is_planned_on_the_way() -> None:
    """Turns of 2 m, tighter than the hull can make: it is carried off its approach."""
    told = scenario(initial=FAR, time_limit=60.0, guidance={"approach": ApproachConfig(radius=2.0)})
    reference = closed_loop.fly(told)
    assert np.abs(np.diff(np.hypot(reference.xe, reference.ye))).max() > 1.9  # P has jumped to the vehicle
    assert largest_difference(engine.track(told), reference) < 1e-9
    assert engine.fly([told]).rms_distance[0] == pytest.approx(judged(reference, told)["rms_distance"])


def different(count: int) -> list[Scenario]:
    missions = ("paper_composite", "course_fermat", "course_dubins")
    return [
        scenario(mission=missions[k % 3], current=Current(0.02 * k, -0.01 * k), time_limit=60.0 + 10.0 * k)
        for k in range(count)
    ]


def as_columns(flights) -> dict[str, list]:
    return {field.name: getattr(flights, field.name).tolist() for field in dataclasses.fields(flights)}


def test_a_flight_does_not_depend_on_the_others() -> None:
    told = different(9)
    together = engine.fly(told)
    threaded = engine.fly(told, threads=3)
    assert repr(as_columns(together)) == repr(as_columns(threaded))
    for k in (0, 4, 8):
        alone = engine.fly([told[k]])
        assert alone.rms_distance[0] == together.rms_distance[k]
        assert alone.last_x[0] == together.last_x[k]


def test_every_flight_is_reported_when_it_is_done() -> None:
    told, steps = different(3), []
    flights = engine.fly(told, done=steps.append)
    assert steps == flights.steps.tolist()


def test_a_thinned_track_holds_every_so_manieth_row() -> None:
    told = different(1)[0]
    whole, thinned = engine.track(told), engine.track(told, every=7)
    assert thinned.steps == math.ceil(whole.steps / 7)
    assert largest_difference(thinned, whole.select(slice(None, None, 7))) == 0.0


def test_the_time_limit_ends_a_flight_that_has_not_arrived() -> None:
    flights = engine.fly([scenario(time_limit=10.0)])
    assert not flights.completed[0] and flights.finite[0]
    assert flights.steps[0] == 201 and flights.duration[0] == pytest.approx(10.0)


def test_late_figures_count_from_where_the_path_is_joined() -> None:
    told = scenario(initial=PlantState(-20.0, 15.0, 0.0, 1.9, 0.0, 0.0), time_limit=120.0)
    flights, run = engine.fly([told]), engine.track(told)
    distance = told.path.distance(run.x, run.y, run.subpath(told.path.n))
    first = int(np.argmax((distance <= 1.0) & (run.s > 0.0)))
    assert 100 < first < run.steps - 100
    assert flights.time_to_path[0] == pytest.approx(first * told.step)
    assert flights.late_largest_distance[0] == pytest.approx(distance[first:].max())
    assert flights.late_rms_distance[0] == pytest.approx(np.sqrt(np.mean(distance[first:] ** 2)))
    assert flights.largest_distance[0] == pytest.approx(distance.max())
    assert distance.max() > 6.0


def test_a_flight_that_never_joins_the_path_has_no_late_figures() -> None:
    flights = engine.fly([scenario(initial=PlantState(0.0, 80.0, 0.0, 1.9, 0.0, 0.0), time_limit=5.0)])
    for figure in ("late_rms_distance", "late_largest_distance", "time_to_path"):
        assert np.isnan(getattr(flights, figure)[0])
    assert flights.flown_share[0] == 0.0


def test_a_state_that_runs_away_ends_the_flight() -> None:
    remus = vehicle.load("remus100")
    assert remus.hull is not None
    wild = dataclasses.replace(remus, hull=dataclasses.replace(remus.hull, Yvv=-1e9, Nvv=3e9))
    start = PlantState(-20.0, 20.0, 0.785, 1.9, 1.0, 0.0)
    told = dataclasses.replace(scenario(), vehicle=wild, initial=start, controller_vehicle=remus)
    flights = engine.fly([told])
    assert not flights.finite[0] and not flights.completed[0]
    assert flights.steps[0] < 100


def test_what_cannot_be_flown_is_refused() -> None:
    with pytest.raises(ConfigurationError, match="thrust: found 0, expected a number greater than 0"):
        engine.fly([dataclasses.replace(scenario(), thrust=0.0)])
    ghost = dataclasses.replace(
        vehicle.load("remus100"),
        hull=None,
        cruise=vehicle.Cruise(thrust=6.0, speed=2.0),
        turning=vehicle.Turning(radius=6.0),
    )
    with pytest.raises(ConfigurationError, match="hull: found nothing"):
        engine.fly([dataclasses.replace(scenario(), vehicle=ghost)])


#: Seas, and what takes their every branch: two Runge-Kutta steps a step, gains that swing the rudder.
SEAS = {
    **{name: {"name": name} for name in config_files.shipped("seas")},
    "rough, 12.5 Hz": {"name": "rough", "step": 0.08, "current": CURRENT},
    "rough, paper": {"name": "rough", "params": "paper"},
}


def at_sea(name="rough", seed=5, **changes) -> Scenario:
    return dataclasses.replace(scenario(**({"time_limit": 90.0} | changes)), sea=sea.load(name), seed=seed)


@pytest.mark.parametrize("name", SEAS)
def test_a_flight_at_sea_is_that_of_the_closed_loop(name: str) -> None:
    told = at_sea(**SEAS[name])
    reference = closed_loop.fly(told)
    assert largest_difference(engine.track(told), reference) == 0.0

    flights, wanted = engine.fly([told]), judged(reference, told)
    for figure, value in wanted.items():
        found = getattr(flights, figure)[0]
        assert found == pytest.approx(value, rel=1e-9, abs=1e-9, nan_ok=True), figure


def test_a_flight_at_sea_does_not_depend_on_the_others() -> None:
    told = [at_sea(seed=k, time_limit=20.0) for k in range(4)]
    told.insert(2, dataclasses.replace(told[0], sea=None))
    forwards, backwards = engine.fly(told), engine.fly(told[::-1], threads=2)
    assert forwards.last_x.tolist() == backwards.last_x.tolist()[::-1]
    assert len(set(forwards.last_x.tolist())) == 5


def test_a_flight_that_lasts_longer_than_its_random_numbers_is_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = at_sea(time_limit=20.0)
    whole, figures = engine.track(told, every=3), engine.fly([told])
    monkeypatch.setattr(engine, "_likely_steps", lambda *_: 150)
    assert largest_difference(engine.track(told, every=3), whole) == 0.0
    assert repr(as_columns(engine.fly([told]))) == repr(as_columns(figures))


def test_no_scenarios_no_flights() -> None:
    assert len(engine.fly([])) == 0


def test_a_short_line_is_flown_to_its_end() -> None:
    told = dataclasses.replace(scenario(), path=CompositePath([Line(0.0, 0.0, 5.0, 0.0)]))
    flights = engine.fly([told])
    assert flights.completed[0] and flights.progress[0] == 1.0
    assert flights.last_x[0] == pytest.approx(5.0, abs=0.2)


def test_without_numba_the_flights_are_the_same() -> None:
    """Everything in a process that cannot find it: every law, twelve seconds of each flight."""
    program = (
        "import sys; sys.modules['numba'] = None; sys.path.insert(0, sys.argv[1])\n"
        "from test_engine import *; from auv_sim.flight.batch.compiled import COMPILED\n"
        "assert not COMPILED\n"
        "for name, told in FLIGHTS.items():\n"
        "    told = scenario(**told | {'time_limit': 12.0})\n"
        "    assert largest_difference(engine.track(told), closed_loop.fly(told)) < 1e-9, name\n"
        "print(engine.fly([told], threads=2).steps[0])\n"
    )
    command = [sys.executable, "-c", program, str(Path(__file__).parent)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr[-500:]
    assert int(done.stdout) > 200
