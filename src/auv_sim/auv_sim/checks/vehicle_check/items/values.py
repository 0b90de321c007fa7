"""Checks single messages: frame ids, finite numbers, unit quaternions, covariances, positions."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import Convention, FrameIds, FrameTable
from auv_msgs_py.values.errors import MessageRefused
from auv_sim.checks.vehicle_check.samples import Motion, Recording, usable
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown, warned

#: Largest speed of a vehicle of this kind, m/s, largest error of a fix, and of a depth sensor, m.
_FASTEST, _FIX, _SENSOR = 6.0, 2.0, 1.0


def check_values(recording: Recording, motion: Motion, dives: bool = False) -> list[Verdict]:
    """Judge what single messages hold.

    Args:
        recording: the messages.
        motion: what they show in the plane.
        dives: whether depth, pitch rate and vertical velocities matter as well.
    """
    verdicts = [*_frames(recording)]
    if recording.odom:
        verdicts += [_numbers(recording, dives), _quaternions(recording)]
    if recording.water:
        bad = sum(
            not math.isfinite(sample.u + sample.v) or (dives and math.isinf(sample.w))
            for sample in recording.water
        )
        verdicts.append(_finite(f"{topics.WATER_VELOCITY.name}: numbers", bad, len(recording.water)))
    for topic, values in (
        (topics.RUDDER_STATE, recording.rudder_state), (topics.STERNPLANE_STATE, recording.sternplane_state)
    ):  # fmt: skip
        if values:
            bad = sum(not math.isfinite(sample.value) for sample in values)
            verdicts.append(_finite(f"{topic.name}: numbers", bad, len(values)))
    verdicts += _covariances(recording)
    if motion.enough:
        verdicts.append(_continuity(motion))
        if dives:
            verdicts.append(_depth_continuity(recording))
    return verdicts


def convention_of(recording: Recording) -> Convention | None:
    """Return the convention of the odometry's frame ids; None if no convention has them."""
    table = FrameTable(FrameIds())
    try:
        return table.of_pose(topics.ODOM.name, recording.odom[0].frame, recording.odom[0].child)
    except (IndexError, MessageRefused):
        return None


def _frames(recording: Recording) -> list[Verdict]:
    ids, table = FrameIds(), FrameTable(FrameIds())
    known = {*ids.enu_world, *ids.ned_world, *ids.flu_body, *ids.frd_body}
    verdicts = []
    pairs = sorted({(sample.frame, sample.child) for sample in recording.odom})
    bodies = sorted({sample.frame for sample in recording.water})
    item = f"{topics.ODOM.name}: frame ids"
    expected = "map or odom with base_link, map_ned or odom_ned with base_link_frd or base_link_fsd"
    for world, body in pairs:
        try:
            convention = table.of_pose(topics.ODOM.name, world, body)
        except MessageRefused:
            bare = {name.rsplit("/", 1)[-1] for name in (world, body)}
            mistake = Mistake.CONTRADICTING_FRAMES if bare <= known else Mistake.UNKNOWN_FRAME
            verdicts.append(failed(item, mistake, f"'{world}' with '{body}'", expected))
            break
    else:
        if pairs:
            verdicts.append(
                passed(item, f"'{pairs[0][0]}' with '{pairs[0][1]}': {convention.value}", expected)
            )
    item, expected = f"{topics.WATER_VELOCITY.name}: frame id", "base_link, base_link_frd or base_link_fsd"
    for body in bodies:
        try:
            table.of_body(topics.WATER_VELOCITY.name, body)
        except MessageRefused:
            verdicts.append(failed(item, Mistake.UNKNOWN_FRAME, f"'{body}'", expected))
            break
    else:
        if bodies:
            verdicts.append(passed(item, f"'{bodies[0]}'", expected))
    return verdicts


def _finite(item: str, bad: int, of: int) -> Verdict:
    if bad:
        return failed(item, Mistake.NOT_A_NUMBER, f"{bad} of {of} with NaN or infinite", "finite numbers")
    return passed(item, f"{of} finite", "finite numbers")


