"""Spoil files for every reader of the suite for some minutes and report how they end.

A case is good when the file is read, or refused in one line, within 5 s of processor time and 500 MB.
Cases are numbered and repeatable: `python3 -m mutation --reader mcap --first 1234 --cases 1`.
"""

from __future__ import annotations

import argparse
import json
import os
import queue
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

from mutation.readers import READERS

CPU_BOUND, MEMORY_BOUND = 5.0, 500.0
#: Wall time after which a case counts as hanging and its process is killed, s: the machine may be busy.
_PATIENCE = 60.0
_PATIENCE_FOR_START = 600.0
_CHUNK = 200


@dataclass
class Tally:
    """What was seen of one reader: s of processor time and MB are the largest."""

    cases: int = 0
    read: int = 0
    tracebacks: int = 0
    hangs: int = 0
    large: int = 0
    cpu_s: float = 0.0
    peak_mb: float = 0.0
    reports: list[str] = field(default_factory=list)


def run(name: str, first: int, last: int, tally: Tally) -> None:
    """Read cases in a child, which is started again after one that killed it."""
    while first < last:
        command = [sys.executable, "-m", "mutation.worker", name, str(first), str(last)]
        child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert child.stdout is not None and child.stderr is not None
        lines: queue.Queue[str] = queue.Queue()

        def pump(stream=child.stdout, lines=lines) -> None:  # type: ignore[no-untyped-def]
            for line in stream:
                lines.put(line)
            lines.put("")

        threading.Thread(target=pump, daemon=True).start()
        running: int | None = None
        is_ready = False
        while True:
            try:
                line = lines.get(timeout=_PATIENCE if is_ready else _PATIENCE_FOR_START)
            except queue.Empty:
                child.kill()
                child.wait()
                if running is None:
                    raise SystemExit(f"the worker for {name} does not start") from None
                tally.hangs += 1
                tally.reports.append(f"{name} {running}: no end within {_PATIENCE:g} s")
                break
            if not line:
                break
            record, is_ready = json.loads(line), True
            if "ready" in record:
                continue
            if "wrong" not in record:
                running = record["case"]
                continue
            _count(name, record, tally)
            running, first = None, record["case"] + 1
        child.wait()
        rest = child.stderr.read()
        if running is not None:
            if child.returncode != -9:
                tally.tracebacks += 1
                tally.reports.append(f"{name} {running}: the process ended with {child.returncode}\n{rest}")
            first = running + 1
        elif first < last:
            raise SystemExit(f"the worker for {name} ended with {child.returncode}:\n{rest}")


def _count(name: str, record: dict[str, object], tally: Tally) -> None:
    number, cpu, peak = record["case"], float(str(record["cpu_s"])), float(str(record["peak_mb"]))
    tally.cases += 1
    tally.read += bool(record["is_read"])
    tally.cpu_s, tally.peak_mb = max(tally.cpu_s, cpu), max(tally.peak_mb, peak)
    if record["wrong"]:
        tally.tracebacks += 1
        tally.reports.append(f"{name} {number}:\n{record['wrong']}")
    if cpu > CPU_BOUND:
        tally.hangs += 1
        tally.reports.append(f"{name} {number}: {cpu:.1f} s of processor time")
    if peak > MEMORY_BOUND:
        tally.large += 1
        tally.reports.append(f"{name} {number}: {peak:.0f} MB")


def main() -> int:
    """Run; returns 1 when a case was not good."""
    parser = argparse.ArgumentParser(prog="mutation", description=__doc__)
    parser.add_argument("--minutes", type=float, default=1.0, help="for all readers together (default 1)")
    parser.add_argument("--reader", action="append", choices=READERS, help="only this one (may be repeated)")
    parser.add_argument("--first", type=int, default=10_000, help="number of the first case (default 10000)")
    parser.add_argument("--cases", type=int, help="of each reader, in place of --minutes")
    options = parser.parse_args()
    os.environ["PYTHONPATH"] = os.pathsep.join(
        filter(None, [str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH")])
    )
    names = options.reader or list(READERS)
    tallies = {name: Tally() for name in names}
    begun, first = time.monotonic(), options.first
    step = options.cases or _CHUNK
    while first == options.first or (
        options.cases is None and time.monotonic() - begun < 60.0 * options.minutes
    ):
        for name in names:
            seen = len(tallies[name].reports)
            run(name, first, first + step, tallies[name])
            for report in tallies[name].reports[seen:]:
                print(report, flush=True)
            if options.cases is None and time.monotonic() - begun > 60.0 * options.minutes:
                break
        first += step
    print(
        f"{'reader':16} {'cases':>7} {'read':>6} {'tracebacks':>10} {'> 5 s':>6} {'> 500 MB':>8}"
        f" {'max s':>6} {'max MB':>6}"
    )
    for name, tally in tallies.items():
        print(
            f"{name:16} {tally.cases:7} {tally.read:6} {tally.tracebacks:10} {tally.hangs:6} {tally.large:8}"
            f" {tally.cpu_s:6.2f} {tally.peak_mb:6.0f}"
        )
    print(
        f"{sum(tally.cases for tally in tallies.values())} cases in {(time.monotonic() - begun) / 60:.1f} min"
    )
    return int(any(tally.reports for tally in tallies.values()))


if __name__ == "__main__":
    raise SystemExit(main())
