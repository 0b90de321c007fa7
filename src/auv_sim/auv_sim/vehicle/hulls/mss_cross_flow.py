"""Drag of the flow across the hull of `mss_remus100`: a smooth cylinder of finite length, strip by strip."""

from __future__ import annotations

from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.hulls.mss_particulars import DIAMETER, LENGTH, RHO_BODY

#: Strips of the cross-flow drag: their number and their width, m.
STRIPS, _WIDTH = 21, LENGTH / 20.0
#: Reduction of the drag for the finite length, below and above the critical Reynolds number (DNV-RP-C205):
#: linear in length over diameter between 5 and 10.
_FINITE_SLOW = 0.62 + 0.06 * (LENGTH / DIAMETER - 5.0) / 5.0
_FINITE_FAST = 0.80 + 0.02 * (LENGTH / DIAMETER - 5.0) / 5.0
#: Drag of a smooth cylinder over the Reynolds number (thousands), as DNV-RP-C205 has it.
_REYNOLDS = (
    10.2110, 15.5435, 24.4349, 35.7199, 60.8808, 86.1747, 118.0864, 149.2623,
    214.7089, 230.9404, 271.5814, 297.0982, 325.2520, 361.9428, 409.7982, 475.3024,
    524.7350, 578.9219, 638.2929, 744.0464, 853.2376, 1068.6857, 1393.3814, 1831.8504,
)  # fmt: skip
_CYLINDER = (
    1.20769, 1.20369, 1.20823, 1.21060, 1.21093, 1.20901, 1.21134, 1.21148,
    1.21171, 1.20109, 1.16918, 1.11163, 1.00926, 0.89411, 0.70855, 0.53155,
    0.40785, 0.32683, 0.28422, 0.29711, 0.32280, 0.38909, 0.47033, 0.53878,
)  # fmt: skip


@pure
def cylinder_drag(speed: float) -> float:
    """Return the drag coefficient of the hull across the flow.

    Args:
        speed: across the hull, m/s.
    """
    reynolds = speed * LENGTH / 1.0e-6
    finite_length = _FINITE_SLOW if reynolds < 2.0e5 else _FINITE_FAST
    thousands = 1.0e-3 * reynolds
    if thousands <= _REYNOLDS[0]:
        return finite_length * _CYLINDER[0]
    for k in range(1, len(_REYNOLDS)):
        if thousands < _REYNOLDS[k]:
            share = (thousands - _REYNOLDS[k - 1]) / (_REYNOLDS[k] - _REYNOLDS[k - 1])
            return finite_length * (_CYLINDER[k - 1] + share * (_CYLINDER[k] - _CYLINDER[k - 1]))
    return finite_length * _CYLINDER[-1]


@pure
def cross_flow(velocity: float, rate: float, coefficient: float) -> tuple[float, float]:
    """Return force (N) and moment (N m) of the drag across the hull, strip by strip.

    Args:
        velocity: across the hull, m/s: vr or wr.
        rate: r or q, rad/s, that adds x times itself (the published model has +x q in heave, too).
        coefficient: of the drag.
    """
    scale = -0.5 * RHO_BODY * DIAMETER * coefficient * _WIDTH
    force = moment = 0.0
    for k in range(STRIPS):
        x = -0.5 * LENGTH + k * _WIDTH
        flow = velocity + x * rate
        strip = scale * abs(flow) * flow
        force += strip
        moment += x * strip
    return force, moment
