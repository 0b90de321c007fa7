"""A claim of the paper: its source, the rule that judges it, the numbers, and the verdict."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

HOLDS = "holds"
FAILS = "does not hold"


@dataclass(frozen=True)
class Number:
    """One measured value that the rule looks at."""

    what: str
    value: float
    unit: str
    digits: int = 3

    @property
    def text(self) -> str:
        """The value with its unit, for people."""
        if not math.isfinite(self.value):
            return "never"
        return f"{self.value:.{self.digits}f} {self.unit}".strip()


@dataclass(frozen=True)
class PaperClaim:
    """A claim of the paper after it was measured.

    Attributes:
        key: short name, for programs.
        place: where the paper says it.
        claim: its content, in our words.
        rule: what decides.
        numbers: what was measured.
        verdict: "holds", "does not hold", or "holds only ...".
        figure: number of the figure that shows it, 0 for none.
        remark: further facts for the reader.
    """

    key: str
    place: str
    claim: str
    rule: str
    numbers: tuple[Number, ...]
    verdict: str
    figure: int = 0
    remark: str = field(default="")

    def as_json(self) -> dict[str, Any]:
        """Return plain values; a number that is not finite becomes null."""
        return {
            "key": self.key,
            "place": self.place,
            "claim": self.claim,
            "rule": self.rule,
            "verdict": self.verdict,
            "figure": self.figure or None,
            "remark": self.remark,
            "numbers": [
                {"what": n.what, "value": n.value if math.isfinite(n.value) else None, "unit": n.unit}
                for n in self.numbers
            ],
        }


def verdict(outcomes: dict[str, bool], kind: str = "with") -> str:
    """Return the verdict of a claim from its outcome under each condition."""
    good = [name for name, held in outcomes.items() if held]
    if len(good) == len(outcomes):
        return HOLDS
    return f"holds only {kind} {'; '.join(good)}" if good else FAILS
