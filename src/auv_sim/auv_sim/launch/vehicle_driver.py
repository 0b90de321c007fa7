"""A vehicle behind a driver in place of the simulator: the driver's parameters and the emulator's command."""

from __future__ import annotations

import dataclasses
import math
import random
import socket
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.driver_parameters import MavlinkDriverParameters
from auv_sim.launch.processes.claims import claim
from auv_sim.sim_parameters import PlantParameters

#: UDP ports below those of DDS (from 7400) and the ephemeral ports of Linux.
_PORTS = range(6000, 7400)
#: Claims of this process on the ports that it has chosen: whatever binds them may be up only much later.
_CLAIMS: list[socket.socket] = []
#: The emulated vehicle's name among the mission's processes, and its module.
EMULATOR, EMULATOR_MODULE = "vehicle_emulator", "auv_sim.nodes.mavlink.emulator"


def configure_driver(
    driver: str, address: str | None, speed: float | None, vehicle: str, dives: bool,
    parameters: dict[str, Any],
) -> tuple[str, ...] | None:  # fmt: skip
    """Set the driver's vehicle address and clock.

    Args:
        driver: the node's name.
        address: of the vehicle; None for an emulated one.
        speed: of the emulated vehicle, times real time; None for real time on the wall clock.
        vehicle: its file.
        dives: whether it has stern planes.
        parameters: node name -> settings, changed in place; the emulator starts in the simulator's state.

    Returns:
        The command line of the emulated vehicle, None when `address` is given.

    Raises:
        ConfigurationError: a key or a peer that the driver would refuse.
    """
    # Imported only for a driver: MAVLink takes as long to import as all else here.
    from auv_sim.nodes.mavlink.transport.peer import Configured
    from auv_sim.nodes.mavlink.transport.signing import load_key

    given: MavlinkDriverParameters = parameters[driver]
    load_key(given.signing_key, f"{driver}.signing_key")
    if given.peer:
        Configured(given.peer, f"{driver}.peer")
    changes: dict[str, Any] = {"vehicle": vehicle}
    emulator = None
    if address is not None:
        changes["address"] = address
    else:
        port = free_port()
        changes |= {"address": f"udpin:127.0.0.1:{port}", "clock_speed": speed or 0.0}
        plant = parameters[topics.PLANT]
        emulator = _emulator(port, vehicle, plant, speed or 1.0, given.signing_key)
        emulator += _diving(plant) if dives else ()
    parameters[driver] = dataclasses.replace(given, **changes)
    return emulator


def _emulator(
    port: int, vehicle: str, plant: PlantParameters, speed: float, signing_key: str
) -> tuple[str, ...]:
    """Return the emulator's command line; it starts in the simulator's state."""
    start, current = plant.initial, plant.current
    return (
        "--address", f"udpout:127.0.0.1:{port}",
        "--vehicle", vehicle,
        "--initial", *map(repr, (start.x, start.y, math.degrees(start.psi))),
        "--surge", repr(start.surge),
        "--current", *map(repr, (current.Vx, current.Vy)),
        "--speed", repr(speed),
        "--signing-key", signing_key,
    )  # fmt: skip


def _diving(plant: PlantParameters) -> tuple[str, ...]:
    """Return the emulator's options for the depth, pitch and upwelling of a vehicle with stern planes."""
    depth, pitch, up = plant.initial.depth, math.degrees(plant.initial.theta), -plant.current.Vz
    return "--depth", repr(depth), "--pitch", repr(pitch), "--upwelling", repr(up)


def free_port() -> int:
    """Return a free UDP port outside the ranges of DDS and of Linux's ephemeral ports.

    No other caller on this machine gets it until this process ends.
    """
    ports = random.sample(_PORTS, len(_PORTS))
    for port in ports:
        held = claim(f"udp_port/{port}")
        if held is None:
            continue
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                held.close()
                continue
        _CLAIMS.append(held)
        return port
    raise ConfigurationError("--vehicle-driver", "no free UDP port", f"one of {_PORTS}")
