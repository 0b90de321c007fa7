"""Write a vehicle file and a survey for it, and fly the survey."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.result_files import replacing
from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.vehicle import Vehicle
from auv_sim.command_line import say, to_type
from auv_sim.own_vehicle.new.assumed_diver import assumed_diver
from auv_sim.own_vehicle.new.assumed_hull import assumed_hull
from auv_sim.own_vehicle.new.next_measurement import headline, worth_measuring
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts, check_facts
from auv_sim.own_vehicle.new.trial_flight import TrialSurvey, trial_survey
from auv_sim.own_vehicle.new.vehicle_text import text_of
from auv_sim.own_vehicle.output_files import check_outputs, survey_beside
from auv_sim.terminal import go_on, headed_table, wrote


def new_vehicle(facts: OwnerFacts, file: Path, overwrite: bool, console: Console) -> Vehicle:
    """Fly a survey on the assumed hull, write the files, and print what to measure next.

    Files of these names are replaced last, and only by files that were checked and flown.

    Args:
        facts: given by the owner.
        file: the vehicle file to write; the survey stands beside it.
        overwrite: whether a file of that name is replaced.
        console: for the output.

    Returns:
        The vehicle.

    Raises:
        ConfigurationError: the facts contradict each other, the file exists, or the vehicle does not fly.
    """
    check_facts(facts)
    survey = survey_beside(file)
    check_outputs((file, survey), (), overwrite)
    vehicle, text = described(facts, file)
    with console.status("flying a survey on the assumed hull"):
        flown = trial_survey(vehicle, str(survey))
    with replacing(file) as draft, replacing(survey) as survey_draft:
        draft.write_text(text, encoding="utf-8")
        survey_draft.write_text(flown.text, encoding="utf-8")
    wrote(console, file, "the vehicle; numbers that were not given are marked `assumed`")
    able = " that it can fly" if flown.is_flown else ""
    wrote(console, survey, f"a survey{able}, {flown.mission.path.length:.0f} m")
    _show(console, flown)
    _advise(console, facts, vehicle, file)
    return vehicle


def _show(console: Console, survey: TrialSurvey) -> None:
    table = headed_table(
        "The survey on the assumed hull, gains by the rule", (),
        ("current (m/s)", "flown", "rms (m)", "largest (m)"),
    )  # fmt: skip
    for trial in survey.trials:
        table.add_row(
            f"{trial.current:.2f}", f"{trial.share:.1%}", f"{trial.rms:.2f}", f"{trial.largest:.2f}"
        )
    console.print(table)
    if not survey.is_flown:
        say(
            "notice the survey is not flown within 1 m everywhere; the rule's gains on the assumed hull are "
            "slow: identify the hull, and tune",
            error=True,
        )


def described(facts: OwnerFacts, file: Path) -> tuple[Vehicle, str]:
    """Return the vehicle, and its file's text with the advice for this vehicle at its head.

    Nothing is written: the text is checked as the content of `file`.
    """
    assumed, depth = assumed_hull(facts), None
    hull = assumed.hull
    if facts.planes_deg is not None:
        hull, depth = assumed_diver(assumed, facts)
    text = text_of(facts, assumed, hull, depth, "")
    vehicle = yaml_file.checked(yaml_file.parse_text(text, str(file)), file, Vehicle)
    return vehicle, text_of(facts, assumed, hull, depth, headline(worth_measuring(facts, vehicle)))


def _advise(console: Console, facts: OwnerFacts, vehicle: Vehicle, file: Path) -> None:
    for notice in gains_for(vehicle).notices:
        say(f"notice {notice}", error=True)
    measurements = worth_measuring(facts, vehicle)
    if measurements:
        console.print("\nWorth measuring, the most helpful first:")
    for number, measurement in enumerate(measurements, 1):
        console.print(f"  {number}. {measurement.what}", markup=False)
        console.print(f"     [dim]{measurement.why}[/dim]")
    go_on(console, "Rehearse the manoeuvres", to_type("vehicle.py", "manoeuvres", vehicle=file))
