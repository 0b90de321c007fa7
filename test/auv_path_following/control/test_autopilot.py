"""The autopilot: what it derives for the controller, and that nothing odd reaches the rudder."""

from __future__ import annotations

import dataclasses
import itertools
import math
from typing import NamedTuple

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import DISPATCHED
from auv_msgs_py.values.types import STOP, Navigation, Reference
from auv_path_following import config_files, vehicle
from auv_path_following.abilities import Cruise, Turning
from auv_path_following.control.autopilot import HeadingAutopilot, controller_step, first_state
from auv_path_following.control.controller import ControllerOutput
from auv_path_following.control.derivative import DerivativeConfig
from auv_path_following.control.hull_model import HullModel
from auv_path_following.control.reference_model import ReferenceConfig
from auv_path_following.parameters import AutopilotParameters, GuidanceParameters, ObserverParameters

_NODES = {
    topics.OBSERVER: ObserverParameters,
    topics.GUIDANCE: GuidanceParameters,
    topics.AUTOPILOT: AutopilotParameters,
}
#: Table 4.
CONFIG = params_file.load(config_files.find("params", "paper"), _NODES)[topics.AUTOPILOT].autopilot
REMUS = vehicle.load("remus100")
LIMIT = REMUS.rudder.max_angle
DT = 0.05

_any = st.floats(allow_nan=True, allow_infinity=True)


class Scripted(NamedTuple):
    """Configuration of a controller that always answers the same rudder."""

    rudder: float


class Seen(NamedTuple):
    """State of that controller: all inputs, and the time since the last ones."""

    inputs: tuple = ()


def scripted(config, state, inputs, dt):
    return Seen((*state.inputs, (inputs, dt))), ControllerOutput(config.rudder)


@pytest.fixture(autouse=True)
def _scripted_is_registered(monkeypatch):
    (steps,) = (steps for step, steps in DISPATCHED if step is controller_step)
    monkeypatch.setitem(steps, Scripted, scripted)


def spied(rudder=0.1, config=CONFIG):
    autopilot = HeadingAutopilot(REMUS, config)
    autopilot.config = autopilot.config._replace(controller=Scripted(rudder), controller_begins=Seen())
    autopilot.reset()
    return autopilot


def seen_by(autopilot):
    return autopilot.state.controller.inputs


def heading(psi, r=0.0):
    return Navigation(0.0, 0.0, psi, r)


def reference(psi_d=0.0, r_d=0.0, thrust=6.48):
    return Reference(psi_d, r_d, thrust)


def test_accelerations_are_differences_of_what_came_in():
    autopilot = spied()
    autopilot.update(heading(0.5, r=0.10), reference(0.2, r_d=0.02), 99.0)
    autopilot.update(heading(0.6, r=0.13), reference(0.2, r_d=0.01), DT)
    # The first one has nothing to compare with, and no time has passed.
    (first, first_dt), (second, second_dt) = seen_by(autopilot)
    assert first[:5] == pytest.approx((0.3, 0.10, 0.0, 0.02, 0.0))
    assert second[:5] == pytest.approx((0.4, 0.13, 0.03 / DT, 0.01, -0.01 / DT))
    assert (first_dt, second_dt) == (0.0, DT)


@pytest.mark.parametrize(
    ("psi", "psi_d", "psi_e"),
    [(3.0, -3.0, 6.0 - 2.0 * math.pi), (-3.0, 3.0, 2.0 * math.pi - 6.0), (10.0, 10.0, 0.0)],
)
def test_the_heading_error_takes_the_short_way(psi, psi_d, psi_e):
    out = HeadingAutopilot(REMUS, CONFIG).update(heading(psi), reference(psi_d), 0.0)
    assert out.psi_e == pytest.approx(psi_e)


def test_thrust_is_passed_on_up_to_what_the_vehicle_can():
    autopilot = spied()
    assert autopilot.update(heading(0.0), reference(thrust=3.0), DT).command.thrust == 3.0
    assert autopilot.update(heading(0.0), reference(thrust=60.0), DT).command.thrust == REMUS.thrust_max


@pytest.mark.parametrize(("asked", "given_"), [(2.0, LIMIT), (-2.0, -LIMIT), (0.3, 0.3)])
def test_the_rudder_stays_within_its_stops(asked, given_):
    autopilot = spied(asked)
    assert autopilot.update(heading(0.0), reference(), DT).command.rudder == given_


