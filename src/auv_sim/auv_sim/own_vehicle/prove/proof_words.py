"""A proof in words and numbers: sentence, verdict, tables, summary."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rich.table import Table

from auv_sim.own_vehicle.prove.proof import Proof, Proposition
from auv_sim.own_vehicle.tune.trial_flights import PROVEN_TURN
from auv_sim.terminal import headed_table

#: Headings of the tables, after the first column.
_COLUMNS = ("off corners m", "anywhere m", "not completed", "limit cycles", "at most %", "rudder deg/m")
_DEPTH = "depth m"


def metres(bound: float) -> str:
    """Return a bound in words."""
    return "no distance" if math.isinf(bound) else f"{bound:.2f} m"


def _cell(bound: float) -> str:
    return "none" if math.isinf(bound) else f"{bound:.2f}"


def listed(names: Sequence[str]) -> str:
    """Return names as an enumeration."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def sentence_of(claim: Proposition, label: str, proof: Proof) -> str:
    """Return what the flights prove."""
    late, dives = claim.conditions.delay + claim.vehicle.rudder.dead_time, claim.vehicle.dives
    names = list(proof.seas)
    where = f"the sea {names[0]}" if len(names) == 1 else f"each of the seas {listed(names)}"
    n = sum(len(one.rms) for one in proof.seas.values())
    lost = sum(one.lost for one in proof.seas.values())
    anywhere = max(one.whole_bound for one in proof.seas.values())
    below = f", and within {metres(proof.deep_bound)} of its depth" if dives else ""
    starts = len(proof.unrest)
    return (
        f"With the gains {label} on {claim.vehicle.name}{_part(claim)}, 99 % of the flights keep within "
        f"{metres(proof.off_bound)} of the path away from corners, and within {metres(anywhere)} "
        f"anywhere{below}, at 95 % confidence: in {where}, in further currents of up to a quarter of the "
        f"speed, {_uncertain(claim)}, with {1e3 * late:.0f} ms of delay, on courses whose turns have at "
        f"least {PROVEN_TURN:g} times the hull's radius{' and whose depth changes' if dives else ''}. "
        f"{lost} of {n} did not complete their course. Of {starts} hard starts on a straight line "
        f"{proof.cycles} ended in a limit cycle: at most {100.0 * proof.cycle_bound:.1f} % do, at 95 % "
        "confidence."
    )


def _part(claim: Proposition) -> str:
    return " in its horizontal plane alone" if claim.is_part else ""


def _uncertain(claim: Proposition) -> str:
    both = claim.vehicle.dives
    varied = (
        "coefficients, fin rates and dead times" if both else "planar coefficients, rudder rate and dead time"
    )
    if claim.own:
        return (
            f"on a hull drawn for each flight, {varied} within the uncertainty that its file states, those "
            "without one as in the file"
        )
    if claim.spread > 0.0:
        return f"on a hull drawn for each flight, {varied} off by up to {100.0 * claim.spread:g} %"
    return "with the coefficients of its file"


def verdict_of(claim: Proposition, proof: Proof) -> str:
    """Return what was asked for, whether it is proven, and the bounds, in one line."""
    is_proven = proof.holds(claim.within, claim.within_depth)
    asked, found = f"{claim.within:g} m", metres(proof.off_bound)
    if len(proof.seas) > 1:
        found += f" in {proof.worst_sea}"
    if claim.vehicle.dives:
        asked += f" and {claim.within_depth:g} m of depth"
        found += f", {metres(proof.deep_bound)} of depth"
    return (
        f"{'Proven' if is_proven else 'Not proven'}{_part(claim)}: 99 % within {asked}, limit cycles from at "
        f"most 1 % of the starts (bounds: {found}, {100.0 * proof.cycle_bound:.2f} %)"
    )


def rows_of(proofs: Mapping[str, Proof], dives: bool = False) -> tuple[list[str], list[list[str]]]:
    """Return headings and rows: a row for each set of gains and sea, the starts on lines in its first.

    Args:
        proofs: by the name of the gains.
        dives: whether depths are among the columns.
    """
    several = max(len(proof.seas) for proof in proofs.values()) > 1
    head = ["gains", *(["sea"] if several else []), *_COLUMNS]
    if dives:
        head.insert(head.index(_COLUMNS[2]), _DEPTH)
    rows = []
    for label, p in proofs.items():
        for number, (name, sea) in enumerate(p.seas.items()):
            starts = [f"{p.cycles} of {len(p.unrest)}", f"{100.0 * p.cycle_bound:.1f}"]
            rows.append(
                [label, *([name] if several else []), _cell(sea.off_bound), _cell(sea.whole_bound)]
                + ([_cell(sea.deep_bound)] if dives else [])
                + [
                    f"{sea.lost} of {len(sea.rms)}",
                    *(starts if number == 0 else ["", ""]),
                    f"{sea.travel:.2f}",
                ]
            )
    return head, rows


def table_of(title: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Return a table for the terminal."""
    texts = 2 if "sea" in head else 1
    table = headed_table(title, head[:texts], head[texts:])
    for row in rows:
        table.add_row(*row)
    return table


def figures_of(proof: Proof) -> dict[str, Any]:
    """Return the figures of one set of gains, for programs."""
    worst = proof.seas[proof.worst_sea]
    return {
        "off_corners_bound": proof.off_bound,
        "bound": max(one.whole_bound for one in proof.seas.values()),
        "depth_bound": proof.deep_bound,
        "worst_sea": proof.worst_sea,
        "not_completed": sum(one.lost for one in proof.seas.values()),
        "flights": sum(len(one.rms) for one in proof.seas.values()),
        "limit_cycles": proof.cycles,
        "starts": len(proof.unrest),
        "limit_cycle_bound": proof.cycle_bound,
        "rudder_travel_per_metre": worst.travel,
        "seas": {
            name: {
                "off_corners_bound": one.off_bound, "bound": one.whole_bound, "depth_bound": one.deep_bound,
                "not_completed": one.lost, "flights": len(one.rms), "rudder_travel_per_metre": one.travel,
            }
            for name, one in proof.seas.items()
        },
    }  # fmt: skip
