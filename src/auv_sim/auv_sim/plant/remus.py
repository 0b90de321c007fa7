"""REMUS in the horizontal plane: kinematics Eq. (14), dynamics Eqs. (18), (19), fourth-order Runge-Kutta."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.types import NO_CURRENT, Command, Current, Navigation, WaterVelocity
from auv_path_following.vehicle import Vehicle
from auv_sim.plant.actuator import RudderFlaws, RudderServo


class PlantState(NamedTuple):
    """x, y (m, north, east), psi (rad, unwrapped), ur, vr (m/s through the water, FRD), r (rad/s)."""

    x: float
    y: float
    psi: float
    ur: float
    vr: float
    r: float


class RemusDynamics:
    """Eqs. (18), (19) for one hull: the mass matrix is inverted once.

    Args:
        vehicle: the hull's coefficients.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self.hull = h = vehicle.coefficients
        determinant = (h.m - h.Yvd) * (h.Izz - h.Nrd) - h.Yrd * h.Nvd
        self.inv_x = 1.0 / (h.m - h.Xud)
        self.inv_vv = (h.Izz - h.Nrd) / determinant
        self.inv_vr = h.Yrd / determinant
        self.inv_rv = h.Nvd / determinant
        self.inv_rr = (h.m - h.Yvd) / determinant
        # Prestero has the rigid-body term m vr r in surge; the paper's Eq. (19) leaves it out.
        self.Xvr = h.Xvr + (h.m if h.surge_coupling else 0.0)

    def derivative(
        self, state: PlantState, delta: float, thrust: float, current: Current
    ) -> tuple[float, float, float, float, float, float]:
        """d state/dt with the rudder at `delta` (rad), thrust in N and the current in m/s, NED."""
        _, _, psi, ur, vr, r = state
        h = self.hull
        SX = h.Xuu * ur * abs(ur) + self.Xvr * vr * r + h.Xrr * r * r + thrust
        SY = (
            h.Yvv * vr * abs(vr) + h.Yrr * r * abs(r) + (h.Yur - h.m) * ur * r + h.Yuv * ur * vr
            + h.Yuud * ur * ur * delta
        )  # fmt: skip
        SN = (
            h.Nvv * vr * abs(vr) + h.Nrr * r * abs(r) + h.Nur * ur * r + h.Nuv * ur * vr
            + h.Nuud * ur * ur * delta
        )  # fmt: skip
        cos_psi, sin_psi = math.cos(psi), math.sin(psi)
        return (
            ur * cos_psi - vr * sin_psi + current.Vx,
            ur * sin_psi + vr * cos_psi + current.Vy,
            r,
            self.inv_x * SX,
            self.inv_vv * SY + self.inv_vr * SN,
            self.inv_rv * SY + self.inv_rr * SN,
        )


class RemusPlant:
    """The simulated vehicle: hull and rudder servo in a current.

    Args:
        vehicle: hull, rudder, thruster.
        initial: state to begin with, and to go back to on reset.
        max_step: longest Runge-Kutta step, s; longer steps are divided.
        flaws: of the rudder's servo; none if None.
    """

    #: The longest Runge-Kutta step unless another is asked for, s.
    MAX_STEP = 0.05

    def __init__(
        self,
        vehicle: Vehicle,
        initial: PlantState,
        max_step: float = MAX_STEP,
        flaws: RudderFlaws | None = None,
    ) -> None:
        self.vehicle = vehicle
        self.dynamics = RemusDynamics(vehicle)
        self.initial = initial
        self.max_step = max_step
        self.flaws = flaws
        self.reset()

    def reset(self) -> None:
        """Back to the initial state, rudder neutral."""
        self.state = self.initial
        limits = self.vehicle.rudder
        self.rudder = RudderServo(limits.max_angle, limits.max_rate, self.flaws)

    def advance(
        self, command: Command, dt: float, current: Current = NO_CURRENT, efficiency: float = 1.0
    ) -> None:
        """Let `dt` seconds pass under a held command and current.

        Args:
            command: rudder and thrust.
            dt: s.
            current: m/s, NED.
            efficiency: what the propeller makes of its thrust; 1 is all of it.
        """
        self.rudder.command(command.rudder)
        thrust = min(max(command.thrust, 0.0), self.vehicle.thrust_max) * efficiency
        steps = max(1, math.ceil(dt / self.max_step - 1e-9))
        for _ in range(steps):
            self._runge_kutta(thrust, dt / steps, current)

    def _runge_kutta(self, thrust: float, h: float, current: Current) -> None:
        f = self.dynamics.derivative
        state = self.state
        rudder = self.rudder
        delta, delta_half, delta_end = rudder.fin, rudder.fin_after(0.5 * h), rudder.fin_after(h)
        k1 = f(state, delta, thrust, current)
        k2 = f(moved(state, k1, 0.5 * h), delta_half, thrust, current)
        k3 = f(moved(state, k2, 0.5 * h), delta_half, thrust, current)
        k4 = f(moved(state, k3, h), delta_end, thrust, current)
        self.state = PlantState(
            *[
                value + h / 6.0 * (a + 2.0 * (b + c) + d)
                for value, a, b, c, d in zip(state, k1, k2, k3, k4, strict=True)
            ]
        )
        self.rudder.advance(h)

    @property
    def navigation(self) -> Navigation:
        """The ideal navigation's measurement."""
        x, y, psi, _, _, r = self.state
        return Navigation(x, y, psi, r)

    @property
    def water_velocity(self) -> WaterVelocity:
        """The ideal water-track log's measurement."""
        return WaterVelocity(self.state.ur, self.state.vr)

    def ground_velocity(self, current: Current) -> tuple[float, float]:
        """(u, v) over ground in the body frame, m/s: Eqs. (15), (16) with the signs that Eq. (14) demands."""
        _, _, psi, ur, vr, _ = self.state
        cos_psi, sin_psi = math.cos(psi), math.sin(psi)
        uc = current.Vx * cos_psi + current.Vy * sin_psi
        vc = -current.Vx * sin_psi + current.Vy * cos_psi
        return ur + uc, vr + vc


def moved(state: PlantState, slope: tuple[float, float, float, float, float, float], h: float) -> PlantState:
    """The state after `h` seconds at a constant slope."""
    return PlantState(
        state[0] + h * slope[0],
        state[1] + h * slope[1],
        state[2] + h * slope[2],
        state[3] + h * slope[3],
        state[4] + h * slope[4],
        state[5] + h * slope[5],
    )
