"""docs/parameters.md is what the settings classes say."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import pytest

from auv_msgs_py.settings.schema import leaves, setting, settings
from auv_sim import reference
from auv_sim.sim_parameters import SUITE

PAGE = Path(__file__).resolve().parents[2] / "docs" / "parameters.md"


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == reference.page(), (
        "in the environment: python3 -m auv_sim.reference > docs/parameters.md"
    )


@pytest.mark.parametrize("node", SUITE)
def test_every_parameter_that_a_node_declares_is_on_the_page(node: str) -> None:
    text = reference.page()
    assert [leaf.name for leaf in leaves(SUITE[node]) if f"| `{leaf.name}` |" not in text] == []


@settings
class Part:
    """A nested class."""

    length: float = setting(doc="how long", unit="m", gt=0.0, le=9.0)


@settings
class Whole:
    """One of everything."""

    mode: Literal["a", "b"] = setting("a", "which", live=True)
    parts: tuple[Part, ...] = setting((), "its parts")
    at: tuple[float, float] | None = setting(None, "where")
    names: list[str] = setting(factory=lambda: ["x"], doc="what people call it")


def test_a_row_has_unit_range_default_and_meaning() -> None:
    assert [tuple(row) for row in reference.keys(Whole)] == [
        ("mode", "one of `a`, `b`", "", "`a`", "which *(live)*"),
        ("parts", "list of mappings", "", "empty", "its parts"),
        ("parts[].length", "number, m", "above 0 to 9", "-", "how long"),
        ("at", "2 numbers", "", "none", "where"),
        ("names", "list of texts", "", "`x`", "what people call it"),
    ]
