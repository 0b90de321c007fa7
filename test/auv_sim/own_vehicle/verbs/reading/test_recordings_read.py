"""What is read of a recording: axes of its frame ids, silent commands, motion of its planes."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.contract.frames import Convention, FrameTable
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle as vehicle_file
from auv_sim.bags.content.recorded_commands import TimedCommands
from auv_sim.own_vehicle.identify.results.known_vehicle import known_hull
from auv_sim.own_vehicle.identify.time_grid import FOLLOWED, passage_of
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.own_vehicle.verbs.reading.fin_units import check_effect
from auv_sim.own_vehicle.verbs.reading.recordings_read import frames_with, motion_within, obeyed, read
from manoeuvre_bag import write_manoeuvres


def test_what_a_vehicle_does_without_commands_is_not_used(tmp_path: Path) -> None:
    vehicle = vehicle_file.load("remus100")
    flown = simulate(vehicle, None, program_file.load("two_minutes"))
    begin, end = flown.t[0] + 40.0, flown.t[0] + 46.0
    bag = write_manoeuvres(tmp_path / "bag", flown, silent=(begin, end))
    options = argparse.Namespace(topic=[], frame=[], unit=[], bag=[bag], namespace=None)
    (recorded,) = read(options, vehicle, known_hull(vehicle))
    data = recorded.plane
    for t in (data.t, data.water_t, data.rudder_t, data.thrust_t):
        assert not ((t > begin + 0.1) & (t < end - 0.1)).any()
        assert ((t > begin - 1.0) & (t < begin)).any() and ((t > end) & (t < end + 1.0)).any()
    assert recorded.silence == pytest.approx(6.0, abs=0.2)
    passage = passage_of(data, 0.0)
    starts = passage.times[:-1][passage.grid.begins]
    assert starts[1:] == pytest.approx([end + FOLLOWED], abs=0.3)


def test_a_silence_counts_while_the_odometry_runs(tmp_path: Path) -> None:
    vehicle = vehicle_file.load("remus100")
    flown = simulate(vehicle, None, program_file.load("two_minutes"))
    flown = flown._replace(t=flown.t + 100.0, water_t=flown.water_t + 100.0)
    silent = flown.t[0] + 3.0, flown.t[0] + 9.0
    bag = write_manoeuvres(tmp_path / "bag", flown, silent=silent, late=-10.0)
    options = argparse.Namespace(topic=[], frame=[], unit=[], bag=[bag], namespace=None)
    (recorded,) = read(options, vehicle, known_hull(vehicle))
    assert recorded.silence == pytest.approx(10.0, abs=0.2)


def test_a_command_that_is_sent_during_a_silence_of_another_holds_afterwards() -> None:
    changed = TimedCommands(np.array([0.0, 22.0, 24.0, 40.0, 62.0]), np.array([5.0, 6.0, 7.0, 8.0, 9.0]))
    kept = obeyed(changed, [(20.0, 26.0), (60.0, np.inf)])
    assert kept.t.tolist() == [0.0, 26.0, 40.0]
    assert kept.value.tolist() == [5.0, 7.0, 8.0]
    assert changed.t.tolist() == [0.0, 22.0, 24.0, 40.0, 62.0]


@pytest.mark.parametrize(("begin", "moves"), [(-5.0, True), (400.0, False)])
def test_commands_beside_the_odometry_are_no_motion_of_the_planes(begin: float, moves: bool) -> None:
    t = np.arange(0.0, 300.0, 0.05)
    commands = 0.2 * np.sign(np.sin(t))
    assert (motion_within(t + begin, commands, t) > 0.1) == moves


@pytest.mark.parametrize(
    ("name", "expected"), [("remus100", "a vehicle"), ("remus100_6dof", "a recording with sternplane_cmd")]
)
def test_a_unit_of_stern_planes_needs_stern_planes(name: str, expected: str) -> None:
    vehicle = vehicle_file.load(name)
    with pytest.raises(ConfigurationError, match=f"--unit sternplane_cmd: found deg, expected {expected}"):
        check_effect({"sternplane_cmd": "deg"}, vehicle, with_planes=False)
    check_effect({"rudder_cmd": "deg"}, vehicle, with_planes=False)


@pytest.mark.parametrize(("given", "convention"), [("frd", Convention.NED_FRD), ("flu", Convention.ENU_FLU)])
@pytest.mark.parametrize("name", ["base_link", "base_link_frd", "base_footprint"])
def test_axes_that_are_given_hold_for_known_frame_ids_too(
    name: str, given: str, convention: Convention
) -> None:
    table = FrameTable(frames_with([f"{name}={given}"]))
    assert table.of_body("odom", name) is convention
