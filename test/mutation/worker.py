"""The child process that reads spoiled files: limited in memory, one line of JSON for each case."""

from __future__ import annotations

import json
import resource
import sys
import tempfile
import time
import traceback
from pathlib import Path

from mutation.readers import Cases

#: Beyond this much address space an allocation fails, bytes; libraries take a part of it.
_ADDRESS_SPACE = 4 << 30


def main() -> None:
    """Read cases from `first` to `last`: ``worker NAME FIRST LAST``."""
    name, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    resource.setrlimit(resource.RLIMIT_AS, (_ADDRESS_SPACE, _ADDRESS_SPACE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory(prefix="auv-mutation-") as scratch:
        cases = Cases(name, Path(scratch))
        _say({"ready": name})
        for number in range(first, last):
            file = cases.put_down(number)
            _say({"case": number})
            Path("/proc/self/clear_refs").write_text("5")  # the peak of memory begins anew
            begun, is_read, wrong = time.process_time(), False, ""
            try:
                is_read = cases.is_read(file)
            except BaseException:
                wrong = traceback.format_exc()
            took = time.process_time() - begun
            _say({"case": number, "cpu_s": took, "peak_mb": _peak_mb(), "is_read": is_read, "wrong": wrong})


def _peak_mb() -> float:
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) / 1e3
    return 0.0


def _say(record: dict[str, object]) -> None:
    print(json.dumps(record), flush=True)


if __name__ == "__main__":
    main()
