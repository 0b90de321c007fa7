"""A parameter file that `mission.py --params FILE` flies, with what made it in its comments."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file, yaml_file
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.settings.schema import flattened, nested
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.sim_parameters import SUITE

#: Significant digits of a gain.
_DIGITS = 5
_WIDTH = 108


def settings_of(flown: GainSet, base: Mapping[str, Any]) -> dict[str, Any]:
    """Return all nodes' settings with gains in place of their own; numbers as the file will have them.

    Args:
        flown: the gains.
        base: node name -> its settings, for everything else.
    """
    guidance, steering = base[topics.GUIDANCE], base[topics.AUTOPILOT]
    changed: dict[str, dict[str, Any]] = {
        topics.GUIDANCE: {"guidance": flown.guidance},
        topics.AUTOPILOT: {"autopilot": flown.autopilot, "pitch": flown.pitch},
    }
    own = {topics.OBSERVER: base[topics.OBSERVER], topics.GUIDANCE: guidance, topics.AUTOPILOT: steering}
    return {
        node: {
            key: _rounded(value)
            for key, value in (flattened(settings) | _flat(changed.get(node, {}))).items()
            if value != flattened(SUITE[node]())[key]
        }
        for node, settings in own.items()
    }


def _flat(groups: Mapping[str, Any]) -> dict[str, Any]:
    return {
        f"{name}.{key}": value for name, group in groups.items() for key, value in flattened(group).items()
    }


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}")
    return list(value) if isinstance(value, tuple) else value


def write(target: Path, flown: GainSet, base: Mapping[str, Any], comments: Iterable[str]) -> GainSet:
    """Write the file; return the gains as a reader gets them.

    Args:
        target: the file.
        flown: the gains.
        base: all other settings.
        comments: paragraphs for its head; a paragraph that begins with a blank is not wrapped.

    Raises:
        NotWritten: it cannot be written.
    """
    head = []
    for comment in comments:
        lines = [comment.strip()] if comment.startswith(" ") else textwrap.wrap(comment, _WIDTH)
        indent = "#   " if comment.startswith(" ") else "# "
        head += [indent + line for line in lines or [""]]
    data = {
        f"/**/{node}": {"ros__parameters": nested(values)}
        for node, values in settings_of(flown, base).items()
        if values
    }
    write_text(target, "\n".join(head) + "\n" + yaml_file.text_of(data))
    return read(target)


def read(file: Path) -> GainSet:
    """Return the gains of a parameter file.

    Raises:
        ConfigurationError: as `params_file.load`.
    """
    return flown_of(params_file.load(file, SUITE))


def flown_of(settings: Mapping[str, Any]) -> GainSet:
    """Return the gains among all nodes' settings."""
    steering = settings[topics.AUTOPILOT]
    return GainSet(settings[topics.GUIDANCE].guidance, steering.autopilot, steering.pitch)
