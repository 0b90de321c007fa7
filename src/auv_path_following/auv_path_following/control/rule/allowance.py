"""What the rule changes for a hull whose coefficients are assumed; docs/tuning.md has the reasons."""

from __future__ import annotations

from typing import NamedTuple

#: Exponents: factors of `Allowance` are these powers of the factor within which coefficients are assumed.
_RATE, _REFERENCE, _ACCELERATION, _TURN, _CORRECTION, _LOOKAHEAD = 0.8, 1.3, 0.7, 0.4, -1.3, 0.85
#: Longest time that the fin may need for the command of one step where kp is above its rate, s.
LEAD = 0.08


class Allowance(NamedTuple):
    """Factors on gains of the rule, dimensionless; all are 1 for a hull that is known.

    Attributes:
        rate: on the fin's rate in kp; less at slow odometry, see `kp_for`.
        reference: on the fin's rate in the jerk and the bandwidth of the reference.
        acceleration: on the share of the full fin in the reference's acceleration.
        turn: on the rate of turn that courses need, in the reference's rate and bandwidth.
        correction: on k1 and k3, which bound how fast errors are corrected.
        lookahead: on Delta.
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
    """Return the factors for a hull whose coefficients are assumed within a factor; 1: known."""
    powers = _RATE, _REFERENCE, _ACCELERATION, _TURN, _CORRECTION, _LOOKAHEAD
    return Allowance(*(within**power for power in powers))
