"""The analytic wheel opened up: its contact, its limits, closed forms, plates, and the wheel driven in time."""
from __future__ import annotations

from typing import Optional

import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    BekkerWong,
    Drive,
    DriveEnd,
    DriveRecord,
    Explanation,
    PlateCurve,
    PlateExponent,
    PlateFit,
    PlateTest,
    Presumed,
    RolledWheel,
    RollingWheel,
    Scenario,
    bekker_static_sinkage,
    critical_ground_pressure,
    explain,
    fit_plates,
    fit_plates_at,
    largest_pull,
    mean_curve,
    presumed,
    rolling_resistance,
    slip_for_pull,
    steepest_slope,
)
from soilbin.progress import Progress, told_to

__all__ = [
    "BekkerWong", "Drive", "DriveEnd", "DriveRecord", "Explanation", "PlateCurve", "PlateExponent", "PlateFit",
    "PlateTest", "Presumed", "RolledWheel", "RollingWheel", "bekker_static_sinkage", "critical_ground_pressure",
    "drive_frame", "drive_wheel", "explain", "fit_plates", "fit_plates_at", "largest_pull", "mean_curve", "presumed",
    "rolling_resistance", "slip_for_pull", "steepest_slope",
]


def drive_wheel(scenario: Scenario, drive: Optional[Drive], samples: int = 400,
                progress: Progress = "shown") -> DriveRecord:
    """Drives a wheel in time from rest (docs/guide/drive.md); effects are those of the drive.

    samples: intervals of time over the drive's whole duration. Raises InputError for an effect that a drive can't take
    and for a case that has no drive, NoSolution where the soil can't hold the wheel at its start.
    """
    if drive is None:
        raise _soilbin.InputError("the case has no section 'drive'")
    return _soilbin.drive_wheel(scenario, drive, samples, told_to(progress))


def drive_frame(record: DriveRecord) -> pd.DataFrame:
    """A drive's samples, a row a time; SI and radians, works in J since the start."""
    return pd.DataFrame(record.samples)
