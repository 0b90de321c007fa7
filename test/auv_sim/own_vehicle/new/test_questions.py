"""The questions of `vehicle.py new`."""

from __future__ import annotations

import argparse

from auv_sim.command_line import positive
from auv_sim.own_vehicle.new.questions import Question, ask

QUESTIONS = [
    Question("length", "Length", positive, required=True),
    Question("mass", "Mass", positive),
    Question("planes", "Planes", float),
    Question("dive_rate", "Dive rate", positive, applies=lambda given: bool(given.planes)),
    Question("radius", "Radii", positive, several=True, required=True),
]


def asked(answers: list[str], **given: object) -> tuple[argparse.Namespace, list[str], list[str]]:
    options = argparse.Namespace(
        **{"length": None, "mass": None, "planes": None, "dive_rate": None, "radius": None} | given
    )
    prompts: list[str] = []
    said: list[str] = []

    def read(prompt: str) -> str:
        prompts.append(prompt)
        return answers.pop(0)

    ask(QUESTIONS, options, read, said.append)
    assert answers == []
    return options, prompts, said


def test_only_what_is_not_given_is_asked() -> None:
    options, prompts, _ = asked(["", "0", "4 6"], length=2.0)
    assert [prompt.split(" [")[0].rstrip(": ") for prompt in prompts] == ["Mass", "Planes", "Radii"]
    assert (options.mass, options.planes, options.radius) == (None, 0.0, [4.0, 6.0])


def test_an_answer_that_is_none_is_asked_again() -> None:
    options, prompts, said = asked(["", "-2", "2 3", "2", "50", "20", "0.5", "9"])
    assert len(prompts) == 8 and len(said) == 3
    assert (options.length, options.dive_rate) == (2.0, 0.5)
