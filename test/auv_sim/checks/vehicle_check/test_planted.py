"""Each planted mistake is found by name, from samples alone; an honest vehicle is left in peace."""

from __future__ import annotations

import json
import math
import random
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import flip_yaw, quaternion_of_yaw, yaw_of_quaternion
from auv_path_following import vehicle
from auv_sim.checks.vehicle_check import verdict_report
from auv_sim.checks.vehicle_check.items.all_items import check, mistakes
from auv_sim.checks.vehicle_check.planted import PLANTED, START, Planted, PlantedVehicle
from auv_sim.checks.vehicle_check.samples import Endpoint, OdometrySample, Recording, Value, WaterSample
from auv_sim.checks.vehicle_check.verdict import Level, Mistake
from auv_sim.checks.vehicle_check.wiggle import END, FAREWELL, Wiggle

REMUS = vehicle.load("remus100")
HONEST = PLANTED[0]
BEGIN, STEP, LATENCY = 100.0, 0.05, 0.01


def endpoints(planted: Planted) -> tuple[Endpoint, ...]:
    latched = planted.latched_commands
    states = () if planted.bare else (topics.RUDDER_STATE,)
    return (
        *(Endpoint(t.name, True, t.type, "driver") for t in (topics.ODOM, *states)),
        Endpoint(topics.WATER_VELOCITY.name, True, planted.water_type, "driver"),
        *(
            Endpoint(t.name, False, t.type, "driver", transient_local=latched)
            for t in (topics.RUDDER_CMD, topics.THRUST_CMD)
        ),
    )


def record(
    planted: Planted, wiggle: bool = True, heading: float = START.psi, state: bool = True
) -> Recording:
    """What the listener would have heard of the small test, without the wire."""
    driver = PlantedVehicle(planted, REMUS, BEGIN)
    driver.plant.place(START._replace(psi=heading))
    recording = Recording(duration=END, sim_time=True, wiggled=wiggle, endpoints=endpoints(planted))
    for k in range(round((END + FAREWELL) / STEP)):
        now = BEGIN + k * STEP
        for odom, water, rudder in driver.live(now):
            heard = odom.received + LATENCY
            recording.odom.append(odom._replace(received=heard))
            if planted.water_type == topics.WATER_VELOCITY.type:
                recording.water.append(water._replace(received=heard))
            if state and not planted.bare:
                recording.rudder_state.append(Value(heard, rudder))
        if wiggle:
            command = Wiggle.of(REMUS).at(now - BEGIN)
            recording.rudder_cmd.append(Value(now, command.rudder))
            recording.thrust_cmd.append(Value(now, command.thrust))
            driver.order(command)
    return recording


def found(recording: Recording) -> set[Mistake]:
    return mistakes(check(recording, REMUS))


@pytest.mark.parametrize("planted", PLANTED, ids=lambda planted: planted.name)
def test_the_mistake_is_named_and_no_other(planted: Planted) -> None:
    verdicts = check(record(planted), planted.file(REMUS))
    assert mistakes(verdicts) == ({planted.mistake} if planted.mistake else set())


def test_there_are_enough_of_them() -> None:
    assert len({planted.mistake for planted in PLANTED} - {None}) >= 25


def test_an_honest_vehicle_passes_every_item() -> None:
    assert {verdict.level for verdict in check(record(HONEST), REMUS)} == {Level.PASS}


