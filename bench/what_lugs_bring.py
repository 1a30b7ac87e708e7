"""What do lugs bring a heavy tire? Grains with lugs less grains without, on one bed, beside the quick models.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/what_lugs_bring.py [LUGGED.json SMOOTH.json]

Reads the records of heavy-lugged-incline and heavy-smooth-incline (cases/studies/recorded) and prints Markdown tables,
a row a condition that both have on one bed sample; with half of the lugs beside them (heavy-half-lugged-incline); then,
of the conditions that the pairs with finer grains have too (heavy-lugged-17mm, heavy-lugged-15mm, each beside its
smooth tire), a row a grain size. The tires of a pair run on one bed at one slip of the tread base, so that what beds
differ by cancels. "Infinitely fine" is by the twins with grains 1.4 times as large, D + (D - D_coarser)/0.4. ± is one
standard error of the runs' fluctuations.
"""
import argparse
import json
import warnings
from pathlib import Path

import numpy as np

import soilbin
from soilbin.bekker_wong import BekkerWong

FORMS = ("passive_blade", "shear_radius_own_slip", "side_factors", "free_blade", "level_blade", "tips")
RECORDED = Path(__file__).parent.parent / "cases/studies/recorded"
PAIRS = [[RECORDED / f"heavy-{tire}-{grains}.json" for tire in ("lugged", "smooth")]
         for grains in ("incline", "17mm", "15mm")]
HALF = RECORDED / "heavy-half-lugged-incline.json"
LUG_HEIGHT, RADIUS = 0.045, 0.7006  # [m], the radius to the tread base
CONDITION = ("load", "slip", "speed", "longitudinal_incline", "transverse_incline", "yaw")


def grain_diameter(record):
    """Mean diameter of the grains under the wheel [m]."""
    inputs = json.loads(Path(record).read_text())["inputs"]
    return float(inputs["bed.radius_min"]) + float(inputs["bed.radius_max"])


def answers(record):
    """Runs with an answer by (bed sample, *CONDITION): those of the soil's grains, and of coarser ones."""
    told = json.loads(Path(record).read_text())
    return [{(run["packing"], *(run[name] for name in CONDITION)): run
             for run in told.get(part, []) if "drawbar_pull" in run} for part in ("runs", "coarser")]


def change(lugged, smooth, channel):
    """Lugged less smooth, and its standard error."""
    return (lugged[channel] - smooth[channel],
            np.hypot(*(run["std_error"][channel] for run in (lugged, smooth))))


def infinitely_fine(usual, coarser):
    """A difference extrapolated linearly in the grain size, and its standard error."""
    return usual[0] + (usual[0] - coarser[0]) / 0.4, np.hypot(3.5 * usual[1], 2.5 * coarser[1])


def said(lugged, smooth, at):
    """What a model says that lugs bring at a condition: [% of the load, % of the smooth tire's torque]."""
    with_lugs, without = (model.evaluate(scenario, at) for model, scenario in (lugged, smooth))
    return (100 * (with_lugs.drawbar_pull.value - without.drawbar_pull.value) / at.load,
            100 * (with_lugs.torque.value / without.torque.value - 1))


def efficiency(run):
    """[%]; none where the wheel can't pull."""
    return f"{100 * run['tractive_efficiency']:.0f}" if run["drawbar_pull"] > 0 else "none"


def place(key):
    """The first cells of a row."""
    return f"| {np.degrees(key[4]):.0f}° | {100 * key[2]:.0f} % "


def at_no_size(diameters, values, errors):
    """Where the straight line through the values of several grain sizes meets 0, its standard error, and chi2."""
    weights = 1 / np.asarray(errors)
    design = np.column_stack([np.ones(len(values)), diameters]) * weights[:, None]
    covariance = np.linalg.inv(design.T @ design)
    found = covariance @ design.T @ (values * weights)
    return found[0], np.sqrt(covariance[0, 0]), np.sum((design @ found - values * weights)**2)


def print_by_grain_size(pairs):
    """Prints what lugs bring in each grain size of several pairs of records, where more than one has a condition."""
    having = {}  # of each condition: diameter, lugged and smooth run
    for pair in pairs:
        for coarser, (lugged, smooth) in zip((1.0, 1.4), zip(*map(answers, pair))):
            for key in lugged.keys() & smooth.keys():
                having.setdefault(key, []).append((grain_diameter(pair[0]) * coarser, lugged[key], smooth[key]))
    print("\n| uphill | slip | grains [mm] | to a lug | pull without, % of the load | with | lugs bring | torque, % "
          "| sinkage [mm] |\n" + "|---" * 9 + "|")
    several = [key for key, runs in having.items() if len(runs) > 2]  # one pair has two at most, a run and its twin
    for key in sorted(several, key=lambda key: (key[4], key[2])):
        diameters, pulls = [], []
        for diameter, with_lugs, without in sorted(having[key], key=lambda one: -one[0]):
            diameters.append(diameter)
            pulls.append([100 * np.array(one) / key[1] for one in (
                *((run["drawbar_pull"], run["std_error"]["drawbar_pull"]) for run in (without, with_lugs)),
                change(with_lugs, without, "drawbar_pull"))])
            torque, sinkage = (change(with_lugs, without, name) for name in ("torque", "sinkage"))
            told = " | ".join("{:+.1f} ± {:.1f}".format(*pull) for pull in pulls[-1])
            print(f"{place(key)}| {1e3 * diameter:.1f} | {LUG_HEIGHT / diameter:.1f} | {told} "
                  f"| {100 * torque[0] / without['torque']:+.0f} ± {100 * torque[1] / without['torque']:.0f} "
                  f"| {1e3 * without['sinkage']:.0f} {1e3 * sinkage[0]:+.1f} ± {1e3 * sinkage[1]:.1f} |")
        lines = [at_no_size(diameters, *np.transpose(one)) for one in zip(*pulls)]
        told = " | ".join("{:+.1f} ± {:.1f} (chi2 {:.1f})".format(*line) for line in lines)
        print(f"{place(key)}| 0, by the line | | {told} | | |")


