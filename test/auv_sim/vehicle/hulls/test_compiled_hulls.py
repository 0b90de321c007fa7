"""The hulls compile unchanged, with the same result but for rounding in the C library."""

from __future__ import annotations

from typing import Any

import pytest

from auv_sim.flight.batch.compiled import COMPILED, compiled, take_over_pure
from auv_sim.vehicle.hulls.mss_remus100 import mss_remus100, mss_remus100_step
from auv_sim.vehicle.hulls.remus_6dof import remus_6dof_step
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from hulls import SIX_DOF

INPUTS = ((0.1, 0.1, 0.1), (0.05, 0.05, 0.05), 5.0, (0.1, 0.2, 0.05))

take_over_pure()


def fly_remus(config: Any, body: BodyState, steps: int) -> BodyState:
    for _ in range(steps):
        body, _ = remus_6dof_step(config, body, INPUTS, 0.02)
    return body


def fly_mss(config: Any, body: BodyState, steps: int) -> BodyState:
    for _ in range(steps):
        body, _ = mss_remus100_step(config, body, INPUTS, 0.02)
    return body


@pytest.mark.skipif(not COMPILED, reason="Numba is not installed")
@pytest.mark.parametrize(
    ("fly", "config"), [(fly_remus, SIX_DOF), (fly_mss, mss_remus100())], ids=["remus_6dof", "mss_remus100"]
)
def test_compiled_as_in_python(fly: Any, config: Any) -> None:
    body = body_at(0.0, 0.0, 20.0, 0.1, 0.05, 0.3, 1.5)
    assert compiled(fly)(config, body, 500) == pytest.approx(fly(config, body, 500), abs=1e-9)
