"""The verbs of vehicle.py call the same thing by the same name."""

from __future__ import annotations

import importlib
import re
from collections import defaultdict
from pathlib import Path

import pytest

from auv_sim.cli.vehicles import vehicle_command
from auv_sim.command_line import Parser

#: `--out` is a file or a directory; `new` is given speeds, and `manoeuvres` a factor of time.
DIFFERENT = {"--out": {"FILE", "DIR"}, "--speed": {"V@T", "N"}}
NEW = ["new", "--length", "1.6", "--thrust-unit", "percent", "--speed", "1.5@60", "--rudder", "25"]


def parsers() -> dict[str, Parser]:
    found = {verb: Parser(prog=verb) for verb in vehicle_command.VERBS}
    for verb, one in found.items():
        importlib.import_module(f"auv_sim.own_vehicle.verbs.{verb}").add_arguments(one)
    return found


def test_an_option_has_one_placeholder_whatever_the_verb() -> None:
    placeholders = defaultdict(set)
    for one in parsers().values():
        for action in one._actions:
            if action.option_strings and action.nargs != 0:
                placeholders[action.option_strings[-1]].add(str(action.metavar))
    assert {name: found for name, found in placeholders.items() if len(found) > 1} == DIFFERENT


def test_how_many_flights_run_at_once_has_one_name() -> None:
    """As in `campaign.py` and `sea_trials.py`, whether they run in threads or in processes."""
    for verb in ("identify", "tune", "prove"):
        names = {name for action in parsers()[verb]._actions for name in action.option_strings}
        assert "--workers" in names and "--threads" not in names, verb


def test_a_default_is_written_in_one_way() -> None:
    for verb, one in parsers().items():
        for action in one._actions:
            assert not re.search(r"\(default [^:]|\(\d", action.help or ""), f"{verb} {action.option_strings}"


@pytest.mark.parametrize("verb", vehicle_command.VERBS)
def test_every_verb_can_be_quiet(verb: str) -> None:
    needed = {"manoeuvres": ["--vehicle", "remus100"], "tune": ["remus100"], "prove": ["remus100"]}
    words = [verb, *needed.get(verb, [])]
    parse = vehicle_command.parser().parse_args
    assert parse([*words, "--quiet"]).quiet and not parse(words).quiet


def test_a_quiet_new_asks_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    assert vehicle_command.main([*NEW, "--quiet", "--out", str(tmp_path / "p.yaml")]) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and "--radius: found nothing" in captured.err
