"""What is read of a recording: axes of its frame ids, motion of its planes, the part that is left out."""

from __future__ import annotations

import numpy as np
import pytest

from auv_msgs_py.contract.frames import Convention, FrameTable
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.verbs.recordings_read import LAST, divided, frames_with, motion_within, turning_part


def turning(begin: float, end: float, rate: float) -> PlanarData:
    """Return 300 s that turn between two times, with the noise of a gyro."""
    t = np.arange(0.0, 300.0, 0.05)
    r = np.where((t >= begin) & (t < end), rate, 0.0) + np.random.default_rng(0).normal(0.0, 1e-3, t.size)
    water, zeros = t[::4], np.zeros(t.size)
    u = np.ones(water.size)
    return PlanarData("r", t, r, water, u, 0.0 * u, t, zeros, t, zeros, zeros, zeros, zeros, zeros)


@pytest.mark.parametrize("rate", [0.2, -0.2])
def test_a_straight_at_the_end_is_not_what_the_model_is_judged_by(rate: float) -> None:
    data = turning(60.0, 180.0, rate)
    begin, end = turning_part(data)
    assert end - begin == pytest.approx(LAST)
    assert 60.0 < end <= 225.0
    used, left_out = divided([data], None)
    assert left_out is not None
    assert np.mean(left_out.r**2) >= np.mean(data.r**2)
    assert [round(part.t[-1] - part.t[0]) for part in used] == [round(begin), round(data.t[-1] - end)]


def test_the_last_part_is_left_out_where_it_turns() -> None:
    data = turning(100.0, 300.0, 0.2)
    assert turning_part(data)[1] == pytest.approx(data.t[-1])


def test_the_only_turn_of_a_recording_is_not_left_out_of_its_identification() -> None:
    for data in (turning(150.0, 165.0, 0.2), turning(150.0, 180.0, 0.2)):
        used, _ = divided([data], None)
        assert sum(np.sum(part.r**2) for part in used) > 0.4 * np.sum(data.r**2)
    again = turning(150.0, 165.0, 0.2)
    assert divided([again, data], None)[1] is not None  # the other recording turns as well


@pytest.mark.parametrize(("begin", "moves"), [(-5.0, True), (400.0, False)])
def test_commands_beside_the_odometry_are_no_motion_of_the_planes(begin: float, moves: bool) -> None:
    t = np.arange(0.0, 300.0, 0.05)
    commands = 0.2 * np.sign(np.sin(t))
    assert (motion_within(t + begin, commands, t) > 0.1) == moves


@pytest.mark.parametrize(("given", "convention"), [("frd", Convention.NED_FRD), ("flu", Convention.ENU_FLU)])
@pytest.mark.parametrize("name", ["base_link", "base_link_frd", "base_footprint"])
def test_axes_that_are_given_hold_for_known_frame_ids_too(
    name: str, given: str, convention: Convention
) -> None:
    table = FrameTable(frames_with([f"{name}={given}"]))
    assert table.of_body("odom", name) is convention
