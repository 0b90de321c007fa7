"""The gains of MSS's law that are searched, as dimensionless variables like those of the suite.

Near its path and within its boundary layer the law is a PID law of heading error and yaw rate: its inner loop
has a crossover and margins as the suite's have.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from auv_path_following.comparators.mss_pilot import MssPilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.pid import PidConfig
from auv_path_following.control.reference_model import ReferenceConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.tune.gain_space import GainSet, GainSpace, Variable, Vector, allowed

#: In the order of a point. w_c is the crossover of the inner loop, R the radius of the steady turn.
PEER_VARIABLES = (
    Variable("crossover w_c times delay", 0.1, 1.25),
    Variable("slope over w_c", 0.005, 0.6),
    Variable("yaw time times slope", 0.1, 4.0),
    Variable("gain within the boundary over that of the slope", 0.02, 3.0),
    Variable("boundary over u0/R", 0.05, 4.0),
    Variable("observer over w_c", 0.02, 1.0),
    Variable("largest rate over u0/R", 0.2, 2.0),
    Variable("look-ahead times observer over speed", 0.5, 30.0),
    Variable("adaptation times look-ahead squared over speed", 0.003, 2.0),
    Variable("switching distance over R", 0.1, 5.0),
)
#: First values of those that do not come from the rule. The published slope and boundary suit one hull: on
#: most others, with a delay, the integral of the surface winds up in the first turn.
_FIRST = {
    "slope": 0.05, "time": 1.5, "within": 0.1, "boundary": 0.7, "observer": 0.4, "rate": 1.0,
    "adaptation": 0.2, "switching": 2.0,
}  # fmt: skip
#: In the plane the planes rest.
_NO_PLANES = 1.0


class PeerSpace(GainSpace):
    """Turns points into gains of MSS's law for one vehicle; the rule is that of the suite, as a yardstick.

    Args:
        vehicle, guidance, delay, step: as of `GainSpace`.

    Attributes:
        first: where the search begins, within the bounds.
    """

    def __init__(self, vehicle: Vehicle, guidance: PathFollowerConfig, delay: float, step: float) -> None:
        super().__init__(vehicle, guidance, delay, step)
        heading, first = self.ruled.heading, _FIRST
        observer = first["observer"] * heading.crossover
        ratios = (
            heading.crossover * self.delay, first["slope"], first["time"], first["within"], first["boundary"],
            first["observer"], first["rate"], heading.lookahead * observer / self.response.speed,
            first["adaptation"], first["switching"],
        )  # fmt: skip
        self.first = np.clip(np.log(ratios), *self.bounds())

    @staticmethod
    def bounds() -> tuple[Vector, Vector]:
        """Return the smallest and the largest point."""
        return np.log([v.low for v in PEER_VARIABLES]), np.log([v.high for v in PEER_VARIABLES])

    def gains(self, point: Sequence[float] | Vector) -> GainSet:
        """Return the gains at a point (logarithms of `PEER_VARIABLES`, clipped to their bounds).

        Its autopilot is the law's equal near the path: margins are those of its loop.
        """
        ratios = np.exp(np.clip(np.asarray(point, float), *self.bounds())).tolist()
        crossing, steep, time, within, width, smooth, turn, ahead, learning, switch = ratios
        w_c, speed = crossing / self.delay, self.response.speed
        slope, observer = steep * w_c, smooth * w_c
        yaw_time, boundary = time / slope, width * self.fastest
        layer = 2.0 * time * within  # the gain within the boundary, over sigma
        yaw_gain = (2.0 * time + layer) * abs(self.response.gain(w_c))
        lookahead = ahead * speed / observer
        law = MssPilot(
            pitch_inertia=_NO_PLANES, lookahead=lookahead, adaptation=learning * speed / lookahead**2,
            switching=switch * speed / self.fastest, observer=observer, largest_rate=turn * self.fastest,
            yaw_gain=yaw_gain, yaw_time=yaw_time, slope=slope, boundary=boundary,
            switching_gain=layer * boundary,
        )  # fmt: skip
        return self.rule()._replace(autopilot=equal_pid(law), peer=law)


def equal_pid(law: MssPilot) -> AutopilotConfig:
    """Return the PID law that MSS's rudder law is within its boundary layer, about a constant course."""
    layer, k = law.switching_gain / law.boundary, law.yaw_gain
    slope, time = law.slope, law.yaw_time
    pid = allowed(
        PidConfig,
        kp=slope * (slope * time + 2.0 + 2.0 * layer) / k,
        ki=slope * slope * (1.0 + layer) / k,
        kd=(2.0 * slope * time + layer) / k,
    )
    return AutopilotConfig(controller="pid", pid=pid, reference=ReferenceConfig(enabled=False))
