"""Each mistake in the vertical plane is found by name, and an honest vehicle that dives passes."""

from __future__ import annotations

import pytest

from auv_msgs_py.contract import topics
from auv_path_following import vehicle
from auv_sim.checks.vehicle_check.items.all_items import check, mistakes
from auv_sim.checks.vehicle_check.planted_divers import PLANTED_DIVERS, PlantedDiver
from auv_sim.checks.vehicle_check.planted_diving_vehicle import PlantedDivingVehicle
from auv_sim.checks.vehicle_check.samples import Endpoint, Recording, Value
from auv_sim.checks.vehicle_check.verdict import Level, Mistake
from auv_sim.checks.vehicle_check.wiggle import FAREWELL
from auv_sim.checks.vehicle_check.wiggle_dive import END, DivingWiggle, danger
from auv_sim.vehicle import sea as seas
from auv_sim.vehicle.sea import Sea

REMUS = vehicle.load("remus100_6dof")
BEGIN, STEP, LATENCY = 100.0, 0.05, 0.01


def endpoints(planted: PlantedDiver) -> tuple[Endpoint, ...]:
    published = [topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_STATE]
    published += [topics.STERNPLANE_STATE] * (not planted.bare)
    published += [topics.ALTITUDE] * (planted.altitude is not None)
    heard = (topics.RUDDER_CMD, topics.STERNPLANE_CMD, topics.THRUST_CMD)
    return (
        *(Endpoint(t.name, True, t.type, "driver") for t in published),
        *(Endpoint(t.name, False, t.type, "driver") for t in heard),
    )


def record(
    planted: PlantedDiver,
    hull: vehicle.Vehicle = REMUS,
    sea: Sea | None = None,
    seed: int = 0,
    latency: float = LATENCY,
) -> tuple[Recording, str]:
    """What the listener would have heard of the small test, without the wire; and what cut it short."""
    driver = PlantedDivingVehicle(planted, hull, BEGIN, sea, seed)
    recording = Recording(duration=END, sim_time=True, wiggled=True, endpoints=endpoints(planted))
    wiggle, cut_short = DivingWiggle(hull), ""
    for k in range(round((END + FAREWELL) / STEP)):
        now = BEGIN + k * STEP
        for s in driver.live(now):
            heard = now + latency
            recording.odom.append(s.odom._replace(received=heard))
            recording.water.append(s.water._replace(received=heard))
            recording.rudder_state.append(Value(heard, s.rudder))
            if s.planes is not None:
                recording.sternplane_state.append(Value(heard, s.planes))
            if s.altitude is not None:
                recording.altitude.append(s.altitude._replace(received=heard))
        command = wiggle.at(now - BEGIN, recording)
        cut_short = cut_short or danger(recording, recording.odom[0], hull)
        if cut_short:
            command = command._replace(rudder=0.0, sternplanes=0.0, thrust=0.0)
        recording.rudder_cmd.append(Value(now, command.rudder))
        recording.sternplane_cmd.append(Value(now, command.sternplanes))
        recording.thrust_cmd.append(Value(now, command.thrust))
        driver.order(command)
    return recording, cut_short


@pytest.mark.parametrize("planted", PLANTED_DIVERS, ids=lambda planted: planted.name)
def test_the_mistake_is_named_and_no_other(planted: PlantedDiver) -> None:
    recording, _ = record(planted)
    assert mistakes(check(recording, REMUS)) == ({planted.mistake} if planted.mistake else set())


NAMED = {planted.name: planted for planted in PLANTED_DIVERS}


@pytest.mark.parametrize("name", ["diver-ned", "diver-bare"])
def test_an_honest_diver_passes_in_a_rough_sea(name: str) -> None:
    recording, cut_short = record(NAMED[name], sea=seas.load("rough"), seed=1)
    assert mistakes(check(recording, REMUS)) == set()
    assert cut_short == ""


def test_a_vehicle_that_does_not_leave_the_surface_is_not_judged() -> None:
    verdicts = check(record(NAMED["diver-afloat"], sea=seas.load("rough"))[0], REMUS)
    assert mistakes(verdicts) == {Mistake.NOT_JUDGED}
    assert Level.FAIL not in {verdict.level for verdict in verdicts}
