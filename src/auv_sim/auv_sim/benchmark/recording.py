"""What the recorder costs, by number of topics."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

from auv_msgs_py import topics
from auv_sim.benchmark import talker
from auv_sim.benchmark.laws import Tick
from auv_sim.benchmark.rig import BenchmarkFailed
from auv_sim.benchmark.scale import Scale
from auv_sim.benchmark.usage import usage
from auv_sim.mission.composed import NODES
from auv_sim.mission.domains import free_domain
from auv_sim.mission.processes import Children

#: Long enough for the recorder to find new topics, s.
_SETTLED = 2.0


def topic_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Processor time of the recorder, percent of one core, by number of topics at `talker.RATE`."""
    found = {}
    for number in scale.topics:
        tick(f"recorder, {number} topics")
        found[str(number)] = _cost(number, 0.5 * scale.seconds)
    return {"rate_hz": talker.RATE, "cpu_percent": found}


def _cost(number: int, seconds: float) -> float:
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name:
        bag = Path(name) / "bag"
        environment = {"ROS_DOMAIN_ID": str(free_domain()), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        children = Children(Path(name) / "log", environment)
        try:
            children.start(talker.NAME, talker.__name__, [str(number)])
            wanted = {"directory": str(bag), "contract": "false", "regex": "/talk_.*"}
            words = [word for key, value in wanted.items() for word in ("-p", f"{key}:={value}")]
            children.start(topics.RECORDER, NODES[topics.RECORDER].split(":")[0], ["--ros-args", *words])
            _until_recording(bag, children)
            recorder = next(child for child in children if child.name == topics.RECORDER)
            before, begin = usage(recorder.process.pid), time.perf_counter()
            time.sleep(seconds)
            used, took = usage(recorder.process.pid), time.perf_counter() - begin
        finally:
            children.stop()
    return 100.0 * (used.cpu - before.cpu) / took


def _until_recording(bag: Path, children: Children) -> None:
    """The first bytes in the file: messages come. Then some time for the other topics."""
    deadline = time.monotonic() + 90.0
    while not any(file.stat().st_size > 4096 for file in bag.glob("*.mcap")):
        if children.dead() is not None or time.monotonic() > deadline:
            raise BenchmarkFailed("the recorder did not record")
        time.sleep(0.1)
    time.sleep(_SETTLED)