@pytest.mark.parametrize("name", ["remus100", "remus100_mismatch", "remus100_table2"])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_turning_and_cruise_are_enough_for_the_sign_of_any_hull(
    name: str, sign: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    hull = vehicle.load(name)
    monkeypatch.setitem(record.__globals__, "REMUS", hull)
    (bare,) = (planted for planted in PLANTED if planted.name == "bare")
    turned = replace(bare, command=lambda c: c._replace(rudder=sign * c.rudder))
    verdicts = check(record(turned), turned.file(hull))
    assert mistakes(verdicts) == (set() if sign > 0.0 else {Mistake.RUDDER_SIGN})
    assert {v.level for v in verdicts} <= {Level.PASS, Level.FAIL}


def test_what_the_small_test_could_not_judge_does_not_pass() -> None:
    (noisy,) = (planted for planted in PLANTED if planted.name == "bare-noisy")
    recording = record(noisy)
    verdicts = check(recording, noisy.file(REMUS))
    assert {v.level for v in verdicts if v.mistake is not None} == {Level.UNKNOWN}
    assert verdict_report.as_dict(verdicts, recording)["passed"] is False
    assert verdict_report.conclusion(verdicts).endswith(
        "not judged: not fit for a mission until all of it is judged"
    )
    untouched = replace(recording, wiggled=False)
    assert mistakes(check(untouched, noisy.file(REMUS))) == set()


@pytest.mark.parametrize("name", ["rudder-sign", "rudder-degrees", "rudder-slow", "dead-time"])
def test_the_rudder_is_judged_by_the_yaw_rate_where_nobody_measures_it(name: str) -> None:
    (planted,) = (planted for planted in PLANTED if planted.name == name)
    assert found(record(planted, state=False)) == {planted.mistake}


def test_a_vehicle_at_rest_is_not_judged_by_what_it_cannot_show() -> None:
    verdicts = {verdict.item: verdict.level for verdict in check(record(HONEST, wiggle=False), REMUS)}
    assert Level.FAIL not in verdicts.values()
    unknown = {item for item, level in verdicts.items() if level is Level.UNKNOWN}
    assert {"odom: yaw against course", "rudder: sign and scale", "rudder: dead time"} <= unknown


def as_ned(recording: Recording) -> Recording:
    """The same vehicle as NED/FRD, said so."""

    def odom(s: OdometrySample) -> OdometrySample:
        z, w = quaternion_of_yaw(flip_yaw(yaw_of_quaternion(*s.orientation)))
        turned = {"x": s.y, "y": s.x, "orientation": (0.0, 0.0, z, w), "v": -s.v, "r": -s.r}
        return s._replace(frame="auv1/map_ned", child="auv1/base_link_frd", **turned)

    def water(s: WaterSample) -> WaterSample:
        return s._replace(frame="auv1/base_link_frd", v=-s.v)

    return replace(recording, odom=[*map(odom, recording.odom)], water=[*map(water, recording.water)])


def test_an_honest_ned_vehicle_passes_as_well() -> None:
    assert {verdict.level for verdict in check(as_ned(record(HONEST)), REMUS)} == {Level.PASS}


def test_ned_throughout_under_enu_names_shows_as_the_rudder() -> None:
    ned = as_ned(record(HONEST))
    lying = [s._replace(frame="map", child="base_link") for s in ned.odom]
    water = [s._replace(frame="base_link") for s in ned.water]
    assert found(replace(ned, odom=lying, water=water)) == {Mistake.RUDDER_SIGN}


SOME = settings(max_examples=12, suppress_health_check=[HealthCheck.too_slow])


@SOME
@given(st.floats(-math.pi, math.pi), st.integers(0, 1000))
def test_noise_is_no_mistake_whatever_the_heading(heading: float, seed: int) -> None:
    dice = random.Random(seed)
    recording = record(HONEST, heading=heading)

    def noisy(s: OdometrySample) -> OdometrySample:
        yaw = yaw_of_quaternion(*s.orientation) + dice.gauss(0.0, math.radians(1.0))
        z, w = quaternion_of_yaw(yaw)
        return s._replace(
            x=s.x + dice.gauss(0.0, 0.03), y=s.y + dice.gauss(0.0, 0.03), orientation=(0.0, 0.0, z, w),
            u=s.u + dice.gauss(0.0, 0.03), v=s.v + dice.gauss(0.0, 0.03), r=s.r + dice.gauss(0.0, 0.01),
        )  # fmt: skip

    assert found(replace(recording, odom=[*map(noisy, recording.odom)])) == set()


@SOME
@given(
    st.floats(-math.pi, math.pi),
    st.sampled_from(
        ["yaw-ned", "yaw-sign", "yaw-rate-sign", "swapped-axes", "velocity-in-world", "sway-sign"]
    ),
)
def test_a_mix_up_of_frames_is_found_whatever_the_heading(heading: float, name: str) -> None:
    (planted,) = (planted for planted in PLANTED if planted.name == name)
    assert found(record(planted, heading=heading)) == {planted.mistake}


def test_the_report_keeps_names_for_programs() -> None:
    (planted,) = (planted for planted in PLANTED if planted.name == "yaw-ned")
    recording = record(planted)
    told = json.loads(json.dumps(verdict_report.as_dict(check(recording, REMUS), recording)))
    assert told["passed"] is False
    assert {item["mistake"] for item in told["items"] if item["verdict"] == "fail"} == {
        "YAW_OTHER_CONVENTION"
    }
    assert "not fit" in verdict_report.conclusion(check(recording, REMUS))


def test_nothing_heard_at_all_is_a_verdict_too() -> None:
    assert found(Recording()) == {Mistake.MISSING_TOPIC, Mistake.DEAF}


def test_two_drivers_on_one_topic_are_told() -> None:
    recording = record(HONEST)
    twice = (*recording.endpoints, Endpoint("odom", True, topics.ODOM.type, "another"))
    assert found(replace(recording, endpoints=twice)) == {Mistake.TWO_PUBLISHERS}
