"""Grains: a handful of them, element tests, the virtual soil bin."""
from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    AngleOfReposeResult,
    CohesionLaw,
    DirectShearResult,
    GranularSoil,
    Interaction,
    Material,
    NormalLaw,
    OperatingCondition,
    RollingLaw,
    Scenario,
    Simulation,
    SoilBin,
    StrengthLine,
    WheelRun,
)
from soilbin.progress import Progress, told_to

__all__ = [
    "AngleOfReposeResult", "CohesionLaw", "DirectShearResult", "GranularSoil", "Interaction", "Material", "NormalLaw",
    "RollingLaw", "Simulation", "SoilBin", "StrengthLine", "WheelRun", "angle_of_repose", "direct_shear", "run_wheel",
    "samples_frame",
]


def direct_shear(soil: GranularSoil, stresses: Sequence[float] = (10e3, 20e3, 40e3), *, packings: int = 1,
                 packing: int = 1, length: float = 20, width: float = 6, height: float = 10, travel: float = 3,
                 settling_friction: float = 1, rolling: RollingLaw = RollingLaw.directional, inertial: float = 1e-3,
                 threads: int = 0, progress: Progress = "shown") -> DirectShearResult:
    """The shear box (docs/element-tests.md).

    stresses: normal stresses on the lid [Pa], at least two for c and phi. packings: specimens, of seeds packing,
    packing + 1, ... length, width, height, travel: in mean diameters of the grains. settling_friction: 0 (densest) .. 1
    (loose). inertial: inertial number of the shear, which sets its speed. threads: 0, one a core; changes no bit.
    Raises InputError for settings that make no sense, RunStopped.
    """
    return _soilbin.direct_shear(soil, list(stresses), packings, packing, length, width, height, travel,
                                 settling_friction, rolling, inertial, threads, told_to(progress))


def angle_of_repose(soil: GranularSoil, *, packing: int = 1, radius: float = 6, height: float = 12,
                    rolling: RollingLaw = RollingLaw.directional, threads: int = 0,
                    progress: Progress = "shown") -> AngleOfReposeResult:
    """A cylinder of grains on a floor is lifted; the slope of the heap, with its error by eight sectors.

    radius, height: of the cylinder, in mean diameters. Raises InputError, RunStopped where no rest is found.
    """
    return _soilbin.angle_of_repose(soil, packing, radius, height, rolling, threads, told_to(progress))


def run_wheel(bin: SoilBin, scenario: Scenario, at: OperatingCondition, progress: Progress = "shown") -> WheelRun:
    """One run of the virtual soil bin (docs/soil-bin.md); the bed is settled once and kept by `bin`.

    Raises InputError for a bed too small and for what grains can't do (effects, a second pass), NoSolution where the
    wheel digs itself in, RunStopped.
    """
    return bin.run(scenario, at, told_to(progress))


def samples_frame(run: WheelRun) -> pd.DataFrame:
    """A run's samples, a row a sampling time; vectors as NAME_x, NAME_y, NAME_z. SI."""
    columns = {}
    for name, values in run.samples.items():
        if values.ndim == 1:
            columns[name] = values
        else:
            columns.update({f"{name}_{axis}": values[:, i] for i, axis in enumerate("xyz")})
    return pd.DataFrame(columns)
