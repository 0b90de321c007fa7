"""`scripts/vehicle.py`: its verbs and what it does with a wrong one."""

from __future__ import annotations

import importlib

import pytest

from auv_sim.cli.vehicles import vehicle_command as vehicle_cli


@pytest.mark.parametrize("verb", vehicle_cli.VERBS)
def test_every_listed_verb_has_options_and_runs(verb: str) -> None:
    module = importlib.import_module(f"auv_sim.own_vehicle.verbs.{verb}")
    assert module.__doc__
    assert callable(module.add_arguments) and callable(module.run)


def test_an_unknown_verb_costs_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        vehicle_cli.main(["fly"])
    assert end.value.code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "fly" in line
