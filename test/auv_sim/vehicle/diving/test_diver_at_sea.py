"""The vehicle that dives at sea: repeatable, in step with the one in the plane, and the same compiled."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialCommand, SpatialCurrent
from auv_path_following import config_files
from auv_sim.flight.batch import same_bits  # noqa: F401 - arithmetic of compiled code
from auv_sim.flight.batch.compiled import COMPILED, compiled, take_over_pure
from auv_sim.vehicle import sea
from auv_sim.vehicle import simulated as simulated_module
from auv_sim.vehicle.currents import CurrentConfig, Upwelling
from auv_sim.vehicle.diving.diver_at_sea import spatial_at_sea_of
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.draws import Draws
from auv_sim.vehicle.fins.actuator import RudderFlaws
from auv_sim.vehicle.hulls.rigid_body import body_at
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.simulated import vehicle_measure, vehicle_step
from hulls import DIVER

START = body_at(1.0, 2.0, 10.0, 0.0, 0.1, 0.3, 1.9)
COMMANDS = [
    SpatialCommand(0.1 * math.sin(0.3 * k), -0.05 + 0.05 * math.cos(0.2 * k), 6.0) for k in range(200)
]
CURRENT = SpatialCurrent(0.1, -0.2, 0.05)
_IN_FILE = sea.load(str(Path(__file__).resolve().parents[3] / "data" / "sea.yaml"))
_SCHEDULE = ((2.0, 0.05, 0.0, 0.02), (8.0, -0.05, 0.03, -0.02))
EVERYTHING = dataclasses.replace(_IN_FILE, current=dataclasses.replace(_IN_FILE.current, schedule=_SCHEDULE))

take_over_pure()


def flown(simulated: SimulatedDiver) -> list[str]:
    """All measurements as text, where NaN is equal to itself."""
    return [repr(simulated.advance(command, 0.05)) for command in COMMANDS]


def test_a_sea_with_nothing_in_it_leaves_the_hull_alone() -> None:
    at_sea = SimulatedDiver(DIVER, START, Sea(name="still"), current=CURRENT)
    ideal = SimulatedDiver(DIVER, START, current=CURRENT)
    for command in COMMANDS:
        seen, expected = at_sea.advance(command, 0.05), ideal.advance(command, 0.05)
        assert (seen.motion, seen.current) == (expected.motion, expected.current)
        assert (seen.water, seen.water_lock) == (expected.water, expected.water_lock)
        assert seen[3:6] == at_sea.ground_velocity == expected[3:6]
        assert (seen.rudder, seen.sternplanes) == (expected.rudder, expected.sternplanes)
        assert seen.navigation[2:] == pytest.approx(expected.navigation[2:], abs=1e-12)
        assert (seen.altitude, at_sea.truth) == (math.inf, ideal.truth)


@pytest.mark.parametrize("name", [*config_files.shipped("seas"), "everything"])
def test_a_seed_is_a_run_and_a_reset_begins_it_again(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    conditions = EVERYTHING if name == "everything" else sea.load(name)
    simulated = SimulatedDiver(DIVER, START, conditions, 4)
    first = flown(simulated)
    simulated.reset()
    assert flown(simulated) == first
    assert flown(SimulatedDiver(DIVER, START, conditions, 5)) != first
    monkeypatch.setattr(simulated_module, "_BLOCK", 7)
    assert flown(SimulatedDiver(DIVER, START, conditions, 4)) == first


def test_place_moves_the_hull_and_leaves_the_rest() -> None:
    simulated = SimulatedDiver(DIVER, START, EVERYTHING, 4)
    flown(simulated)
    before, rudder, sternplanes = simulated.state, simulated.rudder, simulated.sternplanes
    simulated.place(START)
    assert simulated.motion == START
    assert (simulated.rudder, simulated.sternplanes) == (rudder, sternplanes)
    assert simulated.state.navigator is before.navigator and simulated.state.sensors is before.sensors


@pytest.mark.parametrize("speed", [0.05, -0.05])
def test_upwelling_lifts_the_vehicle(speed: float) -> None:
    conditions = Sea(name="x", current=CurrentConfig(upwelling=Upwelling(mean=speed)))
    lifted, still = SimulatedDiver(DIVER, START, conditions), SimulatedDiver(DIVER, START)
    flown(lifted), flown(still)
    assert still.motion.z - lifted.motion.z == pytest.approx(10.0 * speed, abs=1e-9)
    assert lifted.current == (0.0, 0.0, -speed)


def test_the_constant_current_comes_on_top_and_may_change() -> None:
    simulated = SimulatedDiver(DIVER, START, EVERYTHING, 1)
    own = simulated.current
    simulated.constant_current = CURRENT
    assert simulated.current == pytest.approx(np.add(own, CURRENT))


def test_each_fin_has_its_own_flaws() -> None:
    late = Sea(name="x", rudder=RudderFlaws(dead_time=0.1), sternplanes=RudderFlaws(dead_time=0.3))
    simulated = SimulatedDiver(DIVER, START, late)
    moved: dict[str, int] = {}
    for k in range(10):
        simulated.advance(SpatialCommand(0.1, 0.1, 6.0), 0.05)
        for name in ("rudder", "sternplanes"):
            if getattr(simulated, name) != 0.0:
                moved.setdefault(name, k)
    assert moved == {"rudder": 2, "sternplanes": 6}


def test_thrust_varies() -> None:
    varied = SimulatedDiver(DIVER, START, Sea(name="x", thrust=NoiseConfig(bias=0.1)), 1)
    ideal = SimulatedDiver(DIVER, START)
    flown(varied), flown(ideal)
    assert varied.motion.ur != pytest.approx(ideal.motion.ur, abs=1e-4)
    assert varied.motion.ur == pytest.approx(ideal.motion.ur, abs=0.3)


def fly(config: Any, state: Any, commands: Any, seen: Any) -> Any:
    """Fly at sea; keep true and reported pose, velocities, height, fins and current of every step."""
    constant = SpatialCurrent(0.1, -0.2, 0.05)
    for k in range(len(seen)):
        command = SpatialCommand(commands[k, 0], commands[k, 1], commands[k, 2])
        state, s = vehicle_step(config, state, (command, constant, 1.0), 0.05)
        n, m, c = s.navigation, s.motion, s.current
        for i, value in enumerate((n.x, n.y, n.z, n.phi, n.theta, n.psi, n.q, n.r, m.x, m.y, m.z, m.ur,
                                   m.wr, s.u, s.v, s.w, s.water.wr, s.altitude, s.rudder, s.sternplanes,
                                   c.Vx, c.Vy, c.Vz)):  # fmt: skip
            seen[k, i] = value
    return state


@pytest.mark.skipif(not COMPILED, reason="Numba is not installed")
def test_compiled_as_in_python() -> None:
    """At sea with everything in it; it starts at the surface with satellite fixes and dives."""
    tables = []
    start = body_at(0.0, 0.0, 0.1, 0.0, -0.2, 0.3, 1.9)
    for arrays in (False, True):
        config, state = spatial_at_sea_of(DIVER, start, EVERYTHING, 4, Draws(0.05, 201, arrays))
        seen = np.empty((200, 23))
        state, _ = vehicle_measure(config, state, (SPATIAL_STOP, CURRENT, 1.0), 0.0)
        (compiled(fly) if arrays else fly)(config, state, np.array(COMMANDS), seen)
        tables.append(seen)
    assert np.isnan(tables[0][:, 13]).any() and np.isinf(tables[0][:, 17]).any()
    assert tables[1] == pytest.approx(tables[0], abs=1e-12, nan_ok=True)


@pytest.mark.parametrize(
    ("text", "place", "found", "expected"),
    [
        ("current: {schedule: [[0, 0, 0, 0], [0, 1, 1, 1]]}", "current.schedule", "0 after 0", "increase"),
        ("current: {schedule: [[0, 0, 0]]}", "current.schedule[0][3]", "nothing", "one more item"),
        ("current: {over_depth: [[5, 1], [2, 1]]}", "current.over_depth", "2 after 5", "increase"),
        ("current: {upwelling: {mean: 3}}", "current.upwelling.mean", "3", "at most 1"),
        ("bottom: {depth: -1}", "bottom.depth", "-1", "at least 0"),
        ("bottom: {waves: {length: 0}}", "bottom.waves.length", "0", "greater than 0"),
        ("sternplanes: {dead_time: 9}", "sternplanes.dead_time", "9", "at most 5"),
        ("sensors: {depth: {lag: -1}}", "sensors.depth.lag", "-1", "at least 0"),
        ("sensors: {altimeter: {range: 9}}", "sensors.altimeter.range", "an unknown key", "documented"),
        ("sensors: {water_track: {highest: 9}}", "sensors", "highest: 9 under water_track", "bottom_track"),
    ],
)
def test_a_mistake_is_refused_with_its_key(
    tmp_path: Path, text: str, place: str, found: str, expected: str
) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text(f"name: x\n{text}\n", encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        sea.load(str(file))
    assert (caught.value.where, found in caught.value.found) == (f"{file}: {place}", True)
    assert expected in caught.value.expected
