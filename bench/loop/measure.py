"""Runs `soilbin loop` over a set of synthetic campaigns (nature/) and reports the targets with 95 % intervals.

Baselines stand beside the loop on the same campaigns: `refit only` (the soil refitted, no effect), `AICc only` (the candidate of
least AICc, nothing else), `smooth term` (any smooth function of the conditions on what the refit leaves: no name), `random
pick` (one of the testable ids).
Nothing here tunes the loop: thresholds were set on set `tune`; set `report` is for the figures.
"""
import argparse
import concurrent.futures
import json
import math
import subprocess
import sys
import time
from pathlib import Path

from nature import campaign
from nature.wheel import CHANNELS, SOIL_KEYS
from places import LARGE, Places, SoilErrors, fails_at, rows_of

KINDS = ("one_rich", "one_poor", "outliers", "two")


def interval(hits, n):
    """Wilson's 95 % interval of a share, as text."""
    if n == 0:
        return "no case"
    z, p = 1.96, hits / n
    middle, scale = p + z * z / (2 * n), 1 + z * z / n
    half = z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return f"{100 * p:5.1f} % ({hits}/{n}; {max(0.0, 100 * (middle - half) / scale):.0f} .. {100 * (middle + half) / scale:.0f})"


def median(values):
    """Median of a list, nan for none."""
    values = sorted(values)
    return values[len(values) // 2] if values else float("nan")


def answer(command, folder, *more):
    """The loop's JSON for one campaign, with the seconds it took; {'error': ...} where it failed."""
    start = time.monotonic()
    done = subprocess.run([command, "loop", str(folder), "--json", "--details", *more], capture_output=True, text=True)
    if done.returncode != 0:
        return {"error": done.stderr.strip()[-200:]}
    found = json.loads(done.stdout)
    found["seconds"] = time.monotonic() - start
    return found


def named(found):
    """Ids of the accepted effects."""
    return {effect["id"] for effect in found["effects"]}


def in_set(truth, found):
    """Whether the truth is one of the sets that the loop can't tell apart."""
    return any(set(s["effects"]) == set(truth["effects"]) for s in found["ambiguity_set"])


def held_out(cases):
    """Medians over accepted cases: error over the noise, share of the removable error that was removed."""
    after, removed = [], []
    for _, found in cases:
        overall = found["error"]["overall"]
        if found["verdict"] != "effect_found" or not overall:
            continue
        after.append(overall["after"])
        if overall["before"] > 1.1:
            removed.append((overall["before"] - overall["after"]) / (overall["before"] - 1))
    return median(after), median(removed)


def removed_by_smooth_term(cases):
    """Median share of the removable held-out error that a smooth term without a name removes."""
    removed = []
    for _, found in cases:
        overall, smooth = found["error"]["overall"], found.get("details", {}).get("error_smooth_term")
        if overall and smooth is not None and overall["before"] > 1.1:
            removed.append((overall["before"] - smooth) / (overall["before"] - 1))
    return median(removed)


def share_by_chance(truth, found):
    """Chance that sets of as many testable ids, drawn at random, are the truth."""
    testable, wanted = 20 - len(found["not_testable"]), len(truth["effects"])
    return 1 / math.comb(testable, wanted) if testable >= wanted else 0.0


def by_aicc(found):
    """Ids that the corrected Akaike criterion picks among base model and candidates."""
    details = found["details"]
    n = details["values"]

    def aicc(chi2, k):
        return chi2 + 2 * k + 2 * k * (k + 1) / max(1, n - k - 1)

    rows = [(aicc(s["chi2"], s["parameters"]), set(s["effects"])) for s in details["sets"]]
    rows.append((aicc(details["chi2_base"], details["parameters_base"]), set()))
    return min(rows, key=lambda row: row[0])[1]


def report_kind(kind, cases):
    """Rows of one kind of campaign that has effects."""
    n = len(cases)
    found = [c for c in cases if c[1]["verdict"] == "effect_found"]
    sizes = [len(a["ambiguity_set"]) for _, a in found]
    after, removed = held_out(cases)
    print(f"{kind}: {n} campaigns, effects of 1.5 times the detectable size or more")
    print("  detected              ", interval(sum(a["verdict"] in ("effect_found", "unknown_effect") for _, a in cases), n))
    print("  right name(s), top 1  ", interval(sum(named(a) == set(t["effects"]) for t, a in cases), n))
    print("  truth in ambiguity set", interval(sum(in_set(t, a) for t, a in cases), n))
    print("  the same, where found ", interval(sum(in_set(t, a) for t, a in found), len(found)))
    print(f"  mean size of the set   {sum(sizes) / max(1, len(sizes)):.2f}")
    print("  wrong and unflagged   ", interval(sum(not in_set(t, a) for t, a in found), n))
    print(f"  held-out error/noise   {after:.2f} (median); removable error removed {100 * removed:.0f} % (median)")
    print("  baseline AICc only     right names", interval(sum(by_aicc(a) == set(t["effects"]) for t, a in cases), n))
    print("  baseline smooth term   flags a residual", interval(sum(a["details"]["unnamed_gain"] > math.log(20) for _, a in cases), n)
          + f"; no name; removable error removed {100 * removed_by_smooth_term(cases):.0f} % (median)")
    print(f"  baseline random pick   right names {100 * sum(share_by_chance(t, a) for t, a in cases) / n:.1f} %")
    print("  baseline refit only    no name; removable error removed 0 %")


def changed_rows(found, folder):
    """Runs at which the effects of the saved model change a channel by more than LARGE times its noise; None without package."""
    try:
        from fitting import Campaign, changed
    except ImportError:
        return None
    readings = Campaign(folder)
    if not found["soil"]:  # nothing is named, and nothing stands in
        return rows_of([], len(readings.at))
    noise = [found["error"].get(c, {}).get("noise_floor", math.nan) for c in CHANNELS]
    effects = [(e["id"], e["form"], e["parameters"]) for e in found["effects"] or found["stand_in"]]
    return changed(readings, [found["soil"][k]["value"] for k in SOIL_KEYS], effects, noise, LARGE)


def report_soil_and_places(cases):
    """How far off the fitted soil is without and with the effects, and whether the runs at which the model fails are found.

    cases: (truth, answer, folder); those with something hidden count, for the soil where the answer tells one.
    """
    soils, places = {name: SoilErrors() for name in ("without", "value", "right without", "right value")}, Places()
    for truth, found, folder in cases:
        record = campaign.read(folder)
        if not record["effects"]:
            continue
        for key in ("without", "value") if found["soil"] else ():
            soil = {k: v[key] for k, v in found["soil"].items()}
            soils[key].add(record, soil)
            if truth["effects"] and named(found) == set(truth["effects"]):
                soils["right " + key].add(record, soil)
        true = fails_at(record)
        said = rows_of(found["changed"], len(true)) if "changed" in found else changed_rows(found, folder)
        if said is not None:
            places.add(said, true)
    print("  soil without effects  ", soils["without"].words())
    print("  soil with them        ", soils["value"].words())
    print("  names right: without  ", soils["right without"].words())
    print("  names right: with     ", soils["right value"].words())
    print("  where the model fails ", places.words() if places.runs else "asks for PYTHONPATH=build/release/python")


def report(truth, answers, folder):
    """The whole table."""
    good = [(truth[n], a) for n, a in answers.items() if "verdict" in a]
    print(f"{len(good)} campaigns answered, {len(answers) - len(good)} failed; "
          f"{median([a['seconds'] for _, a in good]):.1f} s a campaign (median), {max(a['seconds'] for _, a in good):.1f} s at most")
    nulls = [(t, a) for t, a in good if t["verdict"] == "nothing_missing"]
    print("false alarms on nulls    ", interval(sum(a["verdict"] in ("effect_found", "unknown_effect") for _, a in nulls), len(nulls)))
    print("  baseline AICc only     ", interval(sum(bool(by_aicc(a)) for _, a in nulls), len(nulls)))
    print("  baseline smooth term   ", interval(sum(a["details"]["unnamed_gain"] > math.log(20) for _, a in nulls), len(nulls)))
    for kind in (*KINDS, "instrument"):
        cases = [(t, a) for t, a in good if t["kind"] == kind and t["verdict"] == "effect_found" and t["ratio_to_detectable"] >= 1.5]
        if cases:
            report_kind(kind, cases)
    unknown = [(t, a) for t, a in good if t["verdict"] == "unknown_effect"]
    print("unknown flagged          ", interval(sum(a["verdict"] == "unknown_effect" for _, a in unknown), len(unknown)))
    after, removed = held_out(good)
    report_soil_and_places([(truth[n], a, folder / n) for n, a in answers.items() if "verdict" in a])
    print(f"all accepted: held-out error/noise {after:.2f}, removable error removed {100 * removed:.0f} % (medians)")


def main():
    """Command line; exit 0 unless a campaign failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="made by: python3 -m nature --set report --seed 1 --count 200 --out FOLDER")
    parser.add_argument("--soilbin", default="build/release/soilbin")
    parser.add_argument("--jobs", type=int, default=1, help="campaigns at once (each takes the machine's cores itself)")
    parser.add_argument("--answers", type=Path, help="keep the answers in this file")
    options = parser.parse_args()
    truth = json.loads((options.folder / "truth.json").read_text())
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        answers = dict(zip(sorted(truth), pool.map(lambda n: answer(options.soilbin, options.folder / n), sorted(truth))))
    if options.answers:
        options.answers.write_text(json.dumps(answers, indent=1))
    report(truth, answers, options.folder)
    failed = [f"{n}: {a['error']}\n" for n, a in answers.items() if "verdict" not in a]
    sys.stderr.write("".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