@pytest.mark.parametrize("thrust", [0.0, -1.0, math.nan])
def test_outside_a_mission_everything_is_neutral_and_the_controller_forgets(thrust):
    autopilot = HeadingAutopilot(REMUS, CONFIG)
    first = [autopilot.update(heading(0.5 + 0.01 * k, 0.2), reference(), DT) for k in range(10)]
    assert first[-1].command.rudder > 0.0
    assert autopilot.update(heading(0.5), reference(thrust=thrust), DT).command == STOP
    # A new start is like the first one: no old rudder, no difference across the pause.
    assert [autopilot.update(heading(0.5 + 0.01 * k, 0.2), reference(), DT) for k in range(10)] == first


def test_new_gains_leave_the_rudder_where_it_is():
    autopilot = HeadingAutopilot(REMUS, CONFIG)
    for _ in range(10):
        before = autopilot.update(heading(0.5), reference(), DT).command.rudder
    autopilot.configure(dataclasses.replace(CONFIG, nism=dataclasses.replace(CONFIG.nism, kp=1e-6)))
    assert autopilot.update(heading(0.5), reference(), DT).command.rudder == pytest.approx(before, abs=1e-6)


def _good(command):
    return abs(command.rudder) <= LIMIT and 0.0 <= command.thrust <= REMUS.thrust_max


@settings(max_examples=200)
@given(st.lists(st.tuples(_any, _any, _any, _any, _any, st.floats(0.0, 10.0)), min_size=1, max_size=6))
def test_whatever_comes_in_the_command_is_finite_and_within_limits(steps):
    autopilot = HeadingAutopilot(REMUS, CONFIG)
    for psi, r, psi_d, r_d, thrust, dt in steps:
        assert _good(autopilot.update(heading(psi, r), reference(psi_d, r_d, thrust), dt).command)
    # And it recovers: from the second good input on it steers again.
    for _ in range(3):
        out = autopilot.update(heading(0.5), reference(), DT)
        assert _good(out.command)
    assert math.isfinite(out.sigma_2)


@pytest.mark.parametrize("position", range(5))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_bad_number_is_a_stop_or_harmless_and_is_forgotten(position, bad):
    clean, hit = HeadingAutopilot(REMUS, CONFIG), HeadingAutopilot(REMUS, CONFIG)
    values = [0.4, 0.1, 0.0, 0.02, 6.48]
    values[position] = bad
    psi, r, psi_d, r_d, thrust = values
    assert _good(hit.update(heading(psi, r), reference(psi_d, r_d, thrust), DT).command)
    hit.reset()
    for k in range(5):
        navigation = heading(0.5 - 0.01 * k, 0.1)
        assert hit.update(navigation, reference(), DT) == clean.update(navigation, reference(), DT)


def test_a_controller_that_loses_its_mind_is_reset_and_the_vehicle_stopped():
    autopilot = spied(math.nan)
    assert autopilot.update(heading(0.5), reference(), DT).command == STOP
    assert autopilot.state == first_state(autopilot.config)


def test_it_turns_a_simple_ship_onto_its_course():
    """A first-order turning model with the hull's signs: positive rudder turns to port."""
    for psi0, psi_d in itertools.product([0.0, 2.5], [0.6, -0.6]):
        autopilot, psi, r = HeadingAutopilot(REMUS, CONFIG), psi0, 0.0
        for k in range(1200):
            out = autopilot.update(heading(psi, r), reference(psi_d), DT if k else 0.0)
            r += DT * (-out.command.rudder - r) / 0.5
            psi += DT * r
        assert abs(out.psi_e) < 0.02


def test_the_filter_behind_dr_dt_quiets_a_noisy_gyro_and_is_off_by_default():
    """Both see the same noisy gyro; the clean part is a slow turn."""

    def largest(bandwidth):
        config = dataclasses.replace(CONFIG, derivative=DerivativeConfig(bandwidth=bandwidth))
        autopilot = spied(config=config)
        for k in range(200):
            r = 0.01 * math.sin(0.02 * k) + (0.002 if k % 2 else -0.002)
            autopilot.update(Navigation(0.0, 0.0, 0.0, r), Reference(0.0, 0.0, 6.0), DT if k else 0.0)
        return max(abs(inputs.r_dot) for inputs, _ in seen_by(autopilot)[20:])

    assert CONFIG.derivative.bandwidth == 0.0
    assert largest(0.0) > 0.08  # 0.004 rad/s in 0.05 s
    assert largest(5.0) < 0.02


