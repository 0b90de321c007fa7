"""The comparators over the graph, in lockstep: the same laws by name, the same flight as `closed_loop`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from auv_sim.bags.reading.load import load
from auv_sim.cli.mission import main
from auv_sim.flight import closed_loop
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options

_PARAMS = """
/**/ailos_guidance:
  ros__parameters:
    guidance: {{law: {law}}}
/**/heading_autopilot:
  ros__parameters:
    autopilot:
      controller: {controller}
      reference: {{enabled: {shaped}}}
"""


@pytest.mark.parametrize(("law", "controller", "shaped"), [("ilos", "smc", "false"), ("los", "pid", "true")])
def test_a_comparator_over_the_graph_equals_closed_loop(
    law: str, controller: str, shaped: str, short_mission: Path, tmp_path: Path, domain: int
) -> None:
    params = tmp_path / "params.yaml"
    params.write_text(_PARAMS.format(law=law, controller=controller, shaped=shaped), encoding="utf-8")
    run = tmp_path / "run"
    asked = ["--mission", str(short_mission), "--params", str(params), "--current", "0.1", "0.2"]
    assert main([*asked, "--quiet", "--composed", "--domain", str(domain), "--out", str(run)]) == 0
    options = Options(mission=str(short_mission), params=str(params), current=(0.1, 0.2))
    reference = closed_loop.fly(mission_plan.make(options, tmp_path).scenario())
    flown = load(run / "bag")
    assert flown.steps == reference.steps
    for column in ("x", "y", "rudder_cmd", "psi_d", "s"):
        difference = np.abs(getattr(flown, column) - getattr(reference, column))
        if column == "psi_d":
            difference = np.minimum(difference, 2.0 * np.pi - difference)
        assert difference.max() < 1e-9, column
