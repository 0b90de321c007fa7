"""Dubins paths against a search without their formulas."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.angles import TWO_PI, wrap
from auv_path_following.curves import dubins
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.dubins import PlanarPose

_far = st.floats(-60.0, 60.0)
_near = st.floats(-15.0, 15.0)
_course = st.floats(-4.0, 4.0)
poses = st.builds(PlanarPose, _far, _far, _course) | st.builds(PlanarPose, _near, _near, _course)
radii = st.sampled_from([4.0, 10.0])


def _after(pose: PlanarPose, side: float, angle: float, radius: float) -> PlanarPose:
    """Turn by `angle` to one side."""
    cx, cy = pose.x - side * radius * math.sin(pose.chi), pose.y + side * radius * math.cos(pose.chi)
    chi = pose.chi + side * angle
    return PlanarPose(cx + side * radius * math.sin(chi), cy - side * radius * math.cos(chi), chi)


def _centre(pose: PlanarPose, side: float, radius: float) -> tuple[float, float]:
    return pose.x - side * radius * math.sin(pose.chi), pose.y + side * radius * math.cos(pose.chi)


def _searched(start: PlanarPose, end: PlanarPose, radius: float) -> float:
    """The least length over first turns and kinds: for each first turn the rest follows, or it does not fit.

    The size of the first turn is found by scanning for changes of sign and bisecting them.
    """
    best = math.inf
    for s1, s2, straight in itertools.product((1.0, -1.0), (1.0, -1.0), (True, False)):
        if not straight and s1 != s2:
            continue
        ex, ey = _centre(end, s2, radius)

        def misfit(angle: float, s1=s1, s2=s2, straight=straight, ex=ex, ey=ey) -> float:
            p = _after(start, s1, angle, radius)
            if straight:  # the line through p has to touch the last circle, on its proper side
                return -(ex - p.x) * math.sin(p.chi) + (ey - p.y) * math.cos(p.chi) - s2 * radius
            mx, my = _centre(p, -s1, radius)
            return math.hypot(ex - mx, ey - my) - 2.0 * radius

        steps = 180
        angles = [TWO_PI * k / steps for k in range(steps + 1)]
        values = [misfit(angle) for angle in angles]
        for k in range(steps):
            if values[k] * values[k + 1] > 0.0:
                continue
            low, high = angles[k], angles[k + 1]
            for _ in range(45):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if misfit(low) * misfit(middle) > 0.0 else (low, middle)
            p = _after(start, s1, low, radius)
            if straight:
                ahead = (ex - p.x) * math.cos(p.chi) + (ey - p.y) * math.sin(p.chi)
                if ahead < -1e-6:
                    continue
                second, chi = max(ahead, 0.0), p.chi
            else:
                mx, my = _centre(p, -s1, radius)
                touch = math.atan2(ey - my, ex - mx)  # from the middle circle's centre to the last one's
                chi = touch - s1 * 0.5 * math.pi
                turn = (-s1 * (chi - p.chi)) % TWO_PI
                second = turn * radius
            last = (s2 * (end.chi - chi)) % TWO_PI
            last = 0.0 if last > TWO_PI - 1e-6 else last
            best = min(best, radius * (low + last) + second)
    return best


def _length(segments) -> float:
    return sum(segment.length for segment in segments)


@settings(max_examples=30, phases=(Phase.explicit, Phase.generate))
@given(poses, poses, radii)
def test_it_is_as_short_as_the_best_that_a_search_finds(start, end, radius):
    assume(math.dist(start[:2], end[:2]) > 0.1)  # for the search no turn and a whole circle are alike
    found = _length(dubins.connect(start, end, radius))
    assert found == pytest.approx(_searched(start, end, radius), rel=1e-6, abs=1e-4)


@given(poses, poses, radii)
def test_every_word_leads_from_pose_to_pose(start, end, radius):
    words = dubins.words(start, end, radius)
    assert {"LSL", "RSR"} <= {word.letters for word in words}
    for word in words:
        segments = dubins.follow(start, end, word, radius)
        if not segments:
            continue
        path = CompositePath(segments, tolerance=1e-9)
        assert path.length == pytest.approx(word.size * radius, abs=1e-6)
        assert all(abs(joint.angle_step) < 1e-6 for joint in path.joints)
        first, last = path.evaluate(0, 0.0), path.evaluate(path.n - 1, 1.0)
        assert (first.x, first.y, last.x, last.y) == pytest.approx((start.x, start.y, end.x, end.y), abs=1e-8)
        assert wrap(first.chi - start.chi) == pytest.approx(0.0, abs=1e-6)
        assert wrap(last.chi - end.chi) == pytest.approx(0.0, abs=1e-6)


@given(poses, poses, radii)
def test_it_is_never_longer_than_any_word(start, end, radius):
    best = dubins.shortest(start, end, radius)
    assert all(best.size <= word.size for word in dubins.words(start, end, radius))


@given(poses, poses, radii)
def test_mirror_image_and_way_back_are_as_long(start, end, radius):
    def mirrored(pose: PlanarPose) -> PlanarPose:
        return PlanarPose(pose.x, -pose.y, -pose.chi)

    def turned(pose: PlanarPose) -> PlanarPose:
        return PlanarPose(pose.x, pose.y, pose.chi + math.pi)

    length = dubins.shortest(start, end, radius).size
    assert dubins.shortest(mirrored(start), mirrored(end), radius).size == pytest.approx(length, abs=1e-6)
    assert dubins.shortest(turned(end), turned(start), radius).size == pytest.approx(length, abs=1e-6)


@pytest.mark.parametrize(
    ("end", "letters"),
    [
        (PlanarPose(60.0, 0.0, 0.0), "LSL"),  # straight ahead: turns of no size
        (PlanarPose(0.0, 40.0, math.pi), "RSR"),
        (PlanarPose(0.0, -40.0, math.pi), "LSL"),
        (PlanarPose(60.0, 60.0, 0.0), "RSL"),
        (PlanarPose(60.0, -60.0, 0.0), "LSR"),
        (PlanarPose(0.0, 5.0, math.pi), "LRL"),
        (PlanarPose(0.0, -5.0, math.pi), "RLR"),
    ],
)
def test_all_six_words_are_used(end, letters):
    assert dubins.shortest(PlanarPose(0.0, 0.0, 0.0), end, 10.0).letters == letters


def test_one_pose_needs_no_way():
    pose = PlanarPose(3.0, 4.0, 0.5)
    assert dubins.connect(pose, pose, 10.0) == []


def test_along_one_circle_it_stays_on_it():
    segments = dubins.connect(
        PlanarPose(0.0, 0.0, 0.0), _after(PlanarPose(0.0, 0.0, 0.0), 1.0, 2.0, 12.0), 12.0
    )
    assert _length(segments) == pytest.approx(24.0, abs=1e-6)
