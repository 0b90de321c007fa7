"""The claims of case 3 and the theorems: observer, current, exponential decay."""

from __future__ import annotations

import numpy as np

from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.curves.composite import CompositePath
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.navigation.current_observer import CurrentObserverConfig
from auv_path_following.vehicle import Vehicle
from auv_sim.flight.metrics import OBSERVER_SETTLING_TIME
from auv_sim.studies.paper.cases import CURRENT
from auv_sim.studies.paper.claims import measures as m
from auv_sim.studies.paper.claims import theorems
from auv_sim.studies.paper.claims.following import Runs
from auv_sim.studies.paper.claims.paper_claim import FAILS, HOLDS, Number, PaperClaim, verdict
from auv_sim.studies.paper.claims.theorems import Checked

#: An estimate this near to the truth has converged, m/s.
ESTIMATED = 0.005
#: Subpaths that curve, counted from 0.
CURVES = (2, 4, 5)
#: Fits worse than this are no exponential; the envelope of an oscillation has steps.
FIT, ENVELOPE_FIT = 0.98, 0.9
#: How far a fitted rate may be from the eigenvalue.
RATE_TOLERANCE = 0.15


def observer(runs: Runs) -> PaperClaim:
    """Judge whether the estimate converges to the true current."""
    run = runs["3-with"]
    error = np.hypot(run.Vx_est - run.Vx_true, run.Vy_est - run.Vy_true)
    worst = float(error[run.t - run.t[0] >= OBSERVER_SETTLING_TIME].max())
    return PaperClaim(
        "observer",
        "Section 5.3, Fig. 12",
        "The observer's estimate converges to the true current.",
        f"From {OBSERVER_SETTLING_TIME:g} s on to the end the estimate is within {ESTIMATED:g} m/s of "
        "the truth.",
        (
            Number("error at the start", float(error[0]), "m/s"),
            Number("largest error after 15 s", worst, "m/s", 6),
        ),
        HOLDS if worst <= ESTIMATED else FAILS,
        12,
    )


def without_observer(runs: Runs, path: CompositePath) -> PaperClaim:
    """Judge whether an error remains without the observer, above all on curves."""
    numbers, errors = [], {}
    for name, label in (
        ("with", "with the observer"),
        ("without", "without it"),
        ("los", "proportional LOS (robust.yaml)"),
        ("ilos", "integral LOS (robust.yaml)"),
        ("robust", "AILOS (robust.yaml)"),
    ):
        rows = [m.steady_distance(runs[f"3-{name}"], path, i) for i in range(path.n)]
        curves = float(np.mean([rows[i] for i in CURVES]))
        lines = float(np.mean([rows[i] for i in range(path.n) if i not in CURVES]))
        errors[name] = (lines, curves)
        numbers += [
            Number(f"{label}: rms on lines", lines, "m"),
            Number(f"{label}: rms on curves", curves, "m"),
        ]
    held = {
        "that an error remains": min(errors["without"]) >= 5.0 * max(errors["with"]),
        "that it is larger on curves": errors["without"][1] > errors["without"][0],
    }
    return PaperClaim(
        "without_observer",
        "Section 5.3, Fig. 11",
        "Without the observer the current leaves an error, above all on curved subpaths.",
        "Without it the mean of the subpaths' steady rms distances, on lines and on curves, is at "
        "least five times "
        "that with it; and larger on curves than on lines.",
        tuple(numbers),
        verdict(held, "in"),
        11,
        "On a straight line the error depends on how the current crosses it; the paper's current of 0.22 m/s "
        "lies nearly along some of its lines and across others.",
    )


def decays(
    runs: Runs,
    guidance: PathFollowerConfig,
    autopilot: AutopilotConfig,
    eq35: CurrentObserverConfig,
    vehicle: Vehicle,
    thrust: float,
) -> list[PaperClaim]:
    """Judge Theorems 1, 2, 3, 6, 7.

    Args:
        runs: name of the flight -> its run.
        guidance, autopilot, eq35: configurations of the flights; eq35 is the observer's.
        vehicle: hull and rudder.
        thrust: N.
    """
    heading = min(autopilot.nism.k1 * autopilot.nism.k2, autopilot.nism.k3 * autopilot.nism.k4)
    return [
        _guidance_alone(guidance),
        _theorem(
            2,
            "Section 4.1",
            "The observer's error decays exponentially in a constant current.",
            {"error": theorems.theorem_2(eq35, Current(*CURRENT))},
        ),
        _theorem(
            3,
            "Section 4.3",
            "Under NISM the heading error decays exponentially.",
            {"psi_e, Prestero": theorems.theorem_3(autopilot, vehicle, thrust)},
            "The theory's rate is that on the sliding surfaces. The rudder follows sigma_2 at a "
            "finite rate kp k5, so "
            "the surfaces are approached, not reached, and the heading comes back more slowly.",
        ),
        *_cascades(runs, guidance, heading, 0.5 * eq35.k_ob2),
    ]


