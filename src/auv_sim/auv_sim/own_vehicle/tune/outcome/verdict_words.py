"""What a verdict says: the table in the terminal, the comments at the head of the file."""

from __future__ import annotations

import argparse

from rich.console import Console
from rich.table import Table

from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import to_type
from auv_sim.own_vehicle.tune.gain_space import ratios_at
from auv_sim.own_vehicle.tune.gain_verdict import FOUND, PRESENT, RULE, GainVerdict, Held
from auv_sim.own_vehicle.tune.objective import Ratios
from auv_sim.own_vehicle.tune.sampled_loop import LARGEST_FACTOR, Margins
from auv_sim.own_vehicle.tune.tuning_problem import Problem
from auv_sim.terminal import headed_table

#: What each source of gains is called in the file.
_KINDS = {
    FOUND: "found by a search",
    PRESENT: "those of {}, the search found none better",
    RULE: "by the rule of docs/tuning.md, the search found none better",
}
#: Options that a search's result depends on, in the order of the command in the file.
_OPTIONS = ("delay", "rate", "slowest", "sea", "spread", "members", "generations", "seed")


def report(console: Console, verdict: GainVerdict, present: str, title: str) -> None:
    """Print the table of held-out flights, and which gains the vehicle gets.

    Args:
        console: where to.
        verdict: of the held-out flights.
        present: name of the gains that the vehicle has.
        title: what was tuned.
    """
    for reason in verdict.why:
        console.print(f"not accepted, {reason}", markup=False)
    if verdict.held:
        console.print(_table(verdict, present, title))
    stays = f"the present gains ({present}) stay" if verdict.source == PRESENT else "the rule's gains stay"
    mixed = f" ({verdict.mixed})" if verdict.mixed else ""
    result = f"accepted{mixed}" if verdict.accepted else stays
    console.print(f"{result}; margins {words_of(verdict.margins)}", markup=False)


def _table(verdict: GainVerdict, present: str, title: str) -> Table:
    table = headed_table(
        f"Held-out flights with gains found, against others: {title}", ("hull", "against"),
        ("flights", "distance", "off corners", "travel", "late rate °/s", "theirs"),
    )  # fmt: skip
    for k, held in enumerate(verdict.held):
        hull = "the vehicle" if k == 0 else f"drawn {k}"
        table.add_row(
            hull, "the rule", str(held.flights), *_cells(held.ratios, held.unrest, held.ruled_unrest)
        )
        if held.present is not None:
            table.add_row("", present, "", *_cells(held.present.ratios, held.unrest, held.present.unrest))
    return table


def _cells(ratios: Ratios, unrest: float, theirs: float) -> list[str]:
    return [*(f"× {ratio:.2f}" for ratio in ratios), f"{unrest:.2f}", f"{theirs:.2f}"]


def words_of(margins: Margins) -> str:
    """Return margins in words."""
    if not margins.is_stable:
        return "none: the linear loop is unstable"
    down = "any factor" if margins.down >= LARGEST_FACTOR * 0.99 else f"a factor of {margins.down:.1f}"
    return (
        f"of gain a factor of {margins.up:.1f} up and {down} down, of delay {1e3 * margins.delay:.0f} ms more"
    )


def comments_of(
    options: argparse.Namespace, own: Vehicle, problem: Problem, verdict: GainVerdict, present: str
) -> list[str]:
    """Return the paragraphs at the head of the file: the command, the margins, the held-out flights."""
    flags = [part for name in _OPTIONS for part in (f"--{name}", f"{getattr(options, name)}")]
    comments = [
        f"Gains for {own.name}, {_KINDS[verdict.source].format(present)}:",
        " " + to_type("vehicle.py", "tune", options.vehicle, *flags),
        f"Delay {1e3 * (options.delay + own.rudder.dead_time):.0f} ms, of which the fin's dead time "
        f"{1e3 * own.rudder.dead_time:.0f} ms. Margins {words_of(verdict.margins)}.",
    ]
    # Those of gains that are not in the file would be read as the file's.
    for k, held in enumerate(verdict.held if verdict.accepted else ()):
        comments.append(_held_out(k, held, present))
    comments += [f"Not accepted: {reason}." for reason in verdict.why]
    ratios = ", ".join(f"{name} {value:.3g}" for name, value in ratios_at(verdict.point).items())
    words = f"Ratios: {ratios}." if verdict.source != PRESENT else ""
    return [*comments, words] if words else comments


def planes_comments_of(verdict: GainVerdict, present: str) -> list[str]:
    """Return the paragraphs about the stern planes."""
    comments = [f"Gains of the stern planes {_KINDS[verdict.source].format(present)}."]
    for held in verdict.held if verdict.accepted else ():
        words = _held_out(0, held, present)
        comments.append(f"{words} Distances are errors of depth, off corners settled ones.")
    return [
        *comments,
        f"Margins {words_of(verdict.margins)}.",
        *(f"Not accepted: {reason}." for reason in verdict.why),
    ]


def _held_out(k: int, held: Held, present: str) -> str:
    name = "the vehicle" if k == 0 else f"drawn hull {k}"
    words = f"Held out, {name}, {held.flights} flights: against the rule {_ratios(held.ratios)}; "
    if held.present is not None:
        words += f"against {present} {_ratios(held.present.ratios)}; "
    return words + f"late rate on lines at most {held.unrest:.2f} deg/s."


def _ratios(ratios: Ratios) -> str:
    distance, off, travel = ratios
    return f"distance {distance:.2f} times, off corners {off:.2f}, travel of the fin {travel:.2f}"
