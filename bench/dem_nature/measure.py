"""Runs `soilbin loop` on the campaigns of measured/ beside this file and prints what it says of what was hidden, as Markdown.

    /usr/bin/python3 bench/dem_nature/measure.py [SOILBIN]
"""
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CAMPAIGNS = Path(__file__).resolve().parent / "measured"
# What was switched on in the grains, by the catalogue's names; on a cross slope two names tell of the same push.
TRUTH = {"dem-null": set(), "dem-lugs": {"lug_thrust"}, "dem-incline": {"slope_weakening"},
         "dem-cross-slope": {"sidewall_bulldozing", "slope_weakening"}, "dem-yaw": {"sidewall_bulldozing"},
         "dem-second-pass": {"multipass"}, "dem-shallow": {"hard_layer"}, "dem-tilted-bed": {"bed_tilt"}}


def sets_of(found):
    """The ambiguity set: (ids, share of the weight)."""
    return [(set(s["effects"]), s["weight"]) for s in found["ambiguity_set"]]


def row(soilbin, name, truth):
    """One line of the table, and whether the truth is in the set (None for the control)."""
    done = subprocess.run([soilbin, "loop", str(CAMPAIGNS / name), "--json"], capture_output=True,
                          text=True, check=True)
    found = json.loads(done.stdout)
    sets = sets_of(found)
    share = sum(weight for ids, weight in sets if ids & truth)
    holds = any(ids & truth for ids, _ in sets) if truth else None
    best = " + ".join(sorted(sets[0][0])) if sets else "-"
    error = found["error"]["overall"]
    rows = sum(1 for _ in open(CAMPAIGNS / name / "runs.csv", encoding="utf-8")) - 1
    told = "-" if holds is None else f"yes, {100 * share:.0f} %" if holds else "no"
    print(f"| {name} | {rows} | {found['verdict']} | {best} | {told} | {error['before']:.2f} | {error['after']:.2f} |")
    fell = error["after"] < error["before"] if found["verdict"] == "effect_found" else None
    return holds, fell


def main():
    soilbin = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/soilbin")
    for prefix, suffix, told in (("dem-", "", "base model"), ("dem-", "-control", "base model and what the control showed"),
                                 ("dem-deep-", "", "the second scale: base model and what its control showed"),
                                 ("dem-fine-", "", "the third scale: base model and what its control showed")):
        print(f"\n{told}\n\n| campaign | runs | verdict | best set | hidden one in the sets | before | after |")
        print("|---|---|---|---|---|---|---|")
        outcomes = [row(soilbin, name.replace("dem-", prefix) + suffix, truth) for name, truth in TRUTH.items()]
        held = [holds for holds, _ in outcomes if holds is not None]
        fell = [f for _, f in outcomes if f is not None]
        print(f"\nin the sets: {sum(held)} of {len(held)}; held-out error falls: {sum(fell)} of {len(fell)} accepted")


if __name__ == "__main__":
    main()
