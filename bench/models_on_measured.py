"""Which quick model is nearer to measurement? CMU's two wheels, nothing fitted to them, by channel, slip and yaw.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/models_on_measured.py                 half a minute
    PYTHONPATH=build/release/python /usr/bin/python3 bench/models_on_measured.py --bias

Prints Markdown tables: the root mean square (RMS) error of each model over the runs that all of them answer (with
--bias the mean of predicted less measured), the noise, and which of the last two models is nearer, where one is.

What is not known of a wheel or its sand is varied: xi_n from density and friction angle or from plates, and the number
of lugs, which is not published. A verdict holds for every variant; difference and p are of the least sure one.

Noise is the standard deviation of one run about the mean of its repeats; what their loads differ by is in it. Two
models are compared by setpoint: repeats of one share its model error, so they count once. The p value is that of a
randomization test: were the two models equally near, their squared errors at each setpoint could change places (all
2^n exchanges up to n = 14, else 20,000 drawn). "Nearer" is said at a false discovery rate of 5 % over a wheel's table
(Benjamini and Hochberg 1995). The standard error of a difference of two RMS errors is a bootstrap's over setpoints.
The setpoints stand for conditions like these; that the declared Bekker values may be wrong is not in the p value.
"""
import argparse
import itertools
import warnings

import numpy as np
import pandas as pd

import soilbin
from soilbin import compare
from soilbin.bekker_wong import BekkerWong

# xi_n of measured/plates/cmu-plates.csv (soilbin plates); the friction is what the model takes for this sand anyway
PLATES = soilbin.ResistiveForceSoil(xi_n=soilbin.Estimate(1.55e6, 0.32e6), surface_friction=soilbin.Estimate(0.35, 0.1))
COUNTS, THICKNESS = (12, 24, 48), 2e-3  # of the lugs, both assumed; [-], [m]
CHANNELS = {"drawbar_pull": ("drawbar pull", "N", 1.0), "sinkage": ("sinkage", "mm", 1e3),
            "lateral_force": ("lateral force", "N", 1.0)}
SPEEDS = {"slip -100 to -50 %": ("v0", "v3", "v5"), "slip -20 to 23 %": ("v8", "v10", "v12"),
          "slip 50 to 90 %": ("v20", "v40", "v100")}  # rim speeds [mm/s] of the setpoints; travel is 10 mm/s
YAWS = (0, 15, 45, 75, 90)
WHEEL, LUGS, RFT = "Wong-Reece", "Wong-Reece with lug_thrust", "rft"


def answers(campaign, count=None, plates=False):
    """Predictions by model, a frame each, in the order of the campaign's runs; count: of lugs, where it has some."""
    declared, at = campaign.scenario(), [run.at for run in campaign.runs]
    soil = declared.soil.replace(resistive_force=PLATES) if plates else declared.soil
    tire = declared.tire
    if count:
        tire = tire.replace(lugs=tire.lugs.replace(count=count, thickness=THICKNESS))
    asked = {WHEEL: ([], BekkerWong(patch=False)), RFT: ([], soilbin.ResistiveForce())}
    if count:
        asked[LUGS] = (["lug_thrust:passive_blade"], BekkerWong(patch=False))
    return {name: soilbin.sweep(soilbin.Scenario(tire, soil, effects=effects), at, model, progress=None)
            for name, (effects, model) in asked.items()}


def noise(values, setpoints):
    """Standard deviation of one run about the mean of its setpoint's runs; NaN without repeats."""
    groups = values.groupby(setpoints)
    freedom = len(values) - groups.ngroups
    return np.sqrt(((values - groups.transform("mean")) ** 2).sum() / freedom) if freedom > 0 else np.nan


def p_exchanged(difference, rng):
    """Two-sided p of the sum of differences, one a setpoint, where each may have the other sign."""
    n = len(difference)
    signs = np.array(list(itertools.product((1, -1), repeat=n))) if n <= 14 else rng.choice((1, -1), (20000, n))
    at_least = np.abs(signs @ difference) >= abs(difference.sum()) * (1 - 1e-12)
    return at_least.mean() if n <= 14 else (at_least.sum() + 1) / (len(signs) + 1)


def difference_error(a, b, weights, rng, draws=4000):
    """Standard error of the difference of two RMS errors, from mean squared errors and numbers of runs by setpoint."""
    drawn = rng.integers(len(a), size=(draws, len(a)))
    w = weights[drawn]
    rms = [np.sqrt((x[drawn] * w).sum(1) / w.sum(1)) for x in (a, b)]
    return (rms[0] - rms[1]).std(ddof=1)


