"""The propeller of the Marine Systems Simulator's hull."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.vehicle.hulls.mss_propeller import propeller_loads, revolutions_for


@given(st.floats(0.0, 20.0), st.floats(0.0, 2.5))
def test_revolutions_give_the_thrust_that_is_asked_for(thrust: float, speed: float) -> None:
    assert propeller_loads(revolutions_for(thrust, speed), speed)[0] == pytest.approx(thrust, abs=1e-9)
