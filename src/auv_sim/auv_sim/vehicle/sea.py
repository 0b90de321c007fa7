"""Imperfections of sea and vehicle in one file: `config/seas/*.yaml`."""

from __future__ import annotations

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import setting, settings
from auv_path_following import config_files
from auv_sim.vehicle.currents import CurrentConfig
from auv_sim.vehicle.diving.bottom import BottomConfig
from auv_sim.vehicle.fins.actuator import RudderFlaws
from auv_sim.vehicle.navigator import NavigatorConfig
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.sensors import SensorsConfig


@settings
class Sea:
    """Water, bottom, fins, propeller, instruments and navigator; keys left out are ideal."""

    name: str = setting(doc="display name")
    current: CurrentConfig = setting(factory=CurrentConfig, doc="the sea's own current")
    rudder: RudderFlaws = setting(factory=RudderFlaws, doc="imperfections of the rudder's servo")
    sternplanes: RudderFlaws = setting(factory=RudderFlaws, doc="imperfections of the stern planes' servo")
    bottom: BottomConfig = setting(factory=BottomConfig, doc="the bottom below a vehicle that dives")
    thrust: NoiseConfig = setting(factory=NoiseConfig, doc="errors of the thrust, as a share of it")
    sensors: SensorsConfig = setting(factory=SensorsConfig, doc="instruments")
    navigator: NavigatorConfig = setting(factory=NavigatorConfig, doc="its assumptions about the instruments")


def load(name_or_path: str) -> Sea:
    """Read a sea file.

    Args:
        name_or_path: a path, or a shipped name such as ``rough``.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    return yaml_file.load(config_files.find("seas", name_or_path), Sea)