def pull_by_number(key):
    """What half of the lugs and all of them add to the pull by passive_blade and by rft, in % of the load."""
    at = soilbin.OperatingCondition(**dict(zip(CONDITION, key[1:])))
    smooth, *others = (soilbin.find_case(f"heavy-{tire}-incline").scenario
                       for tire in ("smooth", "half-lugged", "lugged"))
    told = []
    for model, effects in ((BekkerWong(patch=False), ["lug_thrust:passive_blade"]), (soilbin.ResistiveForce(), [])):
        bare = (model, soilbin.Scenario(smooth.tire, smooth.soil))
        added = (said((model, soilbin.Scenario(one.tire, one.soil, effects=effects)), bare, at)[0] for one in others)
        told.append(", ".join(f"{pull:+.1f}" for pull in added))
    return " | ".join(told)


def print_by_number(smooth, half, lugged):
    """Prints what the tire gives without lugs, with half of them and with all, from records of one bed."""
    records = [answers(record) for record in (smooth, half, lugged)]
    shared = set.intersection(*(set(usual) for usual, _ in records))
    print("\n| uphill | slip | pull of none, half, all [% of the load] | half bring, infinitely fine grains "
          "| torque [% of load times radius] | sinkage [mm] | half, all add by `passive_blade` | by `rft` |\n"
          + "|---" * 8 + "|")
    for key in sorted(shared, key=lambda key: (key[0], key[4], key[2])):
        runs, coarser = [one[key] for one, _ in records], [one.get(key) for _, one in records]
        fine = ""
        if coarser[0] and coarser[1]:
            bring = infinitely_fine(*(change(pair[1], pair[0], "drawbar_pull") for pair in (runs, coarser)))
            fine = "{:+.1f} ± {:.1f}".format(*(100 * part / key[1] for part in bring))
        cells = []
        for name, per_si in (("drawbar_pull", 100 / key[1]), ("torque", 100 / (key[1] * RADIUS)), ("sinkage", 1e3)):
            error = max(per_si * run["std_error"][name] for run in runs)
            cells.append(", ".join(f"{per_si * run[name]:.1f}" for run in runs) + f" ± {error:.1f}")
        print(f"{place(key)}| {cells[0]} | {fine} | {cells[1]} | {cells[2]} | {pull_by_number(key)} |")


def main():
    """Prints what grains say, and what the quick models say beside it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("records", nargs="*", default=PAIRS[0])
    records = parser.parse_args().records
    (lugged, lugged_coarser), (smooth, smooth_coarser) = map(answers, records)
    both = sorted(lugged.keys() & smooth.keys(), key=lambda key: (key[0], key[4], key[2]))
    print("| uphill | slip | pull, % of the load | by infinitely fine grains | torque, % | sinkage [mm] "
          "| tractive efficiency, % |\n" + "|---" * 7 + "|")
    gain = {}
    for key in both:
        with_lugs, without = lugged[key], smooth[key]
        pull = change(with_lugs, without, "drawbar_pull")
        fine = None
        if key in lugged_coarser and key in smooth_coarser:
            fine = infinitely_fine(pull, change(lugged_coarser[key], smooth_coarser[key], "drawbar_pull"))
        percent = [None if one is None else "{:+.1f} ± {:.1f}".format(*(100 * part / key[1] for part in one))
                   for one in (pull, fine)]
        gain[key] = percent[1] or percent[0]
        torque, sinkage = change(with_lugs, without, "torque"), change(with_lugs, without, "sinkage")
        print(f"{place(key)}| {100 * without['drawbar_pull'] / key[1]:.1f} {percent[0]} | {percent[1] or ''} "
              f"| {100 * torque[0] / without['torque']:+.0f} ± {100 * torque[1] / without['torque']:.0f} "
              f"| {1e3 * without['sinkage']:.0f} {1e3 * sinkage[0]:+.1f} ± {1e3 * sinkage[1]:.1f} "
              f"| {efficiency(without)} -> {efficiency(with_lugs)} |")

    warnings.simplefilter("ignore", soilbin.SoilbinWarning)
    case, bare = (soilbin.find_case(name).scenario for name in ("heavy-lugged-incline", "heavy-smooth-incline"))
    analytic, rft = BekkerWong(patch=False), soilbin.ResistiveForce()
    models = {f"`{form}`": ((analytic, soilbin.Scenario(case.tire, case.soil, effects=[f"lug_thrust:{form}"])),
                            (analytic, soilbin.Scenario(bare.tire, case.soil))) for form in FORMS}
    models["`rft`"] = ((rft, soilbin.Scenario(case.tire, case.soil)), (rft, soilbin.Scenario(bare.tire, case.soil)))
    print("\n| uphill | slip | infinitely fine grains | " + " | ".join(models) + " |")
    print("|---" * (3 + len(models)) + "|")
    for key in both:
        at = soilbin.OperatingCondition(**dict(zip(CONDITION, key[1:])))
        print(f"{place(key)}| {gain[key]} | "
              + " | ".join("{:+.1f}, {:+.0f} %".format(*said(*pair, at)) for pair in models.values()) + " |")
    print_by_number(records[1], HALF, records[0])
    print_by_grain_size([records, *PAIRS[1:]])


if __name__ == "__main__":
    main()
