"""Measured campaigns, predictions beside them, the loop, recorded runs, models side by side; as data frames."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    BekkerWong,
    Calibration,
    Campaign,
    Case,
    Comparison,
    EffectChoice,
    Estimate,
    LoopAnswer,
    Record,
    RecordedModel,
    RecordedRun,
    Scenario,
    Soil,
    Verdict,
    find_campaign,
    find_soil,
    read_record,
    write_campaign,
)
from soilbin.arguments import worded
from soilbin.progress import Progress, told_to
from soilbin.questions import CHANNELS, condition_columns, result_columns, without_empty

__all__ = [
    "Calibration", "Campaign", "Comparison", "LoopAnswer", "Record", "RecordedModel", "RecordedRun", "Verdict",
    "calibrate", "calibration_frame", "compare_case", "differences_frame", "error_frame", "find_campaign", "predict",
    "read_record", "record_frame", "run_loop", "runs_frame", "tell_campaign", "variance_frame", "write_campaign",
]


@worded
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


@worded
def predict(campaign: Union[Campaign, str], scenario: Optional[Scenario] = None,
            progress: Progress = "shown") -> pd.DataFrame:
    """A campaign as the analytic model predicts it, a row a run, nothing fitted.

    scenario: soil and effects in place of the declared ones. Columns: conditions, for each channel NAME_measured,
    NAME_predicted, its NAME_std_error and NAME_residual (predicted - measured), error. SI and radians.
    """
    known = find_campaign(campaign) if isinstance(campaign, str) else campaign
    model = BekkerWong(patch=False)
    predicted = _soilbin.predictions(model, scenario or known.scenario(), known, told_to(progress))
    rows = []
    for run in predicted.runs:
        row = condition_columns(run.measured.at)
        said = result_columns(run.predicted.result)
        for name in CHANNELS:
            measured = getattr(run.measured, name)
            row[name + "_measured"] = np.nan if measured is None else measured
            row[name + "_predicted"], row[name + "_std_error"] = said[name], said[name + "_std_error"]
            row[name + "_residual"] = said[name] - row[name + "_measured"]
        rows.append({**row, "error": run.predicted.error})
    return without_empty(pd.DataFrame(rows))


@worded
def error_frame(prediction: pd.DataFrame) -> pd.DataFrame:
    """Of what predict gave, a row a measured channel: runs, rmse, bias (predicted - measured), range. SI."""
    rows = {}
    for name in CHANNELS:
        residual = prediction[name + "_residual"].dropna()
        if len(residual):
            measured = prediction.loc[residual.index, name + "_measured"]
            rows[name] = {"runs": len(residual), "rmse": float(np.sqrt((residual**2).mean())),
                          "bias": float(residual.mean()), "range": float(measured.max() - measured.min())}
    return pd.DataFrame(rows).T


@worded
def run_loop(campaign: Union[Campaign, str], *, folds: int = 5, seed: int = 1, validate: bool = True, threads: int = 1,
             progress: Progress = "shown") -> LoopAnswer:
    """What the model lacks: residual, cause, effect added, error before and after (docs/guide/loop.md).

    folds: parts into which the conditions are divided, each predicted from the others, 2 .. 50. validate: redo the whole
    procedure in each fold; without it those errors are absent. threads change the time, never the answer. Raises
    InputError for a campaign that can't be used; one too small to say anything is a verdict.
    """
    known = find_campaign(campaign) if isinstance(campaign, str) else campaign
    return _soilbin.run_loop(known, folds, seed, validate, threads, told_to(progress))


@worded
def record_frame(record: Union[Record, str, Path]) -> pd.DataFrame:
    """A record's runs, a row each: packing, seconds, steady, drift, condition, result, error. SI and radians."""
    known = record if isinstance(record, Record) else read_record(Path(record))
    rows = []
    for run in known.runs:
        rows.append({"packing": run.packing, "seconds": run.seconds, "steady": run.steady, "drift": run.drift,
                     **condition_columns(run.answer.at), **result_columns(run.answer.result),
                     "error": run.answer.error})
    return without_empty(pd.DataFrame(rows))


@worded
def tell_campaign(records: Union[Record, str, Path, Sequence[Union[Record, str, Path]]], *, hide: Sequence[str] = (),
                  effects: Sequence[Union[EffectChoice, str]] = (), soil: Optional[Soil] = None, name: str = "told",
                  only_steady: bool = False, seed: int = 1) -> Campaign:
    """Recorded runs of grains as a measured campaign, as `soilbin campaign` tells them (docs/reference/campaigns.md).

    hide: what the analyst is not told: conditions such as "longitudinal_incline", "lugs", "bin". effects: that his model
    already has. soil: whose semi-empirical values he is told; absent: those of the first record's case. only_steady:
    leaves out runs that did not become steady. seed: of the order of the rows. write_campaign keeps it in a folder.
    Raises InputError for records of other inputs than the first one's, a soil without such values, an unknown word.
    """
    several: list[Union[Record, str, Path]] = []
    several += [records] if isinstance(records, (Record, str, Path)) else records
    known = [r if isinstance(r, Record) else read_record(Path(r)) for r in several]
    return _soilbin.tell_campaign(known, list(hide), list(effects), soil, name, only_steady, seed)


