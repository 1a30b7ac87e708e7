"""What does this tire do on this soil?

The floors of soilbin under the names that they have in C++ and in files, SI and radians throughout:

    import soilbin
    wheel = soilbin.Scenario("rover-wheel", "dry-sand")
    soilbin.estimate(wheel, load=64.68, slip=0.2).drawbar_pull
    soilbin.sweep(wheel, soilbin.conditions(load=64.68, slip=[0.1, 0.2, 0.3]))     # a data frame

soilbin.bekker_wong opens the analytic wheel, soilbin.dem runs grains, soilbin.compare holds both against measurements.
Long work lets Ctrl-C through and shows its progress; progress=None keeps it silent.
"""
try:
    import numpy
    import pandas
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(f"soilbin needs numpy and pandas: apt install python3-pandas, or pip install pandas "
                              f"({error})") from error
del numpy, pandas

from soilbin import arguments  # noqa: F401  first: it words what the extension refuses
from soilbin import bekker_wong, compare, dem
from soilbin._soilbin import (
    Bin,
    Case,
    ConeIndex,
    Construction,
    ContactPair,
    Controller,
    Differential,
    Drive,
    DriveLine,
    EffectChoice,
    EffectForm,
    Estimate,
    ForceFrame,
    GearedMotor,
    GrainCohesion,
    GrainFraction,
    GranularSoil,
    InputError,
    Lugs,
    LugPattern,
    Model,
    ModelKind,
    NoSolution,
    OperatingCondition,
    ResistiveForce,
    ResistiveForceSoil,
    RollingResistance,
    RunStopped,
    Scenario,
    SemiEmpiricalSoil,
    Shelf,
    SlipBy,
    Soil,
    Tire,
    TorquePoint,
    TractionResult,
    Vehicle,
    VehicleAxle,
    VehicleCondition,
    VehicleDrive,
    VehicleHitch,
    VehiclePoint,
    VehicleStop,
    Waypoint,
    __version__,
    at_density,
    cases_folders,
    doubts,
    effect_catalogue,
    find_case,
    find_soil,
    find_tire,
    find_vehicle,
    in_words,
    parse_case,
    parse_vehicle,
    write_soil,
    write_tire,
)
from soilbin.exports import export_fmi, export_gazebo, export_scm, export_table
from soilbin.other_codes import soil_from_liggghts
from soilbin.questions import SoilbinWarning, conditions, estimate, names, run_study, sweep
from soilbin.vehicles import drive_vehicle, turn_vehicle, vehicle_beside_measured, vehicle_on_soil, wheels_frame

__all__ = [
    "Bin", "Case", "ConeIndex", "Construction", "ContactPair", "Controller", "Differential", "Drive", "DriveLine", "EffectChoice", "EffectForm", "Estimate", "ForceFrame",
    "GearedMotor", "GrainCohesion", "GrainFraction", "GranularSoil", "InputError", "LugPattern", "Lugs", "Model", "ModelKind", "NoSolution", "OperatingCondition",
    "ResistiveForce", "ResistiveForceSoil", "RollingResistance", "RunStopped", "Scenario", "SemiEmpiricalSoil", "Shelf", "SlipBy", "Soil", "SoilbinWarning",
    "Tire", "TorquePoint", "TractionResult", "Vehicle", "VehicleAxle", "VehicleCondition", "VehicleDrive", "VehicleHitch",
    "VehiclePoint", "VehicleStop", "Waypoint", "__version__", "at_density",
    "bekker_wong", "cases_folders", "compare", "conditions", "dem",
    "doubts", "drive_vehicle", "effect_catalogue", "estimate", "export_fmi", "export_gazebo", "export_scm", "export_table", "find_case",
    "find_soil", "find_tire", "find_vehicle", "in_words", "names", "parse_case", "parse_vehicle", "run_study", "soil_from_liggghts", "sweep",
    "turn_vehicle", "vehicle_beside_measured", "vehicle_on_soil", "wheels_frame", "write_soil", "write_tire",
]
