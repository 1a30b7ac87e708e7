"""Questions and their answers as data frames."""
from __future__ import annotations

import itertools
import warnings
from collections.abc import Iterable, Sequence
from typing import Any, Optional, Union

import numpy as np
import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    Answer,
    BekkerWong,
    Case,
    ConeIndex,
    Model,
    ModelKind,
    OperatingCondition,
    ResistiveForce,
    Scenario,
    Shelf,
    TractionResult,
)
from soilbin.arguments import worded
from soilbin.progress import Progress, told_to

CONDITION = ("load", "slip", "speed", "longitudinal_incline", "transverse_incline", "yaw", "pass",
             "inflation_pressure", "moisture", "position", "run")
CHANNELS = tuple(_soilbin.channels())


def conditions(**axes: Any) -> list[OperatingCondition]:
    """Every combination of the values given, the first axis varying slowest.

    An axis is a number or a sequence of them, SI and radians: conditions(load=[2e3, 4e3], slip=np.linspace(0, 0.6, 7)).
    `pass` is a word of Python: write conditions(**{"pass": [1, 2]}). Raises TypeError for an unknown axis or where load
    or slip is missing, InputError for a value out of range.
    """
    values = [np.atleast_1d(axis).tolist() if not isinstance(axis, (str, bytes)) else [axis] for axis in axes.values()]
    return [OperatingCondition(**dict(zip(axes, point))) for point in itertools.product(*values)]


class SoilbinWarning(UserWarning):
    """What a person should know before believing an answer: a value that changes nothing, a wheel that sinks too deep.

    The command prints the same lines as "warning: ..."; warnings.simplefilter("ignore", SoilbinWarning) silences them.
    """


def warned(scenario: Scenario, answers: Sequence[Answer], stacklevel: int = 3,
           notes: Sequence[str] = ()) -> list[str]:
    """Warns of the notes and of what is doubtful in these answers of the analytic model; gives the sentences."""
    said = [*notes, *_soilbin.doubts_of(scenario, answers)]
    tell(said, stacklevel + 1)
    return said


def tell(sentences: Sequence[str], stacklevel: int = 3) -> None:
    """Each as a SoilbinWarning of the line that called the caller."""
    for sentence in sentences:
        warnings.warn(sentence, SoilbinWarning, stacklevel=stacklevel)


def checked(scenario: Scenario) -> Scenario:
    """The scenario; a TypeError in plain words where it is something else."""
    if not isinstance(scenario, Scenario):
        raise TypeError(f"scenario: expected a Scenario, such as Scenario('rover-wheel', 'dry-sand'), not {scenario!r}")
    return scenario


def one_condition(at: Optional[OperatingCondition], keywords: dict[str, Any], hint: str = "") -> OperatingCondition:
    """`at` with these attributes changed, or a condition of them alone. `hint`: what another value for `at` may mean."""
    if at is not None and not isinstance(at, OperatingCondition):
        raise TypeError(f"at: expected an OperatingCondition, not {at!r}; {hint}numbers go by their names, "
                        "such as load=80, slip=0.2")
    for name, value in keywords.items():
        if np.ndim(value) > 0:
            raise TypeError(f"{name}: one number is asked for, not {np.size(value)} of them; "
                            "sweep(wheel, conditions(...)) answers many")
    return OperatingCondition(**keywords) if at is None else at.replace(**keywords)


def names(shelf: Union[Shelf, str]) -> list[str]:
    """Every name on a shelf of the library, sorted: names("soils"); also tires, vehicles, studies, measured."""
    if isinstance(shelf, Shelf):
        return _soilbin.names(shelf)
    if shelf not in Shelf.__members__:
        raise _soilbin.InputError(f"no shelf {shelf!r}: there are {', '.join(Shelf.__members__)}")
    return _soilbin.names(Shelf.__members__[shelf])


def estimate(scenario: Scenario, at: Optional[OperatingCondition] = None, *, rigid: bool = False,
             no_lugs: bool = False, **condition: Any) -> TractionResult:
    """The analytic model's answer at one condition: estimate(wheel, load=80, slip=0.2).

    Keywords set or change attributes of the condition, in SI: load [N] > 0, slip [-] in -1 .. 1 (0.2 is 20 %), speed
    [m/s], longitudinal_incline, transverse_incline and yaw [rad], pass [-]. The result holds drawbar_pull [N], torque
    [N m], sinkage [m] and lateral_force [N], each with value and std_error, tractive_efficiency [-], and the arrays of
    `patch`, of shape (nodes,). Raises InputError for what is refused, NoSolution where the wheel would bury itself.
    Warns (SoilbinWarning) as the command does.

    A tire that declares an inflation pressure, or a condition that does, is flexible where it flattens: the answer is
    that of the effect tire_flexibility, where no effect names it, as the command's. rigid: of the rigid wheel, whatever
    pressure the tire declares. A tire with lugs has their thrust (effect lug_thrust, passive_blade), as the command's;
    no_lugs: of the smooth wheel. BekkerWong().evaluate keeps to the scenario's effects.
    """
    asked = one_condition(at, condition)
    scenario, notes = _soilbin.as_asked(checked(scenario), [asked], rigid, no_lugs)
    result = BekkerWong().evaluate(scenario, asked)
    warned(scenario, [_soilbin.answer_of(result)], notes=notes)
    return result


