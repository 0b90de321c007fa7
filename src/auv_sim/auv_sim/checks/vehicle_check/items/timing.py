"""Rates, jitter, and stamps against the clock."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_sim.checks.vehicle_check.samples import OdometrySample, Recording, WaterSample
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown, warned

#: Odometries a second: enough, and the least with which laws and watchdogs work.
GOOD_RATE, LEAST_RATE = 8.0, 4.0
#: Longest silence that the suite tolerates by default, s: odometry_timeout and water_velocity_timeout.
LONGEST_GAP = {topics.ODOM.name: 0.5, topics.WATER_VELOCITY.name: 1.0}
#: (95th less 5th percentile) of the intervals, over their median.
WORST_JITTER = 1.5
#: Age on arrival, s: above the first the rudder begins to swing, above the second the test fails.
GOOD_AGE, WORST_AGE = 0.15, 0.4
#: Stamps may be ahead by the resolution of a clock in steps, s.
AHEAD = 0.1
#: Largest difference of a step of the stamps from that of the arrivals, s; more is a jump.
JUMP = 0.5
#: Difference above which two readings are of different clocks, s.
OTHER_CLOCK = 3600.0

Stamped = Sequence[OdometrySample] | Sequence[WaterSample]


def check_timing(recording: Recording) -> list[Verdict]:
    """Judge rate, gaps and stamps of the two stamped topics."""
    verdicts: list[Verdict] = []
    stamped: tuple[tuple[Topic, Stamped], ...] = (
        (topics.ODOM, recording.odom), (topics.WATER_VELOCITY, recording.water)
    )  # fmt: skip
    for (name, kind, *_), samples in stamped:
        if len(samples) < 3:
            promised = any(e[:3] == (name, True, kind) for e in recording.endpoints)
            verdicts.append(
                failed(
                    f"{name}: rate", Mistake.TOO_SLOW, f"{len(samples)} messages", "at least a few a second"
                )
                if promised
                else unknown(f"{name}: rate", "no messages", "messages")
            )
            continue
        received = np.array([sample.received for sample in samples])
        stamps = np.array([sample.stamp for sample in samples])
        verdicts += [_order(name, stamps), _jumps(name, stamps, received), _age(name, stamps, received)]
        verdicts += _rate(name, stamps)
    return verdicts


def _order(name: str, stamps: np.ndarray) -> Verdict:
    item = f"{name}: order of stamps"
    steps = np.diff(stamps)
    behind = int(((steps < 0.0) & (steps > -JUMP)).sum())
    if behind:
        return failed(item, Mistake.OUT_OF_ORDER, f"{behind} of {steps.size} go back", "rising stamps")
    again = int((steps == 0.0).sum())
    if again:
        return failed(
            item, Mistake.REPEATED_STAMPS, f"{again} of {steps.size} repeat the last", "rising stamps"
        )
    return passed(item, f"{stamps.size} rising", "rising stamps")


def _jumps(name: str, stamps: np.ndarray, received: np.ndarray) -> Verdict:
    item = f"{name}: steps of stamps"
    steps = np.diff(stamps)
    strange = (np.abs(steps) > JUMP) & (np.abs(steps - np.diff(received)) > JUMP)
    if strange.any():
        worst = steps[strange][np.abs(steps[strange]).argmax()]
        return failed(
            item,
            Mistake.STAMP_JUMPS,
            f"{int(strange.sum())} jumps, up to {worst:+.2f} s",
            "steps as time passes",
        )
    return passed(item, "as time passes", "no jumps")


def _age(name: str, stamps: np.ndarray, received: np.ndarray) -> Verdict:
    item = f"{name}: age on arrival"
    age = float(np.median(received - stamps))
    expected = f"from 0 to {GOOD_AGE * 1e3:.0f} ms"
    if abs(age) > OTHER_CLOCK:
        return failed(item, Mistake.OTHER_CLOCK, f"{age:.3g} s", expected)
    measured = f"median {age * 1e3:.0f} ms"
    if age < -AHEAD:
        return failed(item, Mistake.FUTURE, measured, expected)
    if age > WORST_AGE:
        return failed(item, Mistake.LATE, measured, expected)
    if age > GOOD_AGE:
        return warned(item, measured, expected, Mistake.LATE)
    return passed(item, measured, expected)


def _rate(name: str, stamps: np.ndarray) -> list[Verdict]:
    newest = np.concatenate(([-np.inf], np.maximum.accumulate(stamps)[:-1]))
    rising = np.diff(stamps[stamps > newest])
    rising = rising[rising < OTHER_CLOCK]
    if rising.size < 2:
        return [unknown(f"{name}: rate", "no two stamps", "rising stamps")]
    median = float(np.median(rising))
    rate, longest, limit = 1.0 / median, float(rising.max()), LONGEST_GAP[name]
    least, good = (LEAST_RATE, GOOD_RATE) if name == topics.ODOM.name else (1.0 / limit, 2.0)
    measured, expected = f"{rate:.1f} Hz", f"{good:g} Hz or more"
    verdicts = []
    if rate < least:
        return [failed(f"{name}: rate", Mistake.TOO_SLOW, measured, expected)]
    judged = passed if rate >= good else warned
    verdicts.append(judged(f"{name}: rate", measured, expected))
    low, high = np.percentile(rising, 5), np.percentile(rising, 95)
    spread = float(high - low) / median
    measured = f"intervals of {low * 1e3:.0f} to {high * 1e3:.0f} ms"
    expected = f"within {WORST_JITTER:g} times the median"
    if spread > WORST_JITTER:
        verdicts.append(failed(f"{name}: jitter", Mistake.JITTERY, measured, expected))
    else:
        verdicts.append(passed(f"{name}: jitter", measured, expected))
    # A jump of the stamps is not a gap.
    gaps = rising[rising < 10.0 * JUMP]
    longest = float(gaps.max()) if gaps.size else longest
    measured, expected = f"{longest * 1e3:.0f} ms at most", f"{limit * 1e3:.0f} ms"
    if longest > limit:
        verdicts.append(failed(f"{name}: gaps", Mistake.GAPS, measured, expected))
    else:
        verdicts.append(passed(f"{name}: gaps", measured, expected))
    return verdicts