def _numbers(recording: Recording, dives: bool) -> Verdict:
    item = f"{topics.ODOM.name}: numbers"
    bad = sum(
        not np.isfinite((s.x, s.y, *s.orientation, s.r)).all()
        or math.isinf(s.u + s.v)
        or (dives and (not math.isfinite(s.z + s.q) or math.isinf(s.w)))
        for s in recording.odom
    )
    if bad:
        return _finite(item, bad, len(recording.odom))
    unlocked = sum(math.isnan(s.u + s.v) for s in recording.odom)
    if unlocked:
        share = 100.0 * unlocked / len(recording.odom)
        return passed(item, f"finite; no bottom lock in {share:.0f} %", "finite, a NaN linear twist apart")
    return _finite(item, 0, len(recording.odom))


def _quaternions(recording: Recording) -> Verdict:
    item = f"{topics.ODOM.name}: orientation"
    norms = np.array([math.sqrt(sum(q * q for q in sample.orientation)) for sample in recording.odom])
    norms = norms[np.isfinite(norms)]
    if norms.size == 0:
        return unknown(item, "no number", "unit quaternions")
    worst = float(norms[np.abs(norms - 1.0).argmax()])
    if abs(worst * worst - 1.0) >= 0.02:
        return failed(item, Mistake.NO_UNIT_QUATERNION, f"a norm of {worst:.3f}", "unit quaternions")
    level = np.array([_tilt(sample.orientation) for sample in recording.odom])
    tilt = math.degrees(float(np.nanmedian(level)))
    if tilt > 60.0:
        return warned(item, f"tilted by {tilt:.0f} deg", "a vehicle on an even keel (180: another z axis?)")
    return passed(item, f"unit quaternions, tilt {tilt:.0f} deg", "unit quaternions")


def _tilt(q: tuple[float, float, float, float]) -> float:
    """Return the angle between the vehicle's z axis and the world's, rad."""
    return math.acos(min(max(1.0 - 2.0 * (q[0] * q[0] + q[1] * q[1]), -1.0), 1.0))


def _covariances(recording: Recording) -> Iterable[Verdict]:
    groups = {
        f"{topics.ODOM.name}: covariances": [
            value for s in recording.odom for value in (*s.pose_covariance, *s.twist_covariance)
        ],
        f"{topics.WATER_VELOCITY.name}: covariances": [v for s in recording.water for v in s.covariance],
    }
    for item, values in groups.items():
        if not values:
            continue
        array = np.array(values)
        bad = ~(array >= 0.0)
        if bad.any():
            found = f"{int(bad.sum())} variances such as {array[bad][0]:g}"
            yield failed(item, Mistake.BAD_COVARIANCE, found, "0 (not given) or greater")
        else:
            yield passed(item, "not given" if not array.any() else f"up to {array.max():.3g}", "0 or greater")


def _continuity(motion: Motion) -> Verdict:
    item = f"{topics.ODOM.name}: positions"
    steps = np.hypot(np.diff(motion.x), np.diff(motion.y))
    jumps = steps > _FASTEST * np.diff(motion.t) + _FIX
    if jumps.any():
        return failed(
            item, Mistake.POSITION_JUMPS, f"{int(jumps.sum())} jumps, up to {steps[jumps].max():.1f} m",
            f"no more than {_FIX:g} m beyond {_FASTEST:g} m/s",
        )  # fmt: skip
    return passed(item, f"steps of up to {steps.max():.2f} m", "no jumps")


def _depth_continuity(recording: Recording) -> Verdict:
    item = f"{topics.ODOM.name}: depths"
    rows = [(s.stamp, s.z) for s in usable(recording.odom) if math.isfinite(s.z)]
    t, z = np.array(rows).reshape(-1, 2).T
    steps = np.abs(np.diff(z))
    jumps = steps > _FASTEST * np.diff(t) + _SENSOR
    if jumps.any():
        return failed(
            item, Mistake.POSITION_JUMPS, f"{int(jumps.sum())} jumps of z, up to {steps[jumps].max():.1f} m",
            f"no more than {_SENSOR:g} m beyond {_FASTEST:g} m/s",
        )  # fmt: skip
    return passed(item, f"steps of up to {steps.max(initial=0.0):.2f} m", "no jumps")