@worded
def sweep(scenario: Scenario, at: Iterable[OperatingCondition], model: Optional[Model] = None,
          progress: Progress = "shown", *, rigid: bool = False,
          no_lugs: bool = False) -> pd.DataFrame:
    """A model's answers, a row a condition (the analytic model where none is given).

    Columns: the condition, the four channels with NAME_std_error, tractive_efficiency, the three angles of the contact,
    budget_NAME for each part of the pull, error ('' where there is a result). SI and radians. A condition without
    solution is a row of NaN with its error. Of the analytic model's answers it warns (SoilbinWarning) as the command
    does; the sentences are kept in the frame's attrs["warnings"]. A tire with an inflation pressure is flexible or
    `rigid` as in estimate where no model is given; a given one keeps to the scenario's effects.
    """
    asked = list(at)
    if model is not None:
        return swept(scenario, asked, model, progress)
    scenario, notes = _soilbin.as_asked(checked(scenario), asked, rigid, no_lugs)
    return swept(scenario, asked, model, progress, notes)


def swept(scenario: Scenario, at: Iterable[OperatingCondition], model: Optional[Model],
          progress: Progress, notes: Sequence[str] = ()) -> pd.DataFrame:
    """What sweep gives, of the scenario's own effects; its warnings are said of the line that called the caller,
    which is worded."""
    answers = _soilbin.answers(model or BekkerWong(patch=False), checked(scenario), list(at), told_to(progress))
    frame = answers_frame(answers)
    if model is None or isinstance(model, BekkerWong):
        frame.attrs["warnings"] = warned(scenario, answers, stacklevel=5, notes=notes)
    return frame


@worded
def run_study(case: Union[Case, str], progress: Progress = "shown", *, rigid: bool = False,
          no_lugs: bool = False) -> pd.DataFrame:
    """The answers of a study's quick models (bekker_wong, rft, cone_index) as sweep gives them, with a first column `model`.

    case: a Case, the name of a study in the library, or the path of a YAML file. Grains take minutes a condition: ask
    soilbin.dem.SoilBin for them. A tire with an inflation pressure is flexible or `rigid` as in estimate.
    """
    question, notes = _soilbin.study_as_asked(
        _soilbin.find_case(case) if isinstance(case, str) else case, rigid, no_lugs)
    tell(notes, stacklevel=4)
    frames: list[pd.DataFrame] = []
    said: list[str] = list(notes)
    for choice in question.study.models:
        if choice.model == ModelKind.bekker_wong:
            scenario = question.scenario.with_effects(choice.effects)
            frame = swept(scenario, question.study.conditions, None, progress)
            said += [one for one in frame.attrs.pop("warnings") if one not in said]
        elif choice.model in (ModelKind.rft, ModelKind.cone_index):
            model = ResistiveForce() if choice.model == ModelKind.rft else ConeIndex()
            frame = swept(question.scenario, question.study.conditions, model, progress)
        else:
            continue
        frame.insert(0, "model", choice.label)
        frames.append(frame)
    whole = pd.concat(frames, ignore_index=True) if frames else pd.DataFrame()
    whole.attrs["warnings"] = said
    return whole


def condition_columns(at: OperatingCondition) -> dict[str, Any]:
    """The condition's numbers by name."""
    return {name: getattr(at, name) for name in CONDITION}


def result_columns(result: Optional[TractionResult]) -> dict[str, Any]:
    """The result's numbers by name; NaN where there is none."""
    row: dict[str, Any] = {}
    for name in CHANNELS:
        estimated = getattr(result, name) if result is not None else None
        row[name] = estimated.value if estimated is not None else np.nan
        row[name + "_std_error"] = estimated.std_error if estimated is not None else np.nan
    for name in ("tractive_efficiency", "entry_angle", "max_stress_angle", "exit_angle"):
        row[name] = getattr(result, name) if result is not None else np.nan
    if result is not None:
        row.update({"budget_" + part: force for part, force in result.budget.items()})
    return row


def answers_frame(answers: Sequence[Answer]) -> pd.DataFrame:
    """Answers as sweep gives them. Columns of the condition that say nothing in any row are left out."""
    rows = [{**condition_columns(a.at), **result_columns(a.result), "error": a.error} for a in answers]
    return without_empty(pd.DataFrame(rows))


def without_empty(frame: pd.DataFrame) -> pd.DataFrame:
    """The frame without its columns of conditions that no row has a value for."""
    unused = [name for name in ("inflation_pressure", "moisture", "position", "run") if name in frame and frame[name].isna().all()]
    return frame.drop(columns=unused)
