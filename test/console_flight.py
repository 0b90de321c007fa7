"""A recorded flight for the console's page: rows and course as the server would send them.

cd test && python3 -m console_flight    # fly both missions again and renew data/console_flight.npz
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FILE = Path(__file__).with_name("data") / "console_flight.npz"
#: Column -> (unit, label), in the order of a row.
COLUMNS = {
    "t": ("s", "time"), "x": ("m", "east"), "y": ("m", "north"), "z": ("m", "up"), "yaw": ("rad", "yaw"),
    "u": ("m/s", "speed through water"),
    "ve": ("m/s", "east over ground"), "vn": ("m/s", "north over ground"),
    "xe": ("m", "xe"), "ye": ("m", "ye"), "ze": ("m", "ze"), "s": ("m", "way"),
    "rudder": ("rad", "rudder"), "planes": ("rad", "planes"), "thrust": ("N", "thrust"),
    "yaw_ref": ("rad", "reference"), "pitch": ("rad", "pitch"), "depth_ref": ("m", "requested depth"),
    "current_east": ("m/s", "current east"), "current_north": ("m/s", "current north"),
    "altitude": ("m", "altitude"), "true_x": ("m", "true east"), "true_y": ("m", "true north"),
    "true_z": ("m", "true up"),
}  # fmt: skip
MISSIONS = {"survey_wgs84": "remus100", "helix": "remus100_6dof"}


def recorded(mission: str) -> tuple[NDArray[np.float32], dict[str, Any]]:
    """Return the rows, shape (n, columns), and the course of a flight, as in the protocol."""
    with np.load(FILE) as stored:
        rows, path, joints = (stored[f"{mission}_{part}"] for part in ("rows", "path", "joints"))
        fence, origin = stored[f"{mission}_fence"], stored[f"{mission}_origin"]
    length = float(path[-1, 3])
    return rows, {
        "kind": "course", "vehicle": 0, "path": path.tolist(),
        "joints": [dict(zip("xyzs", joint, strict=True), kind="line") for joint in joints.tolist()],
        "fence": fence.tolist(),
        "origin": dict(zip(("latitude", "longitude", "altitude"), origin.tolist(), strict=True))
        if len(origin) else None,
        "mission": {"name": mission, "digest": "4f2a91c07d3e", "length": length},
        "dives": bool(np.isfinite(rows[:, 13]).any()),
    }  # fmt: skip


def _flown(mission: str, vehicle: str) -> dict[str, NDArray[Any]]:
    from auv_sim.flight.closed_loop import fly
    from auv_sim.launch.mission_plan import scenario
    from auv_sim.launch.options import Options

    flight = scenario(Options(mission=mission, vehicle=vehicle, current=(0.1, 0.2)))
    run: Any = fly(flight)
    every = slice(None, None, 20)
    unknown = np.full(run.steps, np.nan)

    def of(name: str) -> NDArray[np.float64]:
        return getattr(run, name, unknown)

    u, v, psi = run.ur, run.vr, run.psi
    line = flight.path.polyline(5.0)
    north, east, s = line[0], line[1], line[-1]
    way = np.r_[0.0, np.cumsum(np.hypot(np.diff(north), np.diff(east)))]
    true_north, true_east = run.Vx_true, run.Vy_true
    columns = [
        run.t - run.t[0], run.y, run.x, -of("z"), math.pi / 2 - psi, u,
        u * np.sin(psi) + v * np.cos(psi) + true_east, u * np.cos(psi) - v * np.sin(psi) + true_north,
        run.xe, run.ye, of("ze"), np.interp(run.s, s, way), run.rudder_cmd,
        of("sternplanes_cmd"), run.thrust_cmd,
        math.pi / 2 - run.psi_d, of("theta"), of("depth_d"), run.Vy_est, run.Vx_est, of("altitude"),
        unknown, unknown, unknown,
    ]  # fmt: skip
    rows = np.stack(columns, axis=1)[every].astype(np.float32)
    depth = line[2] if len(line) == 4 else np.full(len(s), np.nan)
    path = np.stack([east, north, -depth, way], axis=1)
    whole = [int(np.argmin(np.abs(s - k))) for k in range(1, flight.path.n)]
    side = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    middle, half = (path[:, :2].max(0) + path[:, :2].min(0)) / 2, np.ptp(path[:, :2], axis=0) / 2 + 40.0
    origin = np.array([63.4470, 10.3990, 0.0]) if mission == "survey_wgs84" else np.array([])
    parts = {"rows": rows, "path": path, "joints": path[whole], "fence": middle + side * half}
    return {f"{mission}_{name}": value for name, value in (parts | {"origin": origin}).items()}


if __name__ == "__main__":
    made: dict[str, NDArray[Any]] = {}
    for mission, vehicle in MISSIONS.items():
        made |= _flown(mission, vehicle)
    np.savez_compressed(FILE, **made)  # type: ignore[arg-type]
    print(f"{FILE}: {FILE.stat().st_size} bytes", {name: value.shape for name, value in made.items()})
