"""The hulls and laws that the paper's studies vary, by name.

No library is imported, so that the command line can list the names quickly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class HullPair:
    """The vehicle file of the plant (`hull`) and that of the controllers."""

    label: str
    hull: str
    controller_model: str


PLANTS: Mapping[str, HullPair] = {
    "prestero": HullPair(label="Prestero", hull="remus100", controller_model="remus100"),
    "mismatch": HullPair(
        label="Nuud -4.15 in the plant only", hull="remus100_mismatch", controller_model="remus100"
    ),
    "table2": HullPair(
        label="Table 2 as printed", hull="remus100_table2", controller_model="remus100_table2"
    ),
}
#: In the order in which figures show them.
PLANT_NAMES = tuple(PLANTS)

#: Laws of the study of random starts: name -> what differs from a plain flight.
START_LAWS: Mapping[str, Mapping[str, Any]] = {
    "robust": {"params": "robust"},
    "paper": {"params": "paper"},
    "pid": {"params": "paper", "controller": "pid"},
    "smc": {"params": "paper", "controller": "smc"},
}
