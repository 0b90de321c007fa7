"""`scripts/bag.py`: parses the verb and hands over to its module."""

from __future__ import annotations

import argparse
from collections.abc import Container, Sequence

from auv_sim.command_line import command
from auv_sim.command_verbs import parser_of_verbs, run_verb

#: In the order of a session with a recording.
VERBS = {
    "inspect": "what is in a recording, and what happened: topics, mission, events",
    "report": "one interactive HTML page, and pictures beside it",
    "compare": "several runs laid over each other, and a table of their differences",
    "replay": "play the recorded topics into a live graph",
    "rerun": "feed the recorded sensors through guidance and control again, with other gains",
    "export": "one table, as CSV or Parquet",
    "repair": "make a damaged or unfinished recording whole",
}


def parser(verbs_with_options: Container[str] = VERBS) -> argparse.ArgumentParser:
    """Return the command line's parser; see `parser_of_verbs`."""
    return parser_of_verbs(
        "bag.py", "Inspect, compare, replay and repair recordings of missions.",
        "auv_sim.bags.verbs", VERBS, verbs_with_options,
    )  # fmt: skip


@command("bag.py")
def main(argv: Sequence[str] | None = None) -> int:
    """Run one verb; return 0 done, 1 a difference was found, 2 bad input, 130 interrupted."""
    return run_verb(parser, argv)


if __name__ == "__main__":
    raise SystemExit(main())
