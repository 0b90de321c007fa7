"""Which of two claims gives way: always exactly one, and both sides agree."""

from __future__ import annotations

import dataclasses
import itertools

import pytest

from auv_msgs_py.contract.claim import Claim, decode, of_simulator

MISSION = Claim(
    holder="/auv/mission_launcher", namespace="/auv", names=("ailos_guidance", "remus_plant"), clock=True,
    process="process 1 on here", since=5, token="a",  # noqa: S106
)  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "contested"),
    [
        ({}, "/clock"),
        ({"namespace": "/auv2"}, "/clock"),
        ({"clock": False}, "ailos_guidance in /auv"),
        ({"clock": False, "names": ("recorder",)}, ""),
        ({"clock": False, "namespace": "/auv2"}, ""),
        ({"token": "a"}, ""),
    ],
)
def test_what_two_claims_have_in_common(changes: dict[str, object], contested: str) -> None:
    other = dataclasses.replace(MISSION, **{"token": "b", **changes})
    assert MISSION.contested(other) == other.contested(MISSION) == contested


@pytest.mark.parametrize(
    ("held", "since", "tokens"),
    list(
        itertools.product(itertools.product((False, True), repeat=2), ((1, 2), (2, 1), (3, 3)), ("ab", "ba"))
    ),
)
def test_exactly_one_of_two_gives_way(held: tuple[bool, bool], since: tuple[int, int], tokens: str) -> None:
    one, two = (
        dataclasses.replace(MISSION, held=h, since=s, token=t)
        for h, s, t in zip(held, since, tokens, strict=True)
    )
    assert one.gives_way_to(two) != two.gives_way_to(one)
    if held[0] != held[1]:
        assert one.gives_way_to(two) == held[1]


def test_a_claim_travels_as_text() -> None:
    assert decode(MISSION.encode()) == MISSION
    assert of_simulator("/", "remus_plant").holder == "/remus_plant"


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", "null", "x" * 5000, "[" * 3000, MISSION.encode().replace("5", "[]"),
     MISSION.encode().replace("true", "3"), MISSION.encode().replace("holder", "owner")],
)  # fmt: skip
def test_any_other_text_is_no_claim(text: str) -> None:
    assert decode(text) is None
