"""What the rule changes for a hull whose coefficients are assumed; docs/tuning.md has the reasons."""

from __future__ import annotations

from typing import NamedTuple

#: Each factor of the rule is a power of the factor within which the coefficients are assumed.
_RATE, _REFERENCE, _ACCELERATION, _TURN, _CORRECTION, _LOOKAHEAD = 0.8, 1.3, 0.7, 0.4, -1.3, 0.85
#: Where kp is above the fin's rate: time in which the fin turns by what kp turns it in one step, s.
LEAD = 0.08


class Allowance(NamedTuple):
    """Factors on gains of the rule; all are 1 for a hull that is known.

    Attributes:
        rate: kp, over the fin's rate; less at slow odometry, see `kp_for`.
        reference: rate of the fin by which the reference builds up and brakes a turn, over the fin's rate.
        acceleration: share of the full fin that the reference may use.
        turn: rate at which a course may turn.
        correction: k1 and k3, the speeds at which errors are corrected.
        lookahead: Delta.
    """

    rate: float = 1.0
    reference: float = 1.0
    acceleration: float = 1.0
    turn: float = 1.0
    correction: float = 1.0
    lookahead: float = 1.0

    def kp_for(self, rate: float, step: float) -> float:
        """Return kp for a fin of this rate (rad/s) and a time between two odometries (s), rad/s."""
        return rate * max(1.0, min(self.rate, LEAD / step))


KNOWN = Allowance()


def allowance_for(within: float) -> Allowance:
    """Return the factors for a hull whose coefficients are assumed within a factor; 1: they are known."""
    powers = _RATE, _REFERENCE, _ACCELERATION, _TURN, _CORRECTION, _LOOKAHEAD
    return Allowance(*(within**power for power in powers))
