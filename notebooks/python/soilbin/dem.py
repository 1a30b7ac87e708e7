"""Grains: a handful of them, element tests, the virtual soil bin."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Optional, Union

import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import (
    AngleOfReposeResult,
    AnnulusRun,
    Case,
    CohesionLaw,
    DirectShearResult,
    GranularSoil,
    Interaction,
    Material,
    NormalLaw,
    OperatingCondition,
    PatchReport,
    PlateRun,
    Record,
    RollingLaw,
    Scenario,
    Simulation,
    SoilBin,
    StrengthLine,
    TiltingBoardResult,
    TriaxialResult,
    WheelRun,
    find_case,
)
from soilbin.arguments import worded
from soilbin.progress import Progress, told_to

__all__ = [
    "AngleOfReposeResult", "AnnulusRun", "CohesionLaw", "DirectShearResult", "GranularSoil", "Interaction", "Material",
    "NormalLaw", "PatchReport", "PlateRun", "RollingLaw", "Simulation", "SoilBin", "StrengthLine", "TiltingBoardResult",
    "TriaxialResult", "WheelRun", "angle_of_repose", "annular_shear", "direct_shear", "plate_sinkage", "record_runs",
    "run_wheel", "samples_frame", "tilting_board", "triaxial",
]


def direct_shear(soil: GranularSoil, stresses: Sequence[float] = (10e3, 20e3, 40e3), *, packings: int = 1,
                 packing: int = 1, length: float = 40, width: float = 12, height: float = 10,
                 travel: float = 5,
                 settling_friction: float = 1, rolling: RollingLaw = RollingLaw.elastic_plastic, inertial: float = 1e-3,
                 threads: int = 0, progress: Progress = "shown") -> DirectShearResult:
    """The shear box (docs/guide/element-tests.md).

    stresses: normal stresses on the plane of shear [Pa], at least two for c and phi. packings: specimens, of seeds
    packing, packing + 1, ... length, width, height, travel: in mean diameters of the grains; a box shorter than the
    default one overstates strength. settling_friction: 0 (densest) .. 1
    (loose). inertial: inertial number of the shear, which sets its speed. threads: 0, one a core or fewer; changes no
    bit. Raises InputError for settings that make no sense, RunStopped.
    """
    return _soilbin.direct_shear(soil, list(stresses), packings, packing, length, width, height, travel,
                                 settling_friction, rolling, inertial, threads, told_to(progress))


def triaxial(soil: GranularSoil, stresses: Sequence[float] = (10e3, 20e3, 40e3), *, packings: int = 1,
             packing: int = 1, side: float = 9, height: float = 14, strain: float = 0.25,
             settling_friction: float = 1, rolling: RollingLaw = RollingLaw.elastic_plastic, inertial: float = 1e-3,
             threads: int = 0, progress: Progress = "shown") -> TriaxialResult:
    """True triaxial compression between six smooth walls (docs/guide/element-tests.md).

    stresses: confining stresses [Pa], at least two for c and phi. side, height: of the specimen, in mean diameters of
    the grains. strain: axial, logarithmic, at the end. The rest as in direct_shear. Raises InputError, RunStopped.
    """
    return _soilbin.triaxial(soil, list(stresses), packings, packing, side, height, strain, settling_friction, rolling,
                             inertial, threads, told_to(progress))


def tilting_board(soil: GranularSoil, *, packing: int = 1, across: int = 16, layers: float = 1, dt: float = 0,
                  rolling: RollingLaw = RollingLaw.elastic_plastic, threads: int = 0,
                  progress: Progress = "shown") -> TiltingBoardResult:
    """The paper's friction test: sand on a board of the tire's material, tilted until it slides.

    across: grains along each side of the board. layers: height of the sand, in mean diameters. dt: time step [s]; 0, the
    longest that is safe, at which directional rolling resistance lets grains creep. Raises InputError, RunStopped.
    """
    return _soilbin.tilting_board(soil, packing, across, layers, dt, rolling, threads, told_to(progress))


def plate_sinkage(soil: GranularSoil, diameters: Sequence[float] = (5, 7, 9), *, sinkage: float = 2, width: float = 3,
                  depth: float = 1.2, packing: int = 1, settling_friction: float = 1,
                  rolling: RollingLaw = RollingLaw.elastic_plastic, threads: int = 0,
                  progress: Progress = "shown") -> list[PlateRun]:
    """Round plates pressed into a bed of the grains, each into a fresh copy (docs/guide/element-tests.md).

    diameters of the plates and the sinkage that they reach: in mean diameters of the grains. width, depth: of the square
    bed, in diameters of the widest plate. Raises InputError for a plate under five grains wide, RunStopped.
    """
    return _soilbin.plate_sinkage(soil, list(diameters), sinkage, width, depth, packing, settling_friction, rolling,
                                  threads, told_to(progress))


def annular_shear(soil: GranularSoil, stresses: Sequence[float] = (5e3, 10e3, 20e3), *, inner: float = 4,
                  outer: float = 9, travel: float = 5, width: float = 1.6, depth: float = 0.55, packing: int = 1,
                  settling_friction: float = 1, rolling: RollingLaw = RollingLaw.elastic_plastic, threads: int = 0,
                  progress: Progress = "shown") -> list[AnnulusRun]:
    """A ring with grousers turned on a bed of the grains, under each normal stress [Pa] (docs/guide/element-tests.md).

    inner, outer: radii of the ring; travel: at its mean radius; in mean diameters of the grains. width, depth: of the
    square bed, in diameters of the ring. Raises InputError for a ring under five grains wide, RunStopped.
    """
    return _soilbin.annular_shear(soil, list(stresses), inner, outer, travel, width, depth, packing, settling_friction,
                                  rolling, threads, told_to(progress))


def angle_of_repose(soil: GranularSoil, *, packing: int = 1, radius: float = 6, height: float = 12,
                    rolling: RollingLaw = RollingLaw.elastic_plastic, threads: int = 0,
                    progress: Progress = "shown") -> AngleOfReposeResult:
    """A cylinder of grains on a floor is lifted; the slope of the heap, with its error by eight sectors.

    radius, height: of the cylinder, in mean diameters. Raises InputError, RunStopped where no rest is found.
    """
    return _soilbin.angle_of_repose(soil, packing, radius, height, rolling, threads, told_to(progress))


@worded
def run_wheel(bin: SoilBin, scenario: Scenario, at: OperatingCondition, progress: Progress = "shown") -> WheelRun:
    """One run of the virtual soil bin (docs/guide/soil-bin.md); the bed is settled once and kept by `bin`.

    Raises InputError for a bed too small and for what grains can't do (effects), NoSolution where the
    wheel digs itself in, RunStopped.
    """
    return bin.run(scenario, at, told_to(progress))


@worded
def record_runs(case: Union[Case, str], file: Union[str, Path], bin: Optional[SoilBin] = None, *, packings: int = 1,
                half_step: bool = False, progress: Progress = "shown") -> Record:
    """Runs the conditions of a case's study in the virtual soil bin and keeps them in a file (docs/guide/recorded.md).

    Each run is added as it is finished, and what the file has isn't run again: stopped work goes on by the same call, in
    the middle of a run too where `bin` has a folder for beds. bin: bed, rig, threads; absent: the usual ones. packings:
    runs of each condition, on beds of the seeds from the bin's on. half_step: first the hardest condition also at half
    the time step, which shows whether answers depend on it. What grains can't answer is a run with its error.
    `soilbin run --recorded` and compare.record_frame answer from the file. Raises InputError for a file of other inputs
    and RuntimeError where the half step's answer differs.
    """
    question = find_case(case) if isinstance(case, str) else case
    return (bin or SoilBin()).record(question, Path(file), packings, told_to(progress), half_step)


@worded
def samples_frame(run: WheelRun) -> pd.DataFrame:
    """A run's samples, a row a sampling time [s]; arrays of shape (samples, 3) as columns NAME_x, NAME_y, NAME_z. SI."""
    columns = {}
    for name, values in run.samples.items():
        if values.ndim == 1:
            columns[name] = values
        else:
            columns.update({f"{name}_{axis}": values[:, i] for i, axis in enumerate("xyz")})
    return pd.DataFrame(columns)
