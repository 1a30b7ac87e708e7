"""Measured campaigns, predictions beside them, the loop, recorded runs, models side by side; as data frames."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    BekkerWong,
    Campaign,
    Case,
    Comparison,
    EffectChoice,
    LoopAnswer,
    Record,
    RecordedModel,
    RecordedRun,
    Scenario,
    Verdict,
    find_campaign,
    read_record,
)
from soilbin.progress import Progress, told_to
from soilbin.questions import CHANNELS, condition_columns, result_columns, without_empty

__all__ = [
    "Campaign", "Comparison", "LoopAnswer", "Record", "RecordedModel", "RecordedRun", "Verdict", "compare_case",
    "differences_frame", "error_frame", "find_campaign", "predict", "read_record", "record_frame", "run_loop",
    "runs_frame",
]


def runs_frame(campaign: Union[Campaign, str]) -> pd.DataFrame:
    """A campaign's runs, a row each: conditions, setpoint, what was measured (NaN where it wasn't). SI and radians."""
    known = find_campaign(campaign) if isinstance(campaign, str) else campaign
    rows = []
    for run in known.runs:
        row: dict[str, Any] = {**condition_columns(run.at), "setpoint": run.setpoint}
        for name in CHANNELS:
            value = getattr(run, name)
            row[name] = np.nan if value is None else value
        rows.append(row)
    return without_empty(pd.DataFrame(rows))


def predict(campaign: Union[Campaign, str], scenario: Optional[Scenario] = None,
            progress: Progress = "shown") -> pd.DataFrame:
    """A campaign as the analytic model predicts it, a row a run, nothing fitted.

    scenario: soil and effects in place of the declared ones. Columns: conditions, for each channel NAME_measured,
    NAME_predicted and NAME_residual (predicted less measured), error. SI and radians.
    """
    known = find_campaign(campaign) if isinstance(campaign, str) else campaign
    model = BekkerWong(errors=False, patch=False)
    predicted = _soilbin.predictions(model, scenario or known.scenario(), known, told_to(progress))
    rows = []
    for run in predicted.runs:
        row = condition_columns(run.measured.at)
        said = result_columns(run.predicted.result)
        for name in CHANNELS:
            measured = getattr(run.measured, name)
            row[name + "_measured"] = np.nan if measured is None else measured
            row[name + "_predicted"] = said[name]
            row[name + "_residual"] = said[name] - row[name + "_measured"]
        rows.append({**row, "error": run.predicted.error})
    return without_empty(pd.DataFrame(rows))


def error_frame(prediction: pd.DataFrame) -> pd.DataFrame:
    """Of what predict gave, a row a measured channel: runs, rmse, bias (predicted less measured), range. SI."""
    rows = {}
    for name in CHANNELS:
        residual = prediction[name + "_residual"].dropna()
        if len(residual):
            measured = prediction.loc[residual.index, name + "_measured"]
            rows[name] = {"runs": len(residual), "rmse": float(np.sqrt((residual**2).mean())),
                          "bias": float(residual.mean()), "range": float(measured.max() - measured.min())}
    return pd.DataFrame(rows).T


def run_loop(campaign: Union[Campaign, str], *, folds: int = 5, seed: int = 1, validate: bool = True, threads: int = 1,
             progress: Progress = "shown") -> LoopAnswer:
    """What the model lacks: residual, cause, effect added, error before and after (docs/loop.md).

    folds: parts into which conditions are dealt for the honest errors, 2 .. 50. validate: redo the whole procedure in
    each fold; without it those errors are absent. threads change the time, never the answer. Raises InputError for a
    campaign that can't be used; one too small to say anything is a verdict.
    """
    known = find_campaign(campaign) if isinstance(campaign, str) else campaign
    return _soilbin.run_loop(known, folds, seed, validate, threads, told_to(progress))


def record_frame(record: Union[Record, str, Path]) -> pd.DataFrame:
    """A record's runs, a row each: packing, seconds, steady, drift, condition, result, error. SI and radians."""
    known = record if isinstance(record, Record) else read_record(Path(record))
    rows = []
    for run in known.runs:
        rows.append({"packing": run.packing, "seconds": run.seconds, "steady": run.steady, "drift": run.drift,
                     **condition_columns(run.answer.at), **result_columns(run.answer.result),
                     "error": run.answer.error})
    return without_empty(pd.DataFrame(rows))


def compare_case(case: Union[Case, str], effects: Sequence[Union[EffectChoice, str]] = (),
                 record: Union[Record, Sequence[RecordedRun], None] = None,
                 measured: Union[Campaign, str, None] = None) -> Comparison:
    """Models, grains and measurements of a study side by side (docs/compare.md).

    The study's analytic models and the base model with each of `effects`; runs of grains, of a record; a campaign of
    the same wheel. Raises InputError where wheels or conditions don't meet.
    """
    question = _soilbin.find_case(case) if isinstance(case, str) else case
    runs = record.runs if isinstance(record, Record) else list(record or [])
    known = find_campaign(measured) if isinstance(measured, str) else measured
    return _soilbin.compare_case(question, list(effects), runs, known)


def differences_frame(comparison: Comparison) -> pd.DataFrame:
    """Every difference of a comparison, a row each: side, reference, channel, condition, values, finding. SI."""
    at = comparison.case.study.conditions
    rows = []
    for d in comparison.differences:
        rows.append({"side": comparison.sides[d.side].label, "reference": comparison.sides[d.reference].label,
                     "channel": d.channel, **condition_columns(at[d.condition]), "value": d.value.value,
                     "reference_value": d.reference_value.value, "difference": d.difference,
                     "std_error": d.std_error, "scatter": d.scatter, "share": d.share, "finding": d.finding.name})
    return without_empty(pd.DataFrame(rows))
