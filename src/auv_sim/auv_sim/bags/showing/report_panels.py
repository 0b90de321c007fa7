"""The panels of the report's page, over time, and the numbers at its cursor."""

from __future__ import annotations

import math
from typing import Any

from auv_sim.bags.content.events import diagnostic_spans
from auv_sim.bags.content.recorded_mission import RecordedMission

#: Numbers that the page shows at its cursor, where they were recorded.
NOW = [
    {"name": "s", "label": "s", "unit": "", "digits": 3},
    {"name": "x", "label": "north x", "unit": "m", "digits": 2},
    {"name": "y", "label": "east y", "unit": "m", "digits": 2},
    {"name": "x_true", "label": "true north", "unit": "m", "digits": 2},
    {"name": "y_true", "label": "true east", "unit": "m", "digits": 2},
    {"name": "psi", "label": "heading ψ", "unit": "°", "digits": 1},
    {"name": "psi_d", "label": "desired ψd", "unit": "°", "digits": 1},
    {"name": "psi_e", "label": "error", "unit": "°", "digits": 2},
    {"name": "ye", "label": "ye", "unit": "m", "digits": 3},
    {"name": "distance", "label": "distance", "unit": "m", "digits": 3},
    {"name": "distance_by_odometry", "label": "by odometry", "unit": "m", "digits": 3},
    {"name": "rudder_cmd", "label": "rudder cmd", "unit": "°", "digits": 2},
    {"name": "rudder", "label": "rudder", "unit": "°", "digits": 2},
    {"name": "ur", "label": "speed ur", "unit": "m/s", "digits": 2},
    {"name": "thrust_cmd", "label": "thrust", "unit": "N", "digits": 2},
    {"name": "depth", "label": "depth", "unit": "m", "digits": 2},
    {"name": "depth_d", "label": "requested", "unit": "m", "digits": 2},
    {"name": "depth_error", "label": "below path", "unit": "m", "digits": 3},
    {"name": "theta", "label": "pitch", "unit": "°", "digits": 1},
    {"name": "theta_d", "label": "desired pitch", "unit": "°", "digits": 1},
    {"name": "sternplanes", "label": "stern planes", "unit": "°", "digits": 2},
    {"name": "altitude", "label": "altitude", "unit": "m", "digits": 1},
]


def panels(flight: RecordedMission, columns: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the panels that have a recorded signal."""
    hull, erring = flight.vehicle, "x_true" in columns
    angle = [math.degrees(hull.rudder.max_angle)] if hull is not None else []
    rate = [math.degrees(hull.rudder.max_rate)] if hull is not None else []
    found = [
        _panel("Distance to the path (m)", 0.2, [], [
            _series("distance", "true distance" if erring else "geometric distance", "path", 4.0),
            _series("distance_by_odometry", "by odometry", "orange", 1.2),
            _series("ye", "cross-track error ye", "blue"),
        ]),
        _panel("Along-track error xe (m)", 0.2, [], [_series("xe", "xe", "blue")]),
        _panel("Heading (°)", 5.0, [], [
            _series("psi_d", "desired ψd", "path", 4.0, True),
            _series("psi", "measured ψ", "blue", 1.5, True),
        ]),
        _panel("Heading error (°)", 2.0, [], [_series("psi_e", "ψ − ψd", "blue")]),
        _panel("Rudder (°)", 2.0, angle, [
            _series("rudder_cmd", "commanded", "orange", 3.0), _series("rudder", "measured", "blue"),
        ]),
        _panel("Rudder rate (°/s)", 2.0, rate, [_series("rudder_rate", "from row to row", "blue")]),
        *_vertical_panels(flight),
        _panel("Speed through water (m/s)", 0.2, [], [
            _series("ur", "ur", "blue"), _series("vr", "vr", "orange"),
        ]),
        _panel("Current (m/s)", 0.1, [], [
            _series("Vx_true", "true north", "path", 5.0), _series("Vy_true", "true east", "path", 5.0),
            _series("Vx_est", "estimated north", "blue"), _series("Vy_est", "estimated east", "orange"),
            _series("Vz_true", "true down", "path", 5.0), _series("Vz_est", "estimated down", "green"),
        ]),
    ]  # fmt: skip
    for one in found:
        one["series"] = [line for line in one["series"] if line["name"] in columns]
        one["limits"] = [sign * limit for limit in one["limits"] for sign in (1.0, -1.0)]
    return [one for one in found if one["series"]]


def _vertical_panels(flight: RecordedMission) -> list[dict[str, Any]]:
    """Return the panels of a vehicle that dives; the columns of others have none of their signals."""
    planes = flight.vehicle.sternplanes if flight.vehicle is not None else None
    limits = [math.degrees(planes.max_angle)] if planes is not None else []
    at_altitude = flight.mission is not None and flight.mission.altitude is not None
    against = "less the requested one" if at_altitude else "less that of the path"
    lines = [
        _series("depth_path", "path", "path", 5.0), _series("depth_d", "requested", "orange", 2.0),
        _series("depth", "flown", "blue"), _series("bottom", "bottom", "brown"),
    ]  # fmt: skip
    return [
        _panel("Depth (m; down, the surface is 0)", 0.5, [], lines) | {"down": True, "marks": [0.0]},
        _panel("Depth error (m; below is positive)", 0.2, [], [
            _series("depth_error", against, "path", 4.0), _series("ze", "error ze", "blue"),
        ]),
        _panel("Pitch (°; bow up is positive)", 2.0, [], [
            _series("theta_d", "desired", "path", 4.0), _series("theta", "measured", "blue"),
        ]),
        _panel("Stern planes (°; bow down is positive)", 2.0, limits, [
            _series("sternplanes_cmd", "commanded", "orange", 3.0),
            _series("sternplanes", "measured", "blue"),
        ]),
    ]  # fmt: skip


def diagnostics_panel(flight: RecordedMission, start: float) -> list[dict[str, Any]]:
    """Return the panel of the diagnostics, if any were recorded."""
    spans = diagnostic_spans(flight.bag)
    if not spans:
        return []
    rows = [
        {"name": name, "spans": [[a - start, b - start, level, text] for a, b, level, text in parts]}
        for name, parts in sorted(spans.items())
    ]
    return [{"title": "Diagnostics (green OK, orange WARN, red ERROR)", "rows": rows}]


def _panel(title: str, least: float, limits: list[float], lines: list[dict[str, Any]]) -> dict[str, Any]:
    """Return a panel of signals over time.

    Args:
        title: with the unit.
        least: smallest range that is shown.
        limits: magnitudes, drawn on both sides of 0 where they are near.
        lines: of `_series`.
    """
    return {"title": title, "least": least, "limits": limits, "series": lines}


def _series(name: str, label: str, color: str, width: float = 1.5, wraps: bool = False) -> dict[str, Any]:
    """Return one line of a panel."""
    return {"name": name, "label": label, "color": color, "width": width, "wraps": wraps}
