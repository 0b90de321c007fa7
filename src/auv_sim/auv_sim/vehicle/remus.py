"""REMUS in the horizontal plane: kinematics Eq. (14), dynamics Eqs. (18), (19), fourth-order Runge-Kutta."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from auv_msgs_py.values.pure import dispatched, pure
from auv_msgs_py.values.types import Command, Current, Navigation
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.fins.actuator import Deflection, ServoState, servo_at, servo_of, servo_step

#: Longest Runge-Kutta step, s; longer steps are divided.
MAX_STEP = 0.05


class PlantState(NamedTuple):
    """x, y (m, north, east), psi (rad, unwrapped), ur, vr (m/s through the water, FRD), r (rad/s)."""

    x: float
    y: float
    psi: float
    ur: float
    vr: float
    r: float


class PlanarHull(NamedTuple):
    """Configuration of a hull: the inverse of Eq. (18)'s mass matrix, and the coefficients of Eq. (19).

    `Xvr` and `Yur` have the rigid-body terms with m.
    """

    inv_x: float
    inv_vv: float
    inv_vr: float
    inv_rv: float
    inv_rr: float
    Xuu: float
    Xvr: float
    Xrr: float
    Yvv: float
    Yrr: float
    Yur: float
    Yuv: float
    Yuud: float
    Nvv: float
    Nrr: float
    Nur: float
    Nuv: float
    Nuud: float


def planar_hull_of(vehicle: Vehicle) -> PlanarHull:
    """Return the configuration of a vehicle's hull.

    Raises:
        ConfigurationError: the vehicle file has no hull.
    """
    h = vehicle.coefficients
    determinant = (h.m - h.Yvd) * (h.Izz - h.Nrd) - h.Yrd * h.Nvd
    return PlanarHull(
        1.0 / (h.m - h.Xud),
        (h.Izz - h.Nrd) / determinant,
        h.Yrd / determinant,
        h.Nvd / determinant,
        (h.m - h.Yvd) / determinant,
        h.Xuu,
        # Prestero has the rigid-body term m vr r in surge; the paper's Eq. (19) leaves it out.
        h.Xvr + (h.m if h.surge_coupling else 0.0),
        *(h.Xrr, h.Yvv, h.Yrr, h.Yur - h.m, h.Yuv, h.Yuud, h.Nvv, h.Nrr, h.Nur, h.Nuv, h.Nuud),
    )


#: Rudder during the step, thrust (N), current (m/s, NED).
HullInputs = tuple[Deflection, float, Current]


@pure
def planar_slopes(
    hull: Sequence[float], psi: float, ur: float, vr: float, r: float, delta: float, thrust: float
) -> tuple[float, float, float, float, float]:
    """Return x' and y' in still water, and ur', vr', r': Eqs. (14), (18), (19).

    Args:
        hull: a `PlanarHull`, or its numbers in that order.
        psi, ur, vr, r: as in `PlantState`.
        delta: rudder angle, rad.
        thrust: N.
    """
    (inv_x, inv_vv, inv_vr, inv_rv, inv_rr, Xuu, Xvr, Xrr,
     Yvv, Yrr, Yur, Yuv, Yuud, Nvv, Nrr, Nur, Nuv, Nuud) = hull  # fmt: skip
    sway, yaw = vr if vr >= 0.0 else -vr, r if r >= 0.0 else -r
    SX = Xuu * ur * abs(ur) + Xvr * vr * r + Xrr * r * r + thrust
    SY = Yvv * vr * sway + Yrr * r * yaw + Yur * ur * r + Yuv * ur * vr + Yuud * ur * ur * delta
    SN = Nvv * vr * sway + Nrr * r * yaw + Nur * ur * r + Nuv * ur * vr + Nuud * ur * ur * delta
    cos_psi, sin_psi = math.cos(psi), math.sin(psi)
    return (
        ur * cos_psi - vr * sin_psi,
        ur * sin_psi + vr * cos_psi,
        inv_x * SX,
        inv_vv * SY + inv_vr * SN,
        inv_rv * SY + inv_rr * SN,
    )


@pure
def planar_step(
    config: PlanarHull, state: PlantState, inputs: HullInputs, dt: float
) -> tuple[PlantState, PlantState]:
    """Take one Runge-Kutta step, written flat; the output is the state."""
    hull = config[:]  # a plain tuple, which unpacks four times as fast as a named one
    x, y, psi, ur, vr, r = state
    (begin, middle, end), thrust, (Vx, Vy) = inputs
    half, sixth = 0.5 * dt, dt / 6.0
    x1, y1, u1, v1, r1 = planar_slopes(hull, psi, ur, vr, r, begin, thrust)
    ra = r + half * r1
    x2, y2, u2, v2, r2 = planar_slopes(
        hull, psi + half * r, ur + half * u1, vr + half * v1, ra, middle, thrust
    )
    rb = r + half * r2
    x3, y3, u3, v3, r3 = planar_slopes(
        hull, psi + half * ra, ur + half * u2, vr + half * v2, rb, middle, thrust
    )
    rc = r + dt * r3
    x4, y4, u4, v4, r4 = planar_slopes(hull, psi + dt * rb, ur + dt * u3, vr + dt * v3, rc, end, thrust)
    state = PlantState(
        x + sixth * (x1 + Vx + 2.0 * (x2 + Vx + (x3 + Vx)) + (x4 + Vx)),
        y + sixth * (y1 + Vy + 2.0 * (y2 + Vy + (y3 + Vy)) + (y4 + Vy)),
        psi + sixth * (r + 2.0 * (ra + rb) + rc),
        ur + sixth * (u1 + 2.0 * (u2 + u3) + u4),
        vr + sixth * (v1 + 2.0 * (v2 + v3) + v4),
        r + sixth * (r1 + 2.0 * (r2 + r3) + r4),
    )
    return state, state


#: One step of a hull: (configuration, state, `HullInputs`, dt) -> (state, `PlantState`).
hull_step = dispatched({PlanarHull: planar_step})


class Plant(NamedTuple):
    """Configuration of a hull with its rudder and propeller.

    Attributes:
        hull, servo: of `hull_step` and `servo_step`.
        thrust_max: N.
        max_step: longest Runge-Kutta step, s.
    """

    hull: Any
    servo: Any
    thrust_max: float
    max_step: float = MAX_STEP


class Afloat(NamedTuple):
    """State of a plant: that of its hull and of its servo."""

    hull: Any
    servo: Any


#: Command, current (m/s, NED), and the propeller's efficiency: 1 for the thrust as commanded.
PlantInputs = tuple[Command, Current, float]


def plant_of(vehicle: Vehicle) -> Plant:
    """Return the configuration of a vehicle whose servo is ideal but for its dead time.

    Raises:
        ConfigurationError: the vehicle file has no hull.
    """
    return Plant(planar_hull_of(vehicle), servo_of(vehicle.rudder), vehicle.newtons(vehicle.thrust_max))


def plant_at(hull: PlantState, plant: Plant | None = None) -> Afloat:
    """Return the state of a plant with its servo in neutral; of one with an ideal servo if None."""
    return Afloat(PlantState(*map(float, hull)), ServoState() if plant is None else servo_at(plant.servo))


@pure
def plant_step(config: Plant, state: Afloat, inputs: PlantInputs, dt: float) -> tuple[Afloat, PlantState]:
    """Advance by `dt` seconds under a held command and current; the output is the hull's motion."""
    hull, servo = state
    command, current, efficiency = inputs
    order, thrust = command
    largest = config.thrust_max
    thrust = (0.0 if thrust < 0.0 else largest if thrust > largest else thrust) * efficiency
    substeps = 1 if dt <= config.max_step else math.ceil(dt / config.max_step - 1e-9)
    h = dt / substeps
    servo, rudder = servo_step(config.servo, servo, (order, True), h)
    hull, motion = hull_step(config.hull, hull, (rudder, thrust, current), h)
    while substeps > 1:
        substeps -= 1
        servo, rudder = servo_step(config.servo, servo, (order, False), h)
        hull, motion = hull_step(config.hull, hull, (rudder, thrust, current), h)
    return Afloat(hull, servo), motion


@pure
def ground_velocity(state: PlantState, current: Current) -> tuple[float, float]:
    """Return (u, v) over ground, m/s, FRD: Eqs. (15), (16) with the signs that Eq. (14) demands."""
    cos_psi, sin_psi = math.cos(state.psi), math.sin(state.psi)
    uc = current.Vx * cos_psi + current.Vy * sin_psi
    vc = -current.Vx * sin_psi + current.Vy * cos_psi
    return state.ur + uc, state.vr + vc


@pure
def navigation_of(state: PlantState) -> Navigation:
    """Return ideal navigation."""
    return Navigation(state.x, state.y, state.psi, state.r)
