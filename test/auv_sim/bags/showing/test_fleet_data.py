"""The content of a fleet's page, without a flight."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.showing import fleet_data as data
from auv_sim.flight.run_record import Run


def straight(start: float, steps: int, east: float, north: float = 0.0) -> RecordedMission:
    """Return a flight north at 1 m/s from the second `start` on."""
    t = start + 0.05 * np.arange(steps)
    columns: dict[str, Any] = {signal: np.full(steps, np.nan) for signal in Run.__dataclass_fields__}
    columns |= {"t": t, "x": north + t, "y": np.full(steps, east), "held": np.zeros(steps)}
    return RecordedMission(Bag(Path("bag")), Run.from_columns(columns), None, None, [])


def numbers(text: str) -> Any:
    return np.frombuffer(base64.b64decode(text), "<f4")


def test_times_begin_with_the_first_vehicle_and_distances_are_of_common_times() -> None:
    flights = {"auv1": straight(1.0, 100, 0.0), "auv2": straight(3.0, 100, 7.0)}
    found = data.fleet_data(flights, {"auv1": "auv1/report.html"}, "pair")
    first, second = found["vehicles"]
    assert numbers(first["t"])[0] == 0.0
    assert numbers(second["t"])[0] == pytest.approx(2.0)
    assert (first["page"], second["page"]) == ("auv1/report.html", "")
    (pair,) = found["pairs"]
    assert numbers(pair["t"])[[0, -1]] == pytest.approx([2.0, 4.95])
    assert numbers(pair["distance"]) == pytest.approx(7.0)
    assert found["closest"].startswith("Closest: auv1 and auv2, 7.00 m at ")


def test_a_long_flight_is_thinned_and_keeps_its_closest_approach() -> None:
    flights = {"auv1": straight(1.0, 20_001, 0.0), "auv2": straight(1.0, 20_001, 5.0)}
    run = flights["auv2"].run
    assert run is not None
    run.y[12_345] = 0.5  # between two of the points that are kept
    (pair,) = data.fleet_data(flights, {}, "pair")["pairs"]
    assert len(numbers(pair["t"])) < 4100
    assert numbers(pair["distance"]).min() == pytest.approx(0.5)
    assert numbers(pair["t"])[-1] == pytest.approx(1000.0)


def test_vehicles_that_are_never_recorded_together_have_no_distance() -> None:
    found = data.fleet_data({"auv1": straight(1.0, 10, 0.0), "auv2": straight(9.0, 10, 0.0)}, {}, "pair")
    assert found["closest"] == "No two vehicles were recorded at one time."
    empty = RecordedMission(Bag(Path("bag")), None, None, None, [])
    found = data.fleet_data({"auv1": empty, "auv2": empty}, {}, "pair")
    assert [vehicle["t"] for vehicle in found["vehicles"]] == ["", ""]
    assert found["table"][1] == ["auv1", *["–"] * 7]
