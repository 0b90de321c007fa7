"""Measures what the recorder costs, by number of topics."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from auv_msgs_py.contract import topics
from auv_sim.checks.benchmark.measures import talker
from auv_sim.checks.benchmark.measures.children import processes
from auv_sim.checks.benchmark.measures.law_speed import Tick
from auv_sim.checks.benchmark.scale import Scale
from auv_sim.launch.composed import NODES

#: Long enough for the recorder to find new topics, s.
_SETTLED = 2.0
#: A file of this size has messages in it, bytes.
_BEGUN = 4096


def topic_figures(scale: Scale, tick: Tick) -> dict[str, Any]:
    """Measure the recorder's processor time, percent of one core, by number of topics at `talker.RATE`."""
    found = {}
    for number in scale.topics:
        tick(f"recorder, {number} topics")
        found[str(number)] = _cost(number, 0.5 * scale.seconds)
    return {"rate_hz": talker.RATE, "cpu_percent": found}


def _cost(number: int, seconds: float) -> float:
    with tempfile.TemporaryDirectory(prefix="auv-benchmark-") as name, processes(Path(name)) as children:
        bag = Path(name) / "bag"
        children.start(talker.NAME, talker.__name__, [str(number)])
        values = {"directory": str(bag), "contract": "false", "regex": "/talk_.*"}
        words = [word for key, value in values.items() for word in ("-p", f"{key}:={value}")]
        children.start(topics.RECORDER, NODES[topics.RECORDER].split(":")[0], ["--ros-args", *words])

        def wait(condition: Callable[[], bool]) -> None:
            children.until(condition, lambda: time.sleep(0.05), 90.0)

        # The first bytes in the file: messages come. Then some time for the other topics.
        wait(lambda: any(file.stat().st_size > _BEGUN for file in bag.glob("*.mcap")))
        settled = time.perf_counter() + _SETTLED
        wait(lambda: time.perf_counter() > settled)
        before, begin = children.usage(), time.perf_counter()
        wait(lambda: time.perf_counter() > begin + seconds)
        used, took = children.usage(), time.perf_counter() - begin
    return 100.0 * (used[topics.RECORDER].cpu - before[topics.RECORDER].cpu) / took
