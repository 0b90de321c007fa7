"""Random numbers and rings of one run at sea, laid out before it: steps read, count and overwrite.

Every law has its own generators, made from the seed of the run and the law's place in it: two runs are equal
to the last bit, a reset repeats the same run, and disabling one error leaves all others unchanged. The
numbers of a generator do not depend on how many are drawn at once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from auv_msgs_py.values.pure import pure

#: The seed of the run, and the place of the law in it.
Seed = Sequence[int]

_Kind = Literal["standard_normal", "standard_exponential", "random"]


class RunMemory(NamedTuple):
    """Memory that steps write to: lists for CPython, arrays for compiled code.

    Attributes:
        drawn: random numbers, one row for each law.
        used: for each row, the place of its next number in `drawn`; counted up.
        kept: rings; overwritten.
    """

    drawn: Any
    used: Any
    kept: Any


class Now(NamedTuple):
    """The run's memory, and the time (s) and the number of this measurement, both from 0."""

    memory: RunMemory
    time: float
    k: int


class DrawnRow(NamedTuple):
    """A row of random numbers: its place in `RunMemory.used`, and its end in `RunMemory.drawn`."""

    number: int
    end: int


class Ring(NamedTuple):
    """A ring in `RunMemory.kept`: its begin, the number of its entries, and the numbers in each."""

    begin: int
    size: int
    width: int


class Lookup(NamedTuple):
    """A table that is linear between its rows and constant before the first and after the last.

    Attributes:
        rows: how many; 0 for an empty table.
        width: numbers in each row: the argument, which increases, and the values.
        numbers: one row after the other.
    """

    rows: int
    width: int
    numbers: Any


@pure
def looked_up(table: Lookup, column: int, at: float) -> float:
    """Return the value of a column for an argument; 0 from an empty table."""
    rows, width, numbers = table
    if rows == 0:
        return 0.0
    k, end = 0, rows  # the first row behind `at` is from k to end
    while k < end:
        middle = (k + end) // 2
        if numbers[middle * width] <= at:
            k = middle + 1
        else:
            end = middle
    if k == 0 or k == rows:
        return numbers[max(k - 1, 0) * width + column]  # type: ignore[no-any-return]
    before, after = (k - 1) * width, k * width
    share = (at - numbers[before]) / (numbers[after] - numbers[before])
    first, second = numbers[before + column], numbers[after + column]
    return first + share * (second - first)  # type: ignore[no-any-return]


@pure
def draw(memory: RunMemory, row: DrawnRow) -> float:
    """Return the next random number of a row.

    Raises:
        IndexError: the row is used up.
    """
    number, end = row
    at = memory.used[number]
    if at >= end:
        raise IndexError("a row of random numbers is used up")
    memory.used[number] = at + 1
    return memory.drawn[at]  # type: ignore[no-any-return]


@pure
def slot(ring: Ring, k: int) -> int:
    """Return the begin of entry `k` of a ring in `RunMemory.kept`."""
    return ring.begin + k % ring.size * ring.width


class Draws:
    """Lays out a run's rows and rings while its laws are prepared, and draws their numbers.

    Args:
        step: time between two steps of the run, s.
        steps: number of steps for which the rows last.
        arrays: whether the memory is for compiled code; otherwise for CPython, where lists are several times
            as fast as arrays.
    """

    def __init__(self, step: float, steps: int, arrays: bool = False) -> None:
        self.step, self.steps, self._arrays = step, steps, arrays
        self._rows: list[tuple[np.random.Generator, _Kind, int, int]] = []
        self._drawn = self._kept = 0

    def generator(self, seed: Seed) -> np.random.Generator:
        """Return the generator of a law."""
        return np.random.default_rng(tuple(seed))

    def normals(self, generator: np.random.Generator, rate: float = 0.0) -> DrawnRow:
        """Lay out standard normal numbers, one for each step or for each sample of `rate` (1/s)."""
        return self._row(generator, "standard_normal", self._samples(rate))

    def uniforms(self, generator: np.random.Generator, count: int, rate: float) -> DrawnRow:
        """Lay out numbers from [0, 1), `count` for each sample of `rate` (1/s; 0: for each step)."""
        return self._row(generator, "random", count * self._samples(rate))

    def exponentials(self, generator: np.random.Generator, mean: float) -> DrawnRow:
        """Lay out exponential numbers, one for every `mean` seconds, with an ample reserve."""
        expected = self.steps * self.step / mean
        return self._row(
            generator, "standard_exponential", math.ceil(expected + 12.0 * math.sqrt(expected)) + 20
        )

    def none(self) -> DrawnRow:
        """Lay out a row that is never read."""
        return DrawnRow(0, 0)

    def ring(self, entries: int, width: int = 1) -> Ring:
        """Lay out a ring of `entries` times `width` numbers."""
        begin, self._kept = self._kept, self._kept + entries * width
        return Ring(begin, entries, width)

    def _samples(self, rate: float) -> int:
        return min(self.steps, math.ceil(self.steps * self.step * rate) + 2) if rate > 0.0 else self.steps

    def _row(self, generator: np.random.Generator, kind: _Kind, size: int) -> DrawnRow:
        begin, self._drawn = self._drawn, self._drawn + size
        self._rows.append((generator, kind, begin, size))
        return DrawnRow(len(self._rows) - 1, self._drawn)

    def table(self, size: int) -> Any:
        """Return a separate table of zeros."""
        return np.zeros(size) if self._arrays else [0.0] * size

    def lookup(self, rows: Sequence[Sequence[float]]) -> Lookup:
        """Return a table for `looked_up`; all rows are equally long."""
        width = len(rows[0]) if rows else 1
        numbers = self.table(len(rows) * width)
        for k, value in enumerate(number for row in rows for number in row):
            numbers[k] = value
        return Lookup(len(rows), width, numbers)

    def memory(self) -> RunMemory:
        """Draw all numbers; return the memory of the run. Call it once, after the layout is complete."""
        drawn = np.empty(self._drawn)
        for generator, kind, begin, size in self._rows:
            drawn[begin : begin + size] = getattr(generator, kind)(size)
        used = np.array([begin for _, _, begin, _ in self._rows], np.int64)
        memory = RunMemory(drawn, used, np.zeros(self._kept))
        return memory if self._arrays else RunMemory(*(values.tolist() for values in memory))

    def refill(self, memory: RunMemory) -> None:
        """Replace the used numbers of every row between two steps, so that it lasts as long again.

        Args:
            memory: lists.
        """
        drawn, used, _ = memory
        for number, (generator, kind, begin, size) in enumerate(self._rows):
            count = used[number] - begin
            if count:
                drawn[begin : begin + size] = (
                    drawn[begin + count : begin + size] + getattr(generator, kind)(count).tolist()
                )
                used[number] = begin
