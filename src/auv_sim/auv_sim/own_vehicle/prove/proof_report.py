"""What a proof leaves behind: page, pictures, summary, and what is printed."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import NamedTuple

from rich.console import Console

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.strict_json import without_nan
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, say, to_type
from auv_sim.own_vehicle.output_files import survey_beside, vehicle_file_of
from auv_sim.own_vehicle.prove import proof_page, proof_picture, proof_words, provenance
from auv_sim.own_vehicle.prove.confidence import flights_needed
from auv_sim.own_vehicle.prove.law_comparison import PEER, LawTables
from auv_sim.own_vehicle.prove.one_flight import draw_flight, flight_words, worst_of
from auv_sim.own_vehicle.prove.proof import Proof, Proposition
from auv_sim.own_vehicle.prove.proof_page import Page, PageTable
from auv_sim.own_vehicle.prove.proof_words import rows_of, table_of
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.trial_flights import Flight
from auv_sim.own_vehicle.tune.tune_session import conditions_again
from auv_sim.terminal import go_on, wrote

_ALONG = "True distance in the sea: 99 % of the flights at 95 % confidence"
_LAWS = "All laws in the sea {sea}, each tuned by one search (generations: {generations})"
_STRAIGHT = "The same laws on courses of straight legs, with that of MSS"
_NO_OTHERS = (
    "The law of MSS is for straight legs alone and was tuned on them; the others were tuned on the courses "
    "above. It needs no velocity through the water."
)


class Outputs(NamedTuple):
    """Files that the command writes."""

    page: Path
    picture: Path
    flight: Path
    summary: Path


class Result(NamedTuple):
    """All that was found.

    Attributes:
        claim: what was to be proven.
        label: name of the gains.
        gains: flown.
        proof: of them.
        laws: other laws; None if they were not asked for.
        flights: all of the claim.
    """

    claim: Proposition
    label: str
    gains: GainSet
    proof: Proof
    laws: LawTables | None
    flights: list[Flight]


def conclude(
    console: Console, options: argparse.Namespace, own: Vehicle, outputs: Outputs, result: Result
) -> int:
    """Write the files and print what holds; return the exit code.

    Raises:
        NotWritten: a file cannot be written.
    """
    claim, proof = result.claim, result.proof
    holds = proof.holds(claim.within, claim.within_depth)
    sentence = proof_words.sentence_of(claim, result.label, proof)
    verdict = proof_words.verdict_of(claim, proof)
    notice = ""
    if claim.flights < flights_needed():
        notice = f"{claim.flights} flights bound nothing: 99 % at 95 % need {flights_needed()}"
    tables = _tables(options, result)
    for table in tables:
        console.print(table_of(table.title, table.head, table.rows))
    console.print(sentence, soft_wrap=False)
    console.print(verdict, style="bold green" if holds else "bold red")
    if notice:
        say(f"notice {notice}", error=True)
    worst = worst_of(claim, proof)
    refly = provenance.command_of(options, refly=worst)
    _draw(outputs, result, verdict, worst)
    page = Page(
        f"{own.name}: proof of the gains {result.label}", holds, verdict, sentence, notice,
        tables, outputs.picture, outputs.flight,
        flight_words(claim, result.flights, worst), refly,
        provenance.facts_of(options, provenance.gains_name(options, own)),
    )  # fmt: skip
    proof_page.write(outputs.page, page)
    write_text(outputs.summary, _json(options, sentence, holds, worst, result))
    wrote(console, outputs.page, "the page, for a browser and to print")
    wrote(console, outputs.picture, "its distributions")
    wrote(console, outputs.flight, f"the worst flight; again: {refly}")
    wrote(console, outputs.summary, "its figures, for programs")
    _next(console, options, own, holds)
    return EXIT_DONE if holds else EXIT_FAILED


def _draw(outputs: Outputs, result: Result, verdict: str, worst: int) -> None:
    """Draw the distributions and the worst flight."""
    claim, proof = result.claim, result.proof
    # Laws beside a vehicle that dives fly its plane: their distances are not those in three dimensions.
    others = {} if result.laws is None or claim.vehicle.dives else dict(result.laws.alike)
    shown = {result.label: proof} | {name: one for name, one in others.items() if name != result.label}
    depth = claim.within_depth if claim.vehicle.dives else None
    holds = proof.holds(claim.within, claim.within_depth)
    proof_picture.draw(outputs.picture, verdict, holds, claim.within, shown, depth)
    draw_flight(outputs.flight, claim, result.label, result.gains, result.flights, worst)


def _tables(options: argparse.Namespace, result: Result) -> list[PageTable]:
    """Return the tables: of the proof, and of the laws."""
    dives = result.claim.vehicle.dives
    tables = [PageTable(_ALONG, *rows_of({result.label: result.proof}, dives), "")]
    if result.laws is None:
        return tables
    plane = ", in the horizontal plane" if dives else ""
    title = _LAWS.format(sea=result.proof.worst_sea, generations=options.generations) + plane
    hint = "" if result.laws.straight else f"{PEER} is not among them: it needs a hull with coefficients."
    tables.append(PageTable(title, *rows_of(result.laws.alike), hint))
    if result.laws.straight:
        tables.append(PageTable(_STRAIGHT + plane, *rows_of(result.laws.straight), _NO_OTHERS))
    return tables


def missions_for(own: Vehicle, file: str) -> list[Path]:
    """Return the survey that `vehicle.py new` wrote for a vehicle, if it did.

    Without it there is none where the default mission fits, which has newtons; else a placeholder.

    Args:
        own, file: the vehicle and its file.
    """
    survey = survey_beside(Path(file).with_name(vehicle_file_of(own.name).name))
    if survey.is_file():
        return [survey]
    return [] if own.thrust_unit == "N" else [Path("MISSION.yaml")]


def _next(console: Console, options: argparse.Namespace, own: Vehicle, holds: bool) -> None:
    if holds:
        words = {"vehicle": options.vehicle, "params": options.params or None}
        go_on(console, "Fly them", to_type("mission.py", *missions_for(own, options.vehicle), **words))
    else:
        rest = conditions_again(options)
        rest += ["--overwrite"] if Path("tuned.yaml").exists() else []
        line = to_type("vehicle.py", "tune", options.vehicle, *rest)
        go_on(console, "Tune", line)


def _json(options: argparse.Namespace, sentence: str, holds: bool, worst: int, result: Result) -> str:
    proofs = {result.label: result.proof} | (dict(result.laws.alike) if result.laws else {})
    proofs[result.label] = result.proof
    asked = {
        name: value
        for name, value in vars(options).items()
        if name not in ("run", "usual", "quiet", "workers", "made")
    }
    content = {
        "proven": holds,
        "sentence": sentence,
        "worst_flight": worst,
        "options": asked,
        "gains": {name: proof_words.figures_of(proof) for name, proof in proofs.items()},
        "straight_legs": {
            name: proof_words.figures_of(proof)
            for name, proof in (result.laws.straight if result.laws else {}).items()
        },
    }
    return json.dumps(without_nan(content), indent=2, default=str) + "\n"
