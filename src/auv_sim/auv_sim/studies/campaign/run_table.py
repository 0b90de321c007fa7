"""Makes rows of a table from runs: number, varied values, and the figures of the flight."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pyarrow as pa

from auv_sim.flight.batch.flight_figures import Flights, SpatialFlights
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.study_file import Study


def schema_of(plan: StudyPlan) -> pa.Schema:
    """Return the columns of a study's table."""
    fields = [pa.field("run", pa.int64())]
    for name, distribution in plan.study.vary.items():
        switches = all(isinstance(value, bool) for value in distribution.extremes)
        kind = pa.float64() if distribution.is_numeric else pa.bool_() if switches else pa.string()
        fields.append(pa.field(name, kind))
    fields.append(pa.field("success", pa.bool_()))
    for field in _fields(plan):
        if field.name.startswith("subpath_"):
            fields.append(pa.field(field.name, pa.list_(pa.float64())))
        elif field.name in ("completed", "finite"):
            fields.append(pa.field(field.name, pa.bool_()))
        else:
            fields.append(pa.field(field.name, pa.int64() if field.name == "steps" else pa.float64()))
    return pa.schema(fields)


def _fields(plan: StudyPlan) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(SpatialFlights if plan.dives else Flights)


def _values(flights: Flights, name: str) -> Any:
    """Return a figure of all flights; NaN where all are in the plane and it is about depth."""
    shape = flights.subpath_duration.shape if name.startswith("subpath_") else len(flights)
    found = getattr(flights, name, None)
    return np.full(shape, np.nan) if found is None else found


def table_of(plan: StudyPlan, runs: range, flights: Flights, subpaths: list[int]) -> pa.Table:
    """Return a row for each run.

    Args:
        plan: the study.
        runs: the numbers of the runs.
        flights: their figures, in order.
        subpaths: how many subpaths the path of each has.
    """
    schema = schema_of(plan)
    drawn = [plan.values(run) for run in runs]
    columns: dict[str, Any] = {"run": list(runs)}
    for name in plan.study.vary:
        values = [row[name] for row in drawn]
        columns[name] = [str(v) for v in values] if schema.field(name).type == pa.string() else values
    columns["success"] = successes(plan.study, flights)
    for field in _fields(plan):
        values = _values(flights, field.name)
        if field.name.startswith("subpath_"):
            columns[field.name] = [row[:n].tolist() for row, n in zip(values, subpaths, strict=True)]
        else:
            columns[field.name] = values
    return pa.table({name: pa.array(columns[name], schema.field(name).type) for name in schema.names}, schema)


def flown_enough(study: Study, shares: Any) -> Any:
    """Return which flown shares (0 to 1) reach the study's least one."""
    return shares >= study.flown


def successes(study: Study, flights: Flights) -> Any:
    """Return which flights flew the path to its end within the study's limits; NaN exceeds any limit."""
    good = flights.completed & flown_enough(study, flights.flown_share)
    for figure, most in study.success.items():
        good &= _values(flights, figure) <= most
    return good
