"""Frames: every change undone by its reverse, and names that are understood or refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.contract.frames import (
    Convention,
    FrameIds,
    FrameTable,
    flip_yaw,
    quaternion_of_yaw,
    swap_axes,
    turn_pose_covariance,
    turn_twist_covariance,
    yaw_of_quaternion,
)
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import MessageRefused

_angle = st.floats(-10.0, 10.0)
_number = st.floats(-1e6, 1e6)


@pytest.mark.parametrize(
    ("yaw_enu", "psi"),
    [(0.0, math.pi / 2), (math.pi / 2, 0.0), (math.pi, -math.pi / 2), (-math.pi / 2, math.pi)],
    ids=["east", "north", "west", "south"],
)
def test_compass_points(yaw_enu, psi):
    assert wrap(flip_yaw(yaw_enu) - psi) == pytest.approx(0.0, abs=1e-15)


@given(_angle, _number, _number)
def test_changing_frames_twice_changes_nothing(yaw, x, y):
    assert flip_yaw(flip_yaw(yaw)) == pytest.approx(yaw, abs=1e-14)
    assert swap_axes(*swap_axes(x, y)) == (x, y)


@given(_angle, st.floats(0.1, 5.0))
def test_a_velocity_along_the_bow_is_so_in_both_frames(psi, speed):
    """Turning the axes of a velocity and turning the yaw must agree."""
    east, north = speed * math.cos(flip_yaw(psi)), speed * math.sin(flip_yaw(psi))
    vx, vy = swap_axes(east, north)
    assert vx == pytest.approx(speed * math.cos(psi), abs=1e-12)
    assert vy == pytest.approx(speed * math.sin(psi), abs=1e-12)


@given(_angle)
def test_quaternion_and_yaw_are_inverse(yaw):
    z, w = quaternion_of_yaw(yaw)
    assert z * z + w * w == pytest.approx(1.0, abs=1e-15)
    assert wrap(yaw_of_quaternion(0.0, 0.0, z, w) - yaw) == pytest.approx(0.0, abs=1e-14)
    assert wrap(yaw_of_quaternion(0.0, 0.0, -z, -w) - yaw) == pytest.approx(0.0, abs=1e-14)


@given(st.floats(-3.0, 3.0), st.floats(-1.4, 1.4), st.floats(-3.0, 3.0))
def test_roll_and_pitch_do_not_disturb_the_yaw(yaw, pitch, roll):
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    # The quaternion of a turn about z, then y, then x.
    x, y = sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy
    z, w = cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy
    assert yaw_of_quaternion(x, y, z, w) == pytest.approx(yaw, abs=1e-9)


def test_columns_of_numbers_are_changed_at_once():
    yaw = np.linspace(-3.0, 3.0, 25)
    z, w = np.sin(yaw / 2), np.cos(yaw / 2)
    zero = np.zeros_like(yaw)
    assert yaw_of_quaternion(zero, zero, z, w) == pytest.approx(yaw, abs=1e-14)
    assert flip_yaw(yaw) == pytest.approx(math.pi / 2 - yaw)


@pytest.mark.parametrize(
    ("world", "body", "convention"),
    [
        ("map", "base_link", Convention.ENU_FLU),
        ("odom", "base_link", Convention.ENU_FLU),
        ("map_ned", "base_link_frd", Convention.NED_FRD),
        ("auv1/odom_ned", "/auv1/base_link_frd", Convention.NED_FRD),
        ("/a/b/map", "a/b/base_link", Convention.ENU_FLU),
    ],
)
def test_the_name_decides(world, body, convention):
    table = FrameTable(FrameIds())
    for _ in range(2):  # the second answer is the remembered one
        assert table.of_pose("odom", world, body) is convention
        assert table.of_body("velocity_through_water", body) is convention


@pytest.mark.parametrize(
    ("world", "body"),
    [("map", "base_link_frd"), ("map_ned", "base_link"), ("", ""), ("world", "base_link"), ("map", "hull")],
)
def test_an_unknown_or_contradictory_pair_is_refused_with_both_names(world, body):
    table = FrameTable(FrameIds())
    for _ in range(2):
        with pytest.raises(MessageRefused) as caught:
            table.of_pose("odom", world, body)
        said = str(caught.value)
        assert said.startswith("odom: ")
        assert f"'{world}'" in said
        assert f"'{body}'" in said
        assert "map_ned" in said
        assert "\n" not in said


def test_an_unknown_body_frame_is_refused():
    with pytest.raises(
        MessageRefused, match=r"velocity_through_water: found frame_id 'auv/dvl'.*base_link_frd"
    ):
        FrameTable(FrameIds()).of_body("velocity_through_water", "auv/dvl")


def test_own_names_replace_the_usual_ones():
    table = FrameTable(FrameIds(ned_world=["sea"], frd_body=["hull"]))
    assert table.of_pose("odom", "sea", "hull") is Convention.NED_FRD
    with pytest.raises(MessageRefused):
        table.of_pose("odom", "map_ned", "hull")


def test_ids_that_differ_in_every_message_do_not_fill_memory() -> None:
    table = FrameTable(FrameIds())
    for k in range(1000):
        table.of_pose("odom", f"auv{k}/map", "base_link")
        table.of_body("velocity_through_water", f"auv{k}/base_link")
    assert len(table._known) <= 64 and len(table._known_body) <= 64


def test_a_covariance_is_turned_as_the_values_are() -> None:
    """Against the covariance of samples that are converted one by one, as the messages are."""
    random = np.random.default_rng(3)
    mixed = random.normal(size=(200, 6)) @ random.normal(size=(6, 6))
    x, y, z, roll, pitch, yaw = mixed.T
    converted = np.column_stack([*swap_axes(x, y), -z, roll, -pitch, flip_yaw(yaw)])
    turned = turn_pose_covariance(tuple(np.cov(mixed.T).flat))
    assert np.array(turned).reshape(6, 6) == pytest.approx(np.cov(converted.T))
    u, v, w, p, q, r = mixed.T
    converted = np.column_stack([u, -v, -w, p, -q, -r])
    turned = turn_twist_covariance(tuple(np.cov(mixed.T).flat))
    assert np.array(turned).reshape(6, 6) == pytest.approx(np.cov(converted.T))