def test_the_filter_forgets_with_the_mission_and_takes_a_new_bandwidth():
    autopilot = spied(config=dataclasses.replace(CONFIG, derivative=DerivativeConfig(bandwidth=5.0)))
    for k in range(10):
        autopilot.update(Navigation(0.0, 0.0, 0.0, 0.1 * k), Reference(0.0, 0.0, 6.0), DT if k else 0.0)
    assert 0.0 < seen_by(autopilot)[-1][0].r_dot < 2.0
    autopilot.update(Navigation(0.0, 0.0, 0.0, 1.0), Reference(0.0, 0.0, 0.0), DT)
    autopilot.update(Navigation(0.0, 0.0, 0.0, 5.0), Reference(0.0, 0.0, 6.0), DT)
    assert seen_by(autopilot)[-1][0].r_dot == 0.0


def test_gains_that_the_vehicle_cannot_bear_change_nothing():
    """Without a hull no limit of the reference can be derived."""
    measured = dataclasses.replace(
        REMUS,
        hull=None,
        cruise=vehicle.Cruise(thrust=6.0, speed=2.0),
        turning=vehicle.Turning(radius=6.0),
    )
    own = ReferenceConfig(enabled=True, max_rate=0.3, max_acceleration=0.2, max_jerk=0.5)
    config = dataclasses.replace(CONFIG, reference=own)
    autopilot = HeadingAutopilot(measured, config)
    prepared = autopilot.config
    wrong = dataclasses.replace(
        config,
        reference=dataclasses.replace(own, max_jerk=0.0),
        nism=dataclasses.replace(config.nism, k1=0.1),
        derivative=DerivativeConfig(bandwidth=3.0),
    )
    with pytest.raises(ConfigurationError, match=r"hull: found nothing to derive reference\.max_jerk from"):
        autopilot.configure(wrong)
    with pytest.raises(ConfigurationError, match="hull"):
        autopilot.configure(dataclasses.replace(config, controller="smc"))
    assert autopilot.config is prepared


@pytest.mark.parametrize("rate", [10.0, 573.0, 574.0, 1e6])
def test_a_rudder_however_fast_gives_a_kp(rate):
    """1e6 deg/s is how some write that their rudder has no rate limit worth a number."""
    fast = dataclasses.replace(REMUS, rudder=dataclasses.replace(REMUS.rudder, max_rate_deg_s=rate))
    config = dataclasses.replace(CONFIG, nism=dataclasses.replace(CONFIG.nism, kp_from_rudder=True))
    nism = HeadingAutopilot(fast, config).config.controller.gains
    assert 0.0 < nism.kp <= min(fast.rudder.max_rate, 10.0)
    assert HullModel(fast).b * nism.kp * nism.k5 <= 12.0 * (1.0 + 1e-9)
    measured = dataclasses.replace(
        fast, hull=None, cruise=Cruise(thrust=6.48, speed=2.0), turning=Turning(radius=9.0)
    )
    kp = HeadingAutopilot(measured, config).config.controller.gains.kp  # b = 1.8 u^2/L^2: no hull
    assert kp == pytest.approx(min(fast.rudder.max_rate, 12.0 / (1.8 * (2.0 / 1.6) ** 2 * nism.k5)))


@pytest.mark.parametrize("k5", [5.0, 15.0, 200.0])
@pytest.mark.parametrize(
    "name", [name for name in config_files.shipped("vehicles") if name != "mss_remus100"]
)
def test_a_shipped_hull_takes_its_rudders_whole_rate_whatever_k5(name, k5):
    hull = vehicle.load(name)
    config = dataclasses.replace(CONFIG, nism=dataclasses.replace(CONFIG.nism, kp_from_rudder=True, k5=k5))
    assert HeadingAutopilot(hull, config).config.controller.gains.kp == hull.rudder.max_rate
