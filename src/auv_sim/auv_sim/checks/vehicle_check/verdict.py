"""The verdict on one item: pass, warning, fail or not judged, with what was measured."""

from __future__ import annotations

import enum
from typing import NamedTuple


class Level(enum.Enum):
    """The levels of a verdict."""

    PASS = "pass"  # noqa: S105 - no password
    WARN = "warning"
    FAIL = "fail"
    UNKNOWN = "not judged"


class Mistake(enum.Enum):
    """The mistakes that have a name, with their text in the report."""

    MISSING_TOPIC = "a topic is missing"
    TWO_PUBLISHERS = "two publishers on one topic"
    WRONG_TYPE = "a topic of the wrong type"
    QOS_MISMATCH = "a QoS that never matches"
    DEAF = "a command without a subscription"
    UNKNOWN_FRAME = "a frame id that the contract does not know"
    CONTRADICTING_FRAMES = "frame ids of two conventions"
    NOT_A_NUMBER = "NaN or infinite where a number is needed"
    NO_UNIT_QUATERNION = "an orientation that is no unit quaternion"
    BAD_COVARIANCE = "a variance that is negative or no number"
    POSITION_JUMPS = "positions that jump"
    TOO_SLOW = "too few messages"
    JITTERY = "intervals that vary too much"
    GAPS = "gaps"
    OTHER_CLOCK = "stamps of another clock"
    LATE = "stamps that are old on arrival"
    FUTURE = "stamps from the future"
    OUT_OF_ORDER = "stamps out of order"
    REPEATED_STAMPS = "stamps that come twice"
    STAMP_JUMPS = "stamps that jump"
    YAW_OTHER_CONVENTION = "yaw of the other convention (NED heading as ENU yaw, or the reverse)"
    YAW_SIGN = "yaw with the wrong sign"
    YAW_OFFSET = "yaw with a constant offset"
    YAW_DEGREES = "yaw in degrees"
    YAW_UNRELATED = "yaw that has nothing to do with the course"
    YAW_RATE_SIGN = "yaw rate with the wrong sign"
    YAW_RATE_DEGREES = "yaw rate in degrees"
    YAW_RATE_WRONG = "yaw rate that is not the rate of yaw"
    SWAPPED_AXES = "x and y of the position swapped"
    MIRRORED_POSITION = "one axis of the position with the wrong sign"
    VELOCITY_IN_WORLD = "body velocity given in the world frame"
    SWAY_SIGN = "v with the wrong sign (FRD as FLU, or the reverse)"
    VELOCITY_UNITS = "velocity in other units than position"
    VELOCITY_WRONG = "body velocity that is not the change of position"
    WATER_SWAY_SIGN = "v through the water with the wrong sign (FRD as FLU, or the reverse)"
    WATER_IN_WORLD = "velocity through the water given in the world frame"
    WATER_WRONG = "a velocity through the water that no current explains"
    RUDDER_SIGN = "rudder with the wrong sign (or everything is NED under ENU names)"
    RUDDER_STATE_SIGN = "rudder_state with the wrong sign"
    RUDDER_DEGREES = "rudder in degrees"
    RUDDER_SCALE = "rudder with the wrong scale"
    RUDDER_DEAD = "the rudder does nothing"
    RUDDER_SLOW = "a rudder slower than the vehicle's file says"
    DEAD_TIME = "a dead time that the heading loop cannot bear"
    THRUST_DEAD = "the thrust does nothing"
    THRUST_SCALE = "thrust with the wrong scale"
    PLANAR_ODOMETRY = (
        "an odometry in the plane, from a vehicle with stern planes: z, roll and pitch are always 0"
    )
    DEPTH_FROZEN = "a depth that never changes"
    ATTITUDE_FLAT = "an attitude without roll and pitch"
    ATTITUDE_TILTED = "an attitude that no vehicle has (another z axis, or degrees)"
    DEPTH_SIGN = "depth with the wrong sign"
    PITCH_SIGN = "pitch with the wrong sign"
    DIVE_SIGN = "depth or pitch with the wrong sign"
    DIVE_OTHER_CONVENTION = "depth and pitch of the other convention (down and bow up as ENU, or the reverse)"
    AXES_OTHER_CONVENTION = "NED/FRD throughout under the names of ENU/FLU, or the reverse"
    DEPTH_UNITS = "depth in other units than position"
    DEPTH_UNRELATED = "a depth that has nothing to do with pitch and speed"
    PITCH_RATE_SIGN = "pitch rate with the wrong sign"
    PITCH_RATE_DEGREES = "pitch rate in degrees"
    PITCH_RATE_WRONG = "pitch rate that is not the rate of pitch"
    ROLL_SIGN = "roll or roll rate with the wrong sign"
    HEAVE_SIGN = "vertical velocity with the wrong sign (FRD as FLU, or the reverse)"
    HEAVE_IN_WORLD = "vertical velocity given in the world frame"
    HEAVE_WRONG = "vertical velocity that is not the change of depth"
    WATER_HEAVE_SIGN = "vertical velocity through the water with the wrong sign (FRD as FLU, or the reverse)"
    WATER_HEAVE_WRONG = "a vertical velocity through the water that no current explains"
    ALTITUDE_SIGN = "an altitude that grows with the depth (range to the surface, or the depth itself)"
    ALTITUDE_UNITS = "altitude in other units than depth"
    ALTITUDE_NO_ECHO = "a lost echo given as a number"
    PLANES_SIGN = "stern planes with the wrong sign"
    PLANES_STATE_SIGN = "sternplane_state with the wrong sign"
    PLANES_DEGREES = "stern planes in degrees"
    PLANES_SCALE = "stern planes with the wrong scale"
    PLANES_DEAD = "the stern planes do nothing"
    PLANES_SLOW = "stern planes slower than the vehicle's file says"
    PLANES_DEAD_TIME = "a dead time that the pitch loop cannot bear"
    NOT_JUDGED = "an item that the small test could not judge"


class Verdict(NamedTuple):
    """One row of the table.

    `mistake` is the cause, not the symptom: what follows from another item's mistake carries that one.
    """

    item: str
    level: Level
    measured: str
    expected: str = ""
    mistake: Mistake | None = None


def passed(item: str, measured: str, expected: str = "") -> Verdict:
    """Return a verdict on an item as it should be."""
    return Verdict(item, Level.PASS, measured, expected)


def failed(item: str, mistake: Mistake, measured: str, expected: str) -> Verdict:
    """Return a verdict on an item that fails, with its cause."""
    return Verdict(item, Level.FAIL, measured, expected, mistake)


def warned(item: str, measured: str, expected: str, mistake: Mistake | None = None) -> Verdict:
    """Return a verdict on an item that is usable with a reservation."""
    return Verdict(item, Level.WARN, measured, expected, mistake)


def unknown(item: str, why: str, needed: str) -> Verdict:
    """Return a verdict on an item that could not be judged."""
    return Verdict(item, Level.UNKNOWN, why, needed)
