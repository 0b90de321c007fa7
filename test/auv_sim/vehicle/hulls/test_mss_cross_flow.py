"""Drag across the hull of the Marine Systems Simulator."""

from __future__ import annotations

from auv_sim.vehicle.hulls.mss_cross_flow import cross_flow


def test_cross_flow_opposes_the_motion() -> None:
    assert cross_flow(0.5, 0.0, 0.8)[0] < 0.0 < cross_flow(-0.5, 0.0, 0.8)[0]
    assert cross_flow(0.0, 0.3, 0.8)[1] < 0.0 < cross_flow(0.0, -0.3, 0.8)[1]
