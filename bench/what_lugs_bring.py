"""What do lugs bring a heavy tire? Grains with lugs less grains without, on one bed, beside the quick models.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/what_lugs_bring.py [LUGGED.json SMOOTH.json]

Reads the records of heavy-lugged-incline and heavy-smooth-incline (cases/studies/recorded) and prints Markdown tables, a
row a condition that both have on the same bed sample. Both tires run on the same grains at the same slip of the tread
base, so that what beds differ by cancels; ± is one standard error of both runs' fluctuations.
"""
import argparse
import warnings
from pathlib import Path

import numpy as np

import soilbin
from soilbin import compare
from soilbin.bekker_wong import BekkerWong

FORMS = ("passive_blade", "shear_radius_own_slip", "side_factors", "free_blade", "level_blade")
RECORDED = Path(__file__).parent.parent / "cases/studies/recorded"
KEY = ["packing", "longitudinal_incline", "transverse_incline", "yaw", "slip"]


def pairs(lugged, smooth):
    """The runs of both records with an answer, side by side."""
    frames = [compare.record_frame(file).query("error == ''") for file in (lugged, smooth)]
    return frames[0].merge(frames[1], on=KEY, suffixes=("", "_smooth")).sort_values(KEY)


def gains(scenario, at, smooth):
    """What a quick model says that lugs bring, by model: [% of the load, % of the smooth tire's torque] a condition."""
    bare = soilbin.Scenario(smooth, scenario.soil)
    analytic, rft = BekkerWong(patch=False), soilbin.ResistiveForce()

    def gain(lugged, model):
        with_lugs, without = (soilbin.sweep(of, at, model, progress=None) for of in (lugged, bare))
        return zip(100 * (with_lugs.drawbar_pull - without.drawbar_pull) / at[0].load,
                   100 * (with_lugs.torque / without.torque - 1))

    def thrust(form):
        return soilbin.Scenario(scenario.tire, scenario.soil, effects=[f"lug_thrust:{form}"])

    said = {f"`{form}`": list(gain(thrust(form), analytic)) for form in FORMS}
    return said | {"`rft`": list(gain(scenario, rft))}


def efficiency(value):
    """[%]; none where the wheel can't pull."""
    return "none" if np.isnan(value) else f"{100 * value:.0f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("records", nargs="*", default=[RECORDED / "heavy-lugged-incline.json",
                                                       RECORDED / "heavy-smooth-incline.json"])
    records = parser.parse_args().records
    warnings.simplefilter("ignore", soilbin.SoilbinWarning)
    both = pairs(*records)
    print("| uphill | slip | pull, % of the load | torque, % | sinkage [mm] | tractive efficiency, % |")
    print("|---" * 6 + "|")
    for _, row in both.iterrows():
        def change(channel, scale):
            error = np.hypot(row[f"{channel}_std_error"], row[f"{channel}_std_error_smooth"])
            return f"{scale * (row[channel] - row[f'{channel}_smooth']):+.1f} ± {scale * error:.1f}"

        print(f"| {np.degrees(row.longitudinal_incline):.0f}° | {100 * row.slip:.0f} % "
              f"| {100 * row.drawbar_pull_smooth / row.load:.1f} {change('drawbar_pull', 100 / row.load)} "
              f"| {change('torque', 100 / row.torque_smooth)} | {1e3 * row.sinkage_smooth:.1f} {change('sinkage', 1e3)} "
              f"| {efficiency(row.tractive_efficiency_smooth)} -> {efficiency(row.tractive_efficiency)} |")
    case, bare = (soilbin.find_case(name).scenario for name in ("heavy-lugged-incline", "heavy-smooth-incline"))
    at = [soilbin.OperatingCondition(load=row.load, slip=row.slip, speed=row.speed,
                                     longitudinal_incline=row.longitudinal_incline) for _, row in both.iterrows()]
    said = gains(case, at, bare.tire)
    print("\n| uphill | slip | grains | " + " | ".join(said) + " |\n" + "|---" * (3 + len(said)) + "|")
    for k, (_, row) in enumerate(both.iterrows()):
        error = 100 * np.hypot(row.drawbar_pull_std_error, row.drawbar_pull_std_error_smooth) / row.load
        print(f"| {np.degrees(row.longitudinal_incline):.0f}° | {100 * row.slip:.0f} % "
              f"| {100 * (row.drawbar_pull - row.drawbar_pull_smooth) / row.load:+.1f} ± {error:.1f}, "
              f"{100 * (row.torque / row.torque_smooth - 1):+.0f} % | "
              + " | ".join("{:+.1f}, {:+.0f} %".format(*gain[k]) for gain in said.values()) + " |")


if __name__ == "__main__":
    main()
