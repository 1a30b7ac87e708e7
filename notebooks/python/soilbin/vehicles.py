"""A vehicle on soil: does it go, how steep, which wheel gives out (docs/guide/vehicle.md)."""
from __future__ import annotations

import os
from typing import Any

import pandas as pd

from soilbin import _soilbin
from soilbin._soilbin import Vehicle
from soilbin.arguments import worded
from soilbin.exports import document
from soilbin.progress import Progress, told_to


def checked_vehicle(vehicle: Vehicle) -> Vehicle:
    """The vehicle; a TypeError in plain words where it is something else."""
    if not isinstance(vehicle, Vehicle):
        raise TypeError(f"vehicle: expected a Vehicle, such as soilbin.find_vehicle('truck'), not {vehicle!r}")
    return vehicle


@worded
def vehicle_on_soil(vehicle: Vehicle, *, map_samples: int = 0, rigid: bool = False, no_lugs: bool = False,
                    progress: Progress = "shown") -> dict[str, Any]:
    """Steady travel in the vehicle's condition, pull against slip, steepest slopes, each with its standard error.

    map_samples: soils that are drawn for the chance to go over slope and heading (`map`); 0: no map, which takes a
    minute or two. rigid, no_lugs: as in estimate. Gives the document soilbin-vehicle-answer/1, as `soilbin vehicle --json` does;
    SI and radians. Where the vehicle does not travel, `steady` is None and `failure` says why. Raises InputError for
    a soil without semi-empirical values. Warns (SoilbinWarning) as the command.

        truck = soilbin.find_vehicle("truck")
        truck.condition.slope = math.radians(5)
        soilbin.wheels_frame(soilbin.vehicle_on_soil(truck))
    """
    return document(_soilbin.vehicle_on_soil(checked_vehicle(vehicle), map_samples, rigid, no_lugs, told_to(progress)))


@worded
def turn_vehicle(vehicle: Vehicle, *, radius: float | None = None, steer: float | None = None, rigid: bool = False,
                 no_lugs: bool = False) -> dict[str, Any]:
    """The steady turn of a radius [m] or of a steering angle [rad] on level ground, to the left positive; without both
    the tightest one, and what ends it. radius 0: on the spot, by its sides.

    Gives the document soilbin-vehicle-turn/1, as `soilbin vehicle --turn --json` does; SI and radians. Where there is no
    such turn, `turn` is None and `why_not` says why. Raises InputError for a slope and for a vehicle that cannot turn.
    """
    return document(_soilbin.turn_vehicle(checked_vehicle(vehicle), radius, steer, rigid, no_lugs))


@worded
def vehicle_beside_measured(vehicle: Vehicle, file: str | os.PathLike[str], *, rigid: bool = False,
                            no_lugs: bool = False) -> dict[str, Any]:
    """The model beside slopes or pulls that were measured of the whole vehicle at slips of its drive line.

    file: a CSV with the columns slip or slip_percent, and slope_deg, drawbar_pull_N or traction_angle_deg. Gives the
    document soilbin-vehicle-measured/1, as `soilbin vehicle --measured --json` does; SI and radians. Raises InputError
    with the place in the file.
    """
    return document(_soilbin.vehicle_beside_measured(checked_vehicle(vehicle), os.fspath(file), rigid, no_lugs))


@worded
def drive_vehicle(vehicle: Vehicle, samples: int = 400, *, rigid: bool = False, no_lugs: bool = False,
                  progress: Progress = "shown") -> dict[str, Any]:
    """Drives the vehicle in time from rest, straight up or down, as its `drive` says.

    samples: intervals over the drive's whole duration. Gives the document soilbin-vehicle-drive/1, as
    `soilbin vehicle --drive --json` does. Raises InputError for a vehicle that is not alike on both sides, for a cross
    slope and for an effect that a drive can't take.
    """
    return document(_soilbin.drive_vehicle(checked_vehicle(vehicle), samples, rigid, no_lugs, told_to(progress)))


def wheels_frame(answer: dict[str, Any]) -> pd.DataFrame:
    """The wheels of an answer of vehicle_on_soil that travels, a row each; SI. ValueError for another one."""
    if not isinstance(answer, dict):
        raise TypeError(f"answer: expected what vehicle_on_soil gives, not {answer!r}")
    if answer["steady"] is None:
        raise ValueError(f"this vehicle does not travel: {answer['failure']['text']}")
    return pd.json_normalize(answer["steady"]["wheels"])
