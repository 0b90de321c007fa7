"""The batch engine in three dimensions against `closed_loop`: tracks and figures to 1e-9."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SpatialCurrent
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.flight_figures import SpatialFlights
from auv_sim.flight.batch.judge import judged
from auv_sim.flight.run_record import SpatialRun
from auv_sim.flight.scenario import Scenario
from auv_sim.vehicle.hulls.rigid_body import body_at

UPWELLING = SpatialCurrent(0.1, 0.2, 0.05)
#: Off the path, below it, bow down, heading back.
ASIDE = body_at(-10.0, 12.0, 14.0, 0.0, -0.3, 2.8, 1.2)
FLIGHTS: dict[str, dict[str, Any]] = {
    "ramps": {"mission": "paper_ramps", "time_limit": 200.0},
    "ramps, aside": {"mission": "paper_ramps", "initial": ASIDE, "time_limit": 60.0},
    "helix": {"mission": "helix", "time_limit": 120.0},
    "survey": {"mission": "survey_3d", "time_limit": 100.0},
    "a planar path": {"mission": "course_fermat", "time_limit": 60.0},
}


def scenario(mission: str = "helix", hull: str = "remus100_6dof", **changes: Any) -> Scenario:
    loaded = mission_file.load(mission)
    asked = {"thrust": 6.48, "current": UPWELLING} | changes
    return Scenario(path=loaded.path, spatial=loaded.spatial, vehicle=vehicle.load(hull), **asked)


def largest_difference(run: SpatialRun, other: SpatialRun) -> float:
    assert run.steps == other.steps and np.isfinite(run.z).all()
    names = [field.name for field in dataclasses.fields(SpatialRun)]
    pairs = ((np.nan_to_num(getattr(run, name)), np.nan_to_num(getattr(other, name))) for name in names)
    return max(float(np.abs(one - two).max()) for one, two in pairs)


@pytest.mark.parametrize("name", FLIGHTS)
def test_a_flight_is_that_of_the_closed_loop(name: str) -> None:
    asked = scenario(**FLIGHTS[name])
    reference = closed_loop.fly(asked)
    assert isinstance(reference, SpatialRun)
    assert largest_difference(engine.track(asked), reference) < 1e-9
    flights, wanted = engine.fly([asked]), judged(reference, asked)
    assert set(wanted) == {field.name for field in dataclasses.fields(SpatialFlights)}
    for figure, value in wanted.items():
        found = getattr(flights, figure)[0]
        assert found == pytest.approx(value, rel=1e-9, abs=1e-9, nan_ok=True), figure


def test_planar_flights_among_them_keep_their_figures() -> None:
    planar = Scenario(
        path=mission_file.load("course_linear").path,
        vehicle=vehicle.load("remus100"),
        thrust=3.86,
        time_limit=20.0,
    )
    deep = scenario(time_limit=20.0)
    mixed, alone = engine.fly([planar, deep, planar], threads=2), engine.fly([planar])
    assert not isinstance(alone, SpatialFlights) and isinstance(mixed, SpatialFlights)
    for field in dataclasses.fields(alone):
        one, two = getattr(alone, field.name)[0], getattr(mixed, field.name)[2]
        assert np.array_equal(np.atleast_1d(one), np.atleast_1d(two)[: np.size(one)], equal_nan=True)
    assert np.isnan(mixed.rms_depth_error).tolist() == [True, False, True]


def test_a_depth_error_has_the_size_of_the_offset() -> None:
    """Started 3 m too deep on the level line that the helix begins with."""
    asked = scenario(time_limit=2.0, current=SpatialCurrent(0.0, 0.0, 0.0))
    x, y, z, _, chi = asked.spatial.start_pose  # type: ignore[union-attr]
    below = dataclasses.replace(asked, initial=body_at(x, y, z + 3.0, 0.0, 0.1, chi, 1.9))
    flights = engine.fly([below])
    assert flights.largest_depth_error[0] == pytest.approx(3.0, abs=0.2)  # type: ignore[attr-defined]
    assert flights.largest_distance[0] == pytest.approx(3.0, abs=0.2)
    assert flights.largest_pitch[0] >= np.degrees(0.1) - 1e-9  # type: ignore[attr-defined]


def test_what_cannot_be_flown_is_refused() -> None:
    deep = scenario()
    with pytest.raises(ConfigurationError, match="expected stern planes"):
        engine.fly([deep, dataclasses.replace(deep, vehicle=vehicle.load("remus100"))])
    with pytest.raises(ConfigurationError, match=r"at least .* m/s, below which the planes hold no depth"):
        engine.fly([deep, dataclasses.replace(deep, thrust=0.2)])
