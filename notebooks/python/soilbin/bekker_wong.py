"""The analytic wheel opened up: its contact, its limits, closed forms, plates, and the wheel driven in time."""
from __future__ import annotations

from typing import Any, Optional

import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    BekkerWong,
    Drive,
    DriveEnd,
    DriveRecord,
    Estimate,
    Explanation,
    OperatingCondition,
    PlateCurve,
    PlateExponent,
    PlateFit,
    PlateTest,
    Presumed,
    PullPeak,
    RolledWheel,
    RollingWheel,
    Scenario,
    bekker_static_sinkage,
    critical_ground_pressure,
    fit_plates,
    fit_plates_at,
    mean_curve,
    presumed,
    rolling_resistance,
)
from soilbin.arguments import worded
from soilbin.progress import Progress, told_to
from soilbin.questions import checked, one_condition, tell

__all__ = [
    "BekkerWong", "Drive", "DriveEnd", "DriveRecord", "EstimatedFloat", "Explanation", "PlateCurve", "PlateExponent",
    "PlateFit", "PlateTest", "Presumed", "RolledWheel", "RollingWheel", "bekker_static_sinkage",
    "critical_ground_pressure", "drive_frame", "drive_wheel", "explain", "fit_plates", "fit_plates_at", "largest_pull",
    "mean_curve", "presumed", "rolling_resistance", "slip_for_pull", "steepest_slope",
]


PULL_HINT = "the pull is drawbar=...; "


class EstimatedFloat(float):
    """A number that knows its standard error, in the same unit: it counts and compares as a float."""

    std_error: float

    @property
    def value(self) -> float:
        """The number alone."""
        return float(self)

    def __new__(cls, value: float, std_error: float) -> EstimatedFloat:
        made = super().__new__(cls, value)
        made.std_error = std_error
        return made

    def __reduce__(self) -> tuple[type[EstimatedFloat], tuple[float, float]]:
        return EstimatedFloat, (self.value, self.std_error)

    def __repr__(self) -> str:
        return str(_soilbin.Estimate(self.value, self.std_error if self.std_error >= 0 else 0.0))

    __str__ = __repr__


def as_asked(scenario: Scenario, at: OperatingCondition, rigid: bool, no_lugs: bool) -> Scenario:
    """The scenario as the commands ask it: with what its tire declares, pressure and lugs; warns of that."""
    asked, notes = _soilbin.as_asked(checked(scenario), [at], rigid, no_lugs)
    tell(notes, stacklevel=4)
    return asked


def explain(scenario: Scenario, at: Optional[OperatingCondition] = None, *, rigid: bool = False, no_lugs: bool = False,
            **condition: Any) -> Explanation:
    """The model's equations with their values: explain(wheel, load=80, slip=0.2). Keywords, `rigid`, `no_lugs` and errors as of
    estimate; each step's value is in its own `unit`.
    """
    checked(scenario)
    asked = one_condition(at, condition)
    return _soilbin.explain(as_asked(scenario, asked, rigid, no_lugs), asked)


def at_any_slip(at: Optional[OperatingCondition], condition: dict[str, Any], hint: str = "") -> OperatingCondition:
    """As one_condition, for questions that do not read the slip: it may be left out."""
    return one_condition(at, condition if at is not None else {"slip": 0.0, **condition}, hint)


def estimated(found: Optional[Estimate]) -> Optional[EstimatedFloat]:
    """An Estimate as a float with its standard error."""
    return None if found is None else EstimatedFloat(found.value, found.std_error)


def largest_pull(scenario: Scenario, at: Optional[OperatingCondition] = None, *, rigid: bool = False, no_lugs: bool = False,
                 **condition: Any) -> PullPeak:
    """Largest drawbar pull [N] over 0 <= slip <= 1, with its standard error, and its slip [-]:
    largest_pull(wheel, load=80). The slip of `at` is not read. Keywords and `rigid` as of estimate. Raises NoSolution
    where no slip has a balance.
    """
    checked(scenario)
    asked = at_any_slip(at, condition)
    return _soilbin.largest_pull(as_asked(scenario, asked, rigid, no_lugs), asked)


def slip_for_pull(scenario: Scenario, at: Optional[OperatingCondition] = None, drawbar: float = 0.0, *,
                  rigid: bool = False, no_lugs: bool = False, **condition: Any) -> Optional[EstimatedFloat]:
    """Smallest slip [-] above -0.5 at which the wheel pulls `drawbar` [N] on the slope of `at`; None where it can't.

    A float with its standard error (`std_error`, to first order from the soil's standard deviations): NaN where one
    standard error of the soil makes the pull one that the wheel does not reach. `rigid` as in estimate.
    """
    checked(scenario)
    asked = at_any_slip(at, condition, PULL_HINT)
    return estimated(_soilbin.slip_for_pull(as_asked(scenario, asked, rigid, no_lugs), asked, drawbar))


def steepest_slope(scenario: Scenario, at: Optional[OperatingCondition] = None, drawbar: float = 0.0, *,
                   rigid: bool = False, no_lugs: bool = False, **condition: Any) -> Optional[EstimatedFloat]:
    """Steepest slope [rad] that the wheel climbs while it pulls `drawbar` [N]; None beyond -60 .. 80 deg.

    A float with its standard error (`std_error`, to first order from the soil's standard deviations). `rigid` as in
    estimate.
    """
    checked(scenario)
    asked = at_any_slip(at, condition, PULL_HINT)
    return estimated(_soilbin.steepest_slope(as_asked(scenario, asked, rigid, no_lugs), asked, drawbar))


@worded
def drive_wheel(scenario: Scenario, drive: Optional[Drive], samples: int = 400,
                progress: Progress = "shown") -> DriveRecord:
    """Drives a wheel in time from rest (docs/guide/drive.md); effects are those of the drive.

    samples: intervals of time over the drive's whole duration. Raises InputError for an effect that a drive can't take
    and for a case that has no drive, NoSolution where the soil can't hold the wheel at its start.
    """
    checked(scenario)
    if drive is None:
        raise _soilbin.InputError("the case has no section 'drive'")
    return _soilbin.drive_wheel(scenario, drive, samples, told_to(progress))


@worded
def drive_frame(record: DriveRecord) -> pd.DataFrame:
    """A drive's samples, a row a time [s]; SI and radians, works in J since the start."""
    return pd.DataFrame(record.samples)
