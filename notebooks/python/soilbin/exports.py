"""Answers and soils for other programs: tables of forces, Chrono's SCM, Gazebo, FMI (docs/guide/export.md)."""
from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Optional, Union

from soilbin import _soilbin
from soilbin._soilbin import InputError, ModelKind, OperatingCondition, Scenario, Soil, find_soil
from soilbin.arguments import worded
from soilbin.progress import Progress, told_to
from soilbin.questions import checked, one_condition, tell

File = Union[str, Path, None]


def kind_of(model: str) -> ModelKind:
    """The model of this name; InputError for another word."""
    quick = ("bekker_wong", "rft", "cone_index")
    if model not in quick:
        raise InputError(f"no model {model!r} here: there are {', '.join(quick)}")
    kind: ModelKind = getattr(ModelKind, model)
    return kind


def path_of(file: File) -> Optional[Path]:
    return None if file is None else Path(file)


def document(answer: tuple[str, list[str]], notes: Sequence[str] = ()) -> dict[str, Any]:
    """What the command's --json says; its warnings are said of the line that called the caller, which is worded."""
    text, warnings = answer
    tell([*notes, *warnings], stacklevel=5)
    told: dict[str, Any] = json.loads(text)
    return told


@worded
def export_table(scenario: Scenario, at: Iterable[OperatingCondition], *, model: str = "bekker_wong",
                 header: File = None, csv: File = None, hdf5: File = None, rigid: bool = False, no_lugs: bool = False,
                 progress: Progress = "shown") -> dict[str, Any]:
    """Forces on a grid of conditions for programs that look them up, with a measured error of the interpolation.

    at: every combination of the values, as conditions(load=..., slip=...) makes them. model: "bekker_wong", "rft" or
    "cone_index". header: a file of C99 with the table and its look-up; csv; hdf5: files to write, folders are made. Gives
    the document soilbin-force-table/1, as `soilbin export table --json` does: axes with nodes, channels with values and
    std_errors (the last axis fastest), largest_error and rms_error in the middles of the cells; SI and radians. rigid,
    no_lugs: as in estimate. Raises InputError where the conditions are no full grid or vary in what no table holds,
    NoSolution where no node has an answer, RuntimeError for a file that can't be written. Warns (SoilbinWarning) as the command.

        table = soilbin.export_table(wheel, soilbin.conditions(load=[50, 65, 80], slip=[0, 0.2, 0.4]), header="rover.h")
        np.reshape(table["channels"][0]["values"], [len(axis["nodes"]) for axis in table["axes"]])   # load x slip
    """
    asked = list(at)
    scenario, notes = _soilbin.as_asked(checked(scenario), asked, rigid, no_lugs)
    return document(_soilbin.export_table(scenario, asked, kind_of(model), path_of(header), path_of(csv), path_of(hdf5),
                                          told_to(progress)), notes)


@worded
def export_scm(soil: Union[Soil, str], output: File = None) -> dict[str, Any]:
    """A soil as the file that Chrono's SCM terrain reads: units as there (Pa, m, degrees), not SI alone.

    output: the file to write. Its section `soilbin` keeps standard deviations and sources; find_soil of the file's path
    reads it back. Raises InputError for a soil without semi-empirical values, RuntimeError for a file that can't be written.
    """
    known = find_soil(soil) if isinstance(soil, str) else soil
    return document(_soilbin.export_scm(known, path_of(output)))


@worded
def export_gazebo(scenario: Scenario, at: Optional[OperatingCondition] = None, *, map: File = None,
                  soils: Sequence[Union[Soil, str]] = (), size: float = 10.0, rigid: bool = False,
                  no_lugs: bool = False, **condition: Any) -> dict[str, Any]:
    """Slip compliance and friction of a wheel for Gazebo's plugin WheelSlip: export_gazebo(wheel, load=65, slip=0.2).

    One condition on level ground without yaw; its slip is that of the lateral line. map: a picture (PNG) for
    LookupWheelSlip, with the scenario's soil and `soils` in stripes along x, size: the side of its square on the ground
    [m]. Gives the document soilbin-wheel-slip/1: compliances [-], frictions and errors [normal loads], `sdf`, and of the
    map each soil's colour and what the plugin has there. Raises InputError for another question, NoSolution for a wheel
    that pulls at no slip, on any of the soils, RuntimeError for a file that can't be written.
    """
    asked = one_condition(at, condition)
    scenario, notes = _soilbin.as_asked(checked(scenario), [asked], rigid, no_lugs)
    others = [find_soil(soil) if isinstance(soil, str) else soil for soil in soils]
    return document(_soilbin.export_gazebo(scenario, asked, path_of(map), others, size), notes)


@worded
def export_fmi(scenario: Scenario, at: Iterable[OperatingCondition], output: Union[str, Path], *,
               model: str = "bekker_wong", rigid: bool = False, no_lugs: bool = False,
               progress: Progress = "shown") -> dict[str, Any]:
    """A driven wheel as a co-simulation unit of FMI 2.0: equations of motion over a table of forces.

    at: every combination of the values; slips begin at 0 or below, and each other condition with several values becomes
    an input. output: the file NAME.fmu, compiled where the machine has `cc`, else its source alone (`compiled`,
    `why_not_compiled`). model: "bekker_wong" or "rft". Gives the document soilbin-fmu/1 with the variables, SI and
    radians, and the table. Raises InputError and NoSolution as export_table, and for a table without slips from rest on.

        soilbin.export_fmi(wheel, soilbin.conditions(load=[50, 65, 80], slip=np.linspace(0, 0.8, 17)), "rover.fmu")
    """
    asked = list(at)
    scenario, notes = _soilbin.as_asked(checked(scenario), asked, rigid, no_lugs)
    return document(_soilbin.export_fmi(scenario, asked, kind_of(model), Path(output), told_to(progress)), notes)