def bins(runs):
    """Names and masks of the table's lines."""
    yield "all", pd.Series(True, runs.index)
    speed = runs.setpoint.str.split("-").str[1]
    for name, those in SPEEDS.items():
        yield name, speed.isin(those)
    for yaw in YAWS:
        yield f"yaw {yaw} deg", np.isclose(np.degrees(runs.yaw), yaw, atol=1)


def table(runs, frames, pair, answered):
    """A row a channel and bin of one variant: each model's RMS and mean error, noise, and how the pair differs."""
    rng, rows = np.random.default_rng(1), []
    for channel, (label, unit, scale) in CHANNELS.items():
        for name, mask in bins(runs):
            if channel == "lateral_force" and name == "yaw 0 deg":
                continue  # both say 0
            use = np.asarray(mask) & answered & runs[channel].notna().to_numpy()
            of, setpoints = scale * runs[channel][use], runs.setpoint[use]
            errors = {model: scale * frame[channel][use] - of for model, frame in frames.items()}
            a, b = ((errors[model] ** 2).groupby(setpoints).mean().to_numpy() for model in pair)
            weights = setpoints.groupby(setpoints).size().to_numpy()
            rms = {model: np.sqrt((error**2).mean()) for model, error in errors.items()}
            rows.append({"channel": f"{label} [{unit}]", "bin": name, "runs": int(use.sum()),
                         "noise": noise(of, setpoints), "rms": rms,
                         "bias": {model: error.mean() for model, error in errors.items()},
                         "difference": rms[pair[0]] - rms[pair[1]], "error": difference_error(a, b, weights, rng),
                         "p": p_exchanged((a - b) * weights, rng)})
    found = pd.DataFrame(rows)
    passes = found.p <= 0.05 * found.p.rank(method="max") / len(found)
    surest = found.p <= found.p[passes].max()  # Benjamini and Hochberg: all up to the largest that passes
    found["nearer"] = np.where(surest, np.where(found.difference < 0, *pair), "")
    return found


def of_all_variants(found, shown, what, which):
    """Lines of Markdown. shown: {model: places of the variants whose figures its cell has}; what: differs there."""
    headings = [f"{model}: {what}" if len(places) > 1 else model for model, places in shown.items()]
    yield "| | runs | noise | " + " | ".join(headings) + " | difference of RMS | p | nearer |"
    yield "|---" * (6 + len(shown)) + "|"
    for rows in zip(*(variant.itertuples() for variant in found)):
        first, doubtful = rows[0], max(rows, key=lambda row: row.p)
        cells = [", ".join(f"{getattr(rows[place], which)[model]:.1f}" for place in places)
                 for model, places in shown.items()]
        verdicts = {row.nearer for row in rows}
        nearer = verdicts.pop() if len(verdicts) == 1 else ""
        p = f"{doubtful.p:.4f}" if doubtful.p >= 0.0001 else "< 0.0001"
        yield (f"| {first.channel}, {first.bin} | {first.runs} | {first.noise:.1f} | {' | '.join(cells)} "
               f"| {doubtful.difference:.1f} ± {doubtful.error:.1f} | {p} | {nearer or '-'} |")


def main():
    """Prints the tables of both wheels."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bias", action="store_true", help="mean errors in place of RMS errors")
    which = "bias" if parser.parse_args().bias else "rms"
    warnings.simplefilter("ignore", soilbin.SoilbinWarning)  # what they say stands in `soilbin predict`
    for name, counts, pair in (("cmu-smooth", (None,), (WHEEL, RFT)), ("cmu-grousered", COUNTS, (LUGS, RFT))):
        campaign = compare.find_campaign(name)
        runs = compare.runs_frame(campaign)
        variants = [answers(campaign, count, plates) for plates in (False, True) for count in counts]
        answered = np.all([frame.error == "" for frames in variants for frame in frames.values()], axis=0)
        found = [table(runs, frames, pair, answered) for frames in variants]
        each, every = range(len(counts)), range(len(variants))
        shown, what = {WHEEL: [0], LUGS: each, RFT: each}, ", ".join(map(str, counts)) + " lugs"
        if counts == (None,):
            shown, what = {WHEEL: [0], RFT: every}, "xi_n estimated, from plates"
        print(f"\n{name}: {answered.sum()} of {len(runs)} runs are answered in all variants; without an answer:")
        for model in variants[0]:
            print(f"{model}: " + ", ".join(str((frames[model].error != "").sum()) for frames in variants))
        print("\n" + "\n".join(of_all_variants(found, shown, what, which)))


if __name__ == "__main__":
    main()
