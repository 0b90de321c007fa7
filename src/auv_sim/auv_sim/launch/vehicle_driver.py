"""A vehicle behind a driver in place of the simulator: the driver's parameters, and the emulated vehicle."""

from __future__ import annotations

import dataclasses
import math
import random
import socket
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.driver_parameters import MavlinkDriverParameters
from auv_sim.sim_parameters import PlantParameters

#: Below what DDS uses (from 7400) and what Linux hands out.
_PORTS = range(6000, 7400)
#: The emulated vehicle's name among the mission's processes, and its module.
EMULATOR, EMULATOR_MODULE = "vehicle_emulator", "auv_sim.nodes.mavlink.emulator"


def configure_driver(
    driver: str, address: str | None, speed: float | None, vehicle: str, parameters: dict[str, Any]
) -> tuple[str, ...] | None:
    """Give the driver's node the vehicle's address and the way time passes.

    Args:
        driver: the node's name.
        address: of the vehicle; None for an emulated one.
        speed: of the emulated vehicle, times real time; None for real time on the wall clock.
        vehicle: its file.
        parameters: node name -> settings, changed in place; the emulated vehicle begins as the simulator.

    Returns:
        The command line of the emulated vehicle, None when `address` is given.

    Raises:
        ConfigurationError: a key or a peer that the driver would refuse.
    """
    # Not before there is a driver: its protocol takes as long to import as all else here.
    from auv_sim.nodes.mavlink.peer import Configured
    from auv_sim.nodes.mavlink.signing import load_key

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
        plant: PlantParameters = parameters[topics.PLANT]
        start, current = plant.initial, plant.current
        emulator = (
            "--address", f"udpout:127.0.0.1:{port}",
            "--vehicle", vehicle,
            "--initial", *map(repr, (start.x, start.y, math.degrees(start.psi))),
            "--surge", repr(start.surge),
            "--current", *map(repr, (current.Vx, current.Vy)),
            "--speed", repr(speed or 1.0),
            "--signing-key", given.signing_key,
        )  # fmt: skip
    parameters[driver] = dataclasses.replace(parameters[driver], **changes)
    return emulator


def free_port() -> int:
    """A free UDP port that neither DDS nor Linux will hand out before the driver has it."""
    ports = random.sample(_PORTS, len(_PORTS))
    for port in ports:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
        return port
    raise ConfigurationError("--vehicle-driver", "no free UDP port", f"one of {_PORTS}")
