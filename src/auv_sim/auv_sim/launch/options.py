"""The options of a mission's command line, with their defaults."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_sim.command_line import to_type
from auv_sim.flight.least_share import LEAST_SHARE, LEAST_SHARE_AT_SEA

DEFAULT_MISSION = "paper_composite"
DEFAULT_VEHICLE = "remus100"
DEFAULT_PARAMS = "robust"
#: In place of a parameter file: the default one, with gains by the rule from the vehicle's file.
BY_RULE = "rule"
#: Value of `--vehicle-driver` -> the driver's node.
DRIVERS = {"mavlink": topics.MAVLINK_DRIVER}


@dataclass(frozen=True, kw_only=True)
class Options:
    """Options of the command line; names and units as there."""

    mission: str = DEFAULT_MISSION
    vehicle: str = DEFAULT_VEHICLE
    controller_model: str | None = None
    params: str | None = None
    current: tuple[float, float] | None = None
    upwelling: float | None = None
    initial: tuple[float, float, float] | None = None
    depth: float | None = None
    start_at: str | None = None
    sea: str | None = None
    seed: int | None = None
    switching: str | None = None
    speed: float | None = None
    no_sim: bool = False
    vehicle_driver: str | None = None
    vehicle_address: str | None = None
    use_sim_time: bool = False
    out: Path | None = None
    display: bool = False
    composed: bool = False
    any_processor: bool = False
    namespace: str = "/auv"
    domain: int | None = None
    quiet: bool = False
    force: bool = False
    wait: bool = False
    console: bool = False
    flown: float | None = None

    @property
    def command(self) -> str:
        """The command that flies the same mission again: the options that differ from their defaults."""
        changed = {
            field.name: getattr(self, field.name)
            for field in dataclasses.fields(self)
            if field.name not in ("out", "quiet") and getattr(self, field.name) != field.default
        }
        return to_type("mission.py", **changed)

    @property
    def least_flown(self) -> float:
        """The share of the path below which the mission is incomplete."""
        if self.flown is not None:
            return self.flown
        return LEAST_SHARE_AT_SEA if self.sea else LEAST_SHARE

    @property
    def waits(self) -> bool:
        """Whether an operator starts the mission, and the nodes stay after its end."""
        return self.wait or self.console

    @property
    def simulator(self) -> bool:
        """Whether the suite's simulator is the vehicle."""
        return not self.no_sim and self.vehicle_driver is None

    @property
    def emulator(self) -> bool:
        """Whether an emulated vehicle is started for the driver."""
        return self.vehicle_driver is not None and self.vehicle_address is None
