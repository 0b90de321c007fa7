"""The options of a mission's command line, with their defaults, and which of them exclude each other."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.command_line import to_type
from auv_sim.flight.least_share import LEAST_SHARE, LEAST_SHARE_AT_SEA

DEFAULT_MISSION = "paper_composite"
DEFAULT_VEHICLE = "remus100"
DEFAULT_PARAMS = "robust"
#: In place of a parameter file: the default one, with gains by the rule from the vehicle's file.
BY_RULE = "rule"
#: Value of `--vehicle-driver` -> the driver's node.
DRIVERS = {"mavlink": topics.MAVLINK_DRIVER}
#: Options that concern a fleet as a whole.
_OF_FLEET = ("speed", "out", "composed", "any_processor", "domain", "flown", "force", "quiet", "console")


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


def common_options(given: dict[str, Any]) -> Options:
    """Return the options of a fleet's command line.

    Args:
        given: name -> value, as the command line has them.

    Raises:
        ConfigurationError: an option that the fleet's file holds for each vehicle.
    """
    for name, value in given.items():
        if name not in _OF_FLEET and value != getattr(Options, name):
            option = f"--{name.replace('_', '-')}"
            raise ConfigurationError(
                option, "together with --fleet", "it in the fleet's file, if there is such a key"
            )
    _require_console(given["console"])
    return Options(**given)


def checked_options(given: dict[str, Any]) -> Options:
    """Return the options that a command line names.

    Args:
        given: name -> value, as the command line has them.

    Raises:
        ConfigurationError: two options contradict each other, or an address is none.
    """
    for name in ("current", "initial"):
        given[name] = tuple(given[name]) if given[name] is not None else None
    options = Options(**given)
    _require_console(options.console)
    if options.vehicle_address is not None:
        if options.vehicle_driver is None:
            raise ConfigurationError("--vehicle-address", "no --vehicle-driver", "both")
        from auv_sim.nodes.mavlink.transport.link import parse_address

        parse_address(options.vehicle_address, "--vehicle-address")
    if options.no_sim and options.vehicle_driver is not None:
        raise ConfigurationError("--vehicle-driver", "together with --no-sim", "one of them")
    _check_simulated(options)
    if options.use_sim_time and (options.simulator or options.emulator):
        raise ConfigurationError(
            "--use-sim-time", "without --no-sim", "both (the simulator always has its own clock)"
        )
    return options


def _require_console(is_asked: bool) -> None:
    """Refuse a console without its library, before anything starts."""
    if is_asked:
        from auv_sim.launch.operation.console_child import require_library

        require_library()


def _check_simulated(options: Options) -> None:
    """Refuse options for the simulator where there is none."""
    conflicts: dict[str, Any] = {"--sea": options.sea, "--seed": options.seed}
    if not options.emulator:
        conflicts |= {
            "--speed": options.speed, "--initial": options.initial, "--current": options.current,
            "--depth": options.depth, "--upwelling": options.upwelling,
        }  # fmt: skip
    if not options.simulator:
        reason = (
            "--no-sim" if options.no_sim
            else "--vehicle-address" if options.vehicle_address else "--vehicle-driver"
        )  # fmt: skip
        for flag, value in conflicts.items():
            if value is not None:
                raise ConfigurationError(
                    flag, f"together with {reason}", f"it without {reason}: it is for the simulator"
                )