@worded
def calibrate(soil: Union[Soil, str], contact: str = "sand", *,
              targets: Optional[Mapping[str, Union[Estimate, float]]] = None,
              vary: Mapping[str, tuple[float, float]] = {}, keep: Sequence[str] = (), design: str = "L9",
              runs: int = 30, near: float = 0.05, within: float = 0.03, probability: float = 0.9,
              test: str = "triaxial", strength: str = "peak", stresses: Sequence[float] = (10e3, 20e3, 40e3),
              settling_friction: float = 1, across: int = 16, packings: int = 0, seed: int = 1, threads: int = 0,
              store: Union[str, Path, None] = None, progress: Progress = "shown") -> Calibration:
    """Contacts of a soil's grains from virtual element tests (docs/theory/calibration.md).

    contact: "sand", grains on grains by `test`, "triaxial" or "direct-shear" (take the one that measured the target), or
    "tire", grains on the tire by the tilting board. targets: what was measured, Estimates in SI: friction_angle [rad] and cohesion [Pa] of sand (absent: the soil's own), board_angle
    [rad] of a tire. vary: other bounds of a contact's numbers [SI]; keep: numbers that aren't varied. design: "L9", "L16"
    or "L25". runs: experiments at most. near: share of a target within which candidates lie; within, probability: it ends
    where each target is met within this share with this probability; all in 0 .. 1. strength: "peak" or "residual";
    stresses [Pa], settling_friction 0 .. 1: of cell and shear box. across: grains along a side of the board. packings: samples
    an experiment; 0: cell and shear box 1, board 4. seed: of packings and search. store: a file that keeps finished experiments,
    so that stopped work goes on; None: none. Raises InputError for a question that makes no sense, NoSolution where too
    many experiments fail to learn from the rest.
    """
    known = find_soil(soil) if isinstance(soil, str) else soil
    asked = None if targets is None else dict(targets)
    return _soilbin.calibrate(known, contact=contact, targets=asked, vary=dict(vary), keep=list(keep), design=design,
                              runs=runs, near=near, within=within, probability=probability, test=test,
                              strength=strength, stresses=list(stresses), settling_friction=settling_friction, across=across,
                              packings=packings, seed=seed, store=store, threads=threads, progress=told_to(progress))


@worded
def calibration_frame(calibration: Calibration) -> pd.DataFrame:
    """A calibration's experiments, a row each: stage, seed, factors, targets and their _std_error, error, seconds. SI."""
    rows = []
    for run in calibration.runs:
        row: dict[str, Any] = {"stage": run.stage, "seed": run.seed, **run.values}
        for name in calibration.targets:
            got = run.results.get(name)
            row[name] = np.nan if got is None else got.value
            row[name + "_std_error"] = np.nan if got is None else got.std_error
        rows.append({**row, "error": run.error, "seconds": run.seconds, "from_store": run.from_store})
    return pd.DataFrame(rows)


@worded
def variance_frame(calibration: Calibration, target: str) -> pd.DataFrame:
    """The orthogonal design's analyses of one target, a row a factor: range R of the level means [SI], analysis of
    variance with f and p_value. Raises KeyError for an unknown target and where a run of the design failed."""
    columns = ("source", "range", "sum_of_squares", "freedom", "mean_square", "f", "p_value", "pooled")
    return pd.DataFrame([{name: getattr(row, name) for name in columns} for row in calibration.variance[target]])


@worded
def compare_case(case: Union[Case, str], effects: Sequence[Union[EffectChoice, str]] = (),
                 record: Union[Record, Sequence[RecordedRun], None] = None,
                 measured: Union[Campaign, str, None] = None) -> Comparison:
    """Models, grains and measurements of a study side by side (docs/guide/compare.md).

    The study's analytic models and the base model with each of `effects`; runs of grains, of a record; a campaign of
    the same wheel. Raises InputError where wheels or conditions don't meet.
    """
    question = _soilbin.find_case(case) if isinstance(case, str) else case
    runs = record.runs if isinstance(record, Record) else list(record or [])
    known = find_campaign(measured) if isinstance(measured, str) else measured
    return _soilbin.compare_case(question, list(effects), runs, known)


@worded
def differences_frame(comparison: Comparison) -> pd.DataFrame:
    """Every difference of a comparison, a row each: side, reference, channel, condition, values, finding. SI."""
    at = comparison.case.study.conditions
    rows = []
    for d in comparison.differences:
        rows.append({"side": comparison.sides[d.side].label, "reference": comparison.sides[d.reference].label,
                     "channel": d.channel, **condition_columns(at[d.condition]), "value": d.value.value,
                     "reference_value": d.reference_value.value, "difference": d.difference,
                     "std_error": d.std_error, "freedom": d.freedom, "scatter": d.scatter, "share": d.share,
                     "finding": d.finding.name})
    return without_empty(pd.DataFrame(rows))
