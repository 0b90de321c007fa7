"""Bounds of the nodes' parameters."""

from __future__ import annotations

import pytest

from auv_msgs_py.settings.schema import SettingInfo, leaves, nested, validated
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.sim_parameters import SUITE, FaultRelayParameters

#: Parameters of the laws are gains: any positive value is a law, if a poor one.
_LAWS = ("guidance.", "autopilot.", "observer.")
TIMES = sorted(
    {
        (cls, leaf.name)
        for cls in (*SUITE.values(), FaultRelayParameters)
        for leaf in leaves(cls)
        if isinstance(leaf.default, float) and leaf.unit in ("s", "Hz") and not leaf.name.startswith(_LAWS)
    },
    key=lambda item: (item[0].__name__, item[1]),
)


def value_of(cls: type, name: str, value: float) -> object:
    flat = {leaf.name: leaf.default for leaf in leaves(cls)}
    return validated(cls, nested({**flat, name: value}), "test")


@pytest.mark.parametrize(("cls", "name"), TIMES, ids=lambda item: getattr(item, "__name__", item))
def test_no_time_is_so_short_that_everything_is_late(cls: type, name: str) -> None:
    leaf: SettingInfo = next(leaf for leaf in leaves(cls) if leaf.name == name)
    if leaf.minimum == 0.0:  # means: never, at once or none
        value_of(cls, name, 0.0)
    else:
        value_of(cls, name, float(leaf.minimum or 1.0))
    for value in (1e-300, 5e-324):
        if leaf.minimum != 0.0:
            with pytest.raises(ConfigurationError, match=name):
                value_of(cls, name, value)
