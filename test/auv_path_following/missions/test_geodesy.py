"""Degrees to metres and back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following.missions.geodesy import Origin, to_geodetic, to_ned

origins = st.builds(
    lambda latitude, longitude: Origin(latitude_deg=latitude, longitude_deg=longitude),
    st.floats(-80.0, 80.0),
    st.floats(-180.0, 180.0),
)


@given(origins, st.floats(-50e3, 50e3), st.floats(-50e3, 50e3))
def test_metres_to_degrees_and_back(origin, north, east):
    latitude, longitude = to_geodetic(origin, [north], [east])
    x, y = to_ned(origin, latitude, longitude)
    assert (x[0], y[0]) == pytest.approx((north, east), abs=1e-6)


@given(st.floats(-80.0, 80.0))
def test_a_small_step_north_is_as_long_as_the_meridian_says(latitude):
    """Radii of curvature of the WGS 84 ellipsoid, from its textbook formulas."""
    a, e2 = 6378137.0, 6.69437999014e-3
    sin = np.sin(np.radians(latitude))
    meridian, normal = a * (1 - e2) / (1 - e2 * sin**2) ** 1.5, a / np.sqrt(1 - e2 * sin**2)
    step = np.radians(1e-4)
    origin = Origin(latitude_deg=latitude, longitude_deg=12.0)
    north, east = to_ned(origin, [latitude + 1e-4, latitude], [12.0, 12.0 + 1e-4])
    assert north[0] == pytest.approx(meridian * step, rel=1e-5)
    assert east[1] == pytest.approx(normal * np.cos(np.radians(latitude)) * step, rel=1e-5)
