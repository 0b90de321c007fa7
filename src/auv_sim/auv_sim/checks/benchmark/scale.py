"""The extent of a benchmark."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Scale:
    """Number and length of everything that is measured.

    Attributes:
        rounds: how often runs that are compared take turns.
        steps: of a lockstep run.
        seconds: of a free running one, and of a recorder at work.
        vehicles: numbers of vehicles for the batch engine.
        flight: how long each of them flies, s.
        topics: numbers of topics for the recorder.
        subpaths: numbers of subpaths for guidance.
    """

    rounds: int = 3
    steps: int = 3000
    seconds: float = 12.0
    vehicles: tuple[int, ...] = (1, 10, 100, 1000, 10_000, 100_000)
    flight: float = 20.0
    topics: tuple[int, ...] = (1, 10, 30, 100)
    subpaths: tuple[int, ...] = (10, 100, 1000, 10_000)


FULL = Scale()
#: A short run that shows whether everything works, not its speed.
QUICK = Scale(
    rounds=1, steps=200, seconds=1.0, vehicles=(1, 10), flight=2.0, topics=(1, 5), subpaths=(10, 100)
)