def _guidance_alone(guidance: PathFollowerConfig) -> PaperClaim:
    """Judge Theorem 1."""
    still = theorems.theorem_1(guidance, NO_CURRENT)
    flowing = theorems.theorem_1(guidance, Current(*CURRENT))
    return _theorem(
        1,
        "Section 4.1",
        "With a perfect heading and a known current the path errors decay exponentially.",
        {
            "xe, no current": still["xe"],
            "ye, no current": still["ye"],
            "xe, current": flowing["xe"],
            "ye, current": flowing["ye"],
        },
    )


def _cascades(
    runs: Runs, guidance: PathFollowerConfig, heading: float, observer_rate: float
) -> list[PaperClaim]:
    """Judge Theorems 6 and 7; `heading` and `observer_rate` are those parts' slowest eigenvalues, 1/s."""
    Delta, k = guidance.ailos.lookahead, guidance.virtual_point.k
    slow = theorems.guidance_rate(Delta, _speed(runs, "1-nism-prestero"), 0.0)
    across = -np.sin(np.pi / 4) * CURRENT[0] + np.cos(np.pi / 4) * CURRENT[1]
    slow_in_current = theorems.guidance_rate(Delta, _speed(runs, "3-aside"), float(across))
    in_current = min(k, slow_in_current, heading, observer_rate)
    return [
        _theorem(
            6,
            "Section 4.4",
            "The cascade of guidance and heading control decays exponentially without a current.",
            {"|(xe, ye)|, case 1": Checked(_errors(runs, "1-nism-prestero"), min(k, slow, heading))},
            bound=True,
        ),
        _theorem(
            7,
            "Section 4.4",
            "So does the whole with the observer, in an unknown constant current.",
            {"|(xe, ye)|, case 3": Checked(_errors(runs, "3-aside"), in_current)},
            bound=True,
        ),
    ]


def _speed(runs: Runs, name: str) -> float:
    run = runs[name]
    rows = (run.s < 1.0) & (run.t - run.t[0] > 20.0)
    return float(np.mean(np.hypot(run.ur[rows], run.vr[rows])))


def _errors(runs: Runs, name: str) -> m.Decay:
    run = runs[name]
    rows = (run.s < 0.8) & (run.t - run.t[0] < 60.0)
    return m.decay(run.t[rows], m.envelope(np.hypot(run.xe, run.ye)[rows]), 4.5, 0.005)


def _theorem(
    number: int, place: str, text: str, checked: dict[str, Checked], remark: str = "", bound: bool = False
) -> PaperClaim:
    fit = ENVELOPE_FIT if bound else FIT
    numbers, exponential, rated = [], True, True
    for name, (measured, theory) in checked.items():
        numbers += [
            Number(f"{name}: fitted rate", measured.rate, "1/s"),
            Number(f"{name}: slowest eigenvalue in theory", theory, "1/s"),
            Number(f"{name}: R² of the fit", measured.fit, "", 4),
        ]
        exponential &= bool(measured.rate > 0.0 and measured.fit >= fit)
        share = measured.rate / theory
        rated &= share >= 1.0 - RATE_TOLERANCE and (bound or share <= 1.0 + RATE_TOLERANCE)
    outcome = HOLDS if exponential and rated else FAILS
    if exponential and not rated:
        outcome = "holds only with another rate than the theory's"
    return PaperClaim(
        f"theorem_{number}",
        f"Theorem {number}, {place}",
        text,
        f"A line fits the logarithm of the error{' (of its envelope)' if bound else ''} with R² of at "
        f"least {fit}, and "
        f"its slope is {'at least' if bound else 'within 15 % of'} the slowest eigenvalue of the "
        "linearised system"
        f"{', less 15 %' if bound else ''}.",
        tuple(numbers),
        outcome,
        0,
        remark,
    )
