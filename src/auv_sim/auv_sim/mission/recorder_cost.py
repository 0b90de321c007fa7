"""What recording costs: the same lockstep mission with and without the recorder, in turn, wall time of each.

python -m auv_sim.mission.recorder_cost [--rounds N] [--mission FILE]
"""

from __future__ import annotations

import argparse
import dataclasses
import tempfile
from pathlib import Path

from rich.console import Console

from auv_msgs_py import topics
from auv_sim.mission import launcher, plan
from auv_sim.mission.plan import Options
from auv_sim.mission.progress import Progress


def wall_time(mission: str, recorded: bool, directory: Path) -> float:
    """Fly once; seconds between the mission's start and its end."""
    resolved = plan.make(Options(mission=mission, quiet=True), directory)
    if not recorded:
        del resolved.parameters[topics.RECORDER]
        for name, settings in resolved.parameters.items():
            resolved.parameters[name] = dataclasses.replace(settings, recorded=False)
    directory.mkdir(parents=True)
    with Progress(resolved.mission.path, Console(quiet=True), quiet=True) as progress:
        return launcher.fly(resolved, directory, launcher.domain_of(resolved), progress).wall_time


def main() -> int:
    """Print both times of each round, and the ratio of the best: what else the machine does only adds."""
    parser = argparse.ArgumentParser(
        description="Wall time of a lockstep mission with and without the recorder."
    )
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--mission", default=plan.DEFAULT_MISSION)
    arguments = parser.parse_args()
    pairs = []
    with tempfile.TemporaryDirectory(prefix="auv-cost-") as name:
        for k in range(arguments.rounds):
            without = wall_time(arguments.mission, False, Path(name) / f"without-{k}")
            recorded = wall_time(arguments.mission, True, Path(name) / f"with-{k}")
            pairs.append((without, recorded))
            print(
                f"without {without:.1f} s, with {recorded:.1f} s, ratio {recorded / without:.2f}", flush=True
            )
    without, recorded = (min(times) for times in zip(*pairs, strict=True))
    print(f"best without {without:.1f} s, best with {recorded:.1f} s, ratio {recorded / without:.2f}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
