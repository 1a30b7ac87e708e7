"""Does a designed test name more effects than a sweep? The same hidden effects, measured by three plans of as many runs.

    designed_runs.py FOLDER [--runs 24] [--soilbin PROGRAM] [--answers FILE]

FOLDER is made by `python3 -m nature`; its rows are not used. Each campaign's nature is measured anew at the runs that
`soilbin design` plans within the ranges that its own plan spans (design), at the sweep of one condition at a time that stands
beside it (sweep), and at a balanced random draw of its levels (draw: what nature's own plans are). Order drawn in all three;
the noise given to `design` is the floor of nature's. Then the loop is asked, on each.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import measure  # noqa: E402
from nature import campaign, design  # noqa: E402
from nature import wheel as base  # noqa: E402

PLANS = ("design", "sweep", "draw")
UNITS = {"load": "N", "speed": "m/s", "moisture": "%", "position": "m", "longitudinal": "deg", "transverse": "deg", "yaw": "deg"}
NAMES = {"longitudinal": "longitudinal_incline", "transverse": "transverse_incline"}
SI = {"drawbar_pull": "N", "torque": "N m", "sinkage": "m", "lateral_force": "N"}


def planned(command, folder, record, runs):
    """What `soilbin design` answers for a campaign without rows, as JSON."""
    with tempfile.TemporaryDirectory() as place:
        yaml = campaign.yaml_text(folder.name, record)
        kept = [line for line in yaml.splitlines() if not line.startswith(("data:", "columns:"))]
        (Path(place) / "campaign.yaml").write_text("\n".join(kept) + "\n")
        words = [command, "design", place, "--runs", str(runs), "--json"]
        for name in ("load", "slip", *record["plan"]["vary"]):
            low, high, unit = min(record["levels"][name]), max(record["levels"][name]), UNITS.get(name, "")
            words += ["--limit", f"{NAMES.get(name, name)}={low}{unit}..{high}{unit}"]
        for channel in record["read"]:
            words += ["--noise", f"{channel}={record['noise']['a'][channel]:.4g}{SI[channel]}"]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{folder.name}: {done.stderr.strip()}")
        return json.loads(done.stdout)


def rows_of(record, runs):
    """nature's rows at these runs (JSON of soilbin design), in the order that they have."""
    names = {c: n for n, c in campaign.COLUMNS.items()}
    rows = {n: [] for n in ("load", "slip", *design.FACTORS, "run", "setpoint")}
    for i, run in enumerate(runs):
        wanted = {names[c]: v for c, v in run.items() if names[c] not in ("run", "setpoint")}
        for n in ("load", "slip", *design.FACTORS):
            rows[n].append(float(wanted[n] if n in wanted else campaign.default(record, n)))
        rows["run"].append(i + 1.0)
        rows["setpoint"].append("-".join(f"{rows[n][-1]:.4g}" for n in ("load", "slip", *record["plan"]["vary"])))
    return rows


def drawn_rows(record, runs, rng):
    """A balanced random draw of the levels, as nature plans its own."""
    plan = dict(record["plan"], runs=runs, order="random", rerun_part=0.25, jitter=False, other_place=False)
    rows = design.draw_rows(rng, plan, record["levels"])
    return {n: v if n == "setpoint" else [float(x) for x in v] for n, v in rows.items()}


def measured(record, rows, rng):
    """The record of the same nature measured at these rows; without those at which the wheel sinks."""
    made = dict(record, rows=rows, calls=0, outliers=[])
    world = campaign.restore(made)
    shown = {n: v if n == "setpoint" else list(v) for n, v in design.rounded(world.rows, max(rows["load"])).items()}
    fx = [campaign.build(e) for e in record["effects"]]
    truth = campaign.restore(dict(made, rows=shown)).truth(fx)
    keep = [i for i, fine in enumerate(truth["ok"]) if fine]
    made["rows"] = {n: [v[i] if n == "setpoint" else float(v[i]) for i in keep] for n, v in shown.items()}
    truth = campaign.restore(made).truth(fx)
    read = campaign.noise.sample(rng, record["noise"], {c: truth[c] for c in base.CHANNELS})
    made["read"] = {c: [float(v) for v in read[c]] for c in record["read"]}
    made["shown"] = ["run", "setpoint", "load", "slip"] + [n for n in (*design.FACTORS,) if n in record["plan"]["vary"]]
    return made


def ask(command, folder, record, runs, seed, wanted):
    """The loop's answers by plan."""
    found = planned(command, folder, record, runs)
    rng = np.random.default_rng([seed, int(folder.name[1:])])
    shuffled = [found["sweep"]["runs"][i] for i in rng.permutation(len(found["sweep"]["runs"]))]
    plans = {"design": rows_of(record, found["runs"]), "sweep": rows_of(record, shuffled), "draw": drawn_rows(record, runs, rng)}
    answers = {"expected": {"design": found["named_right"], "sweep": found["sweep"]["named_right"]}}
    for name in wanted:
        with tempfile.TemporaryDirectory() as place:
            made = measured(record, plans[name], np.random.default_rng([seed, int(folder.name[1:]), 1 + PLANS.index(name)]))
            campaign.write(Path(place) / folder.name, made)
            answers[name] = measure.answer(command, Path(place) / folder.name, "--folds", "2")
            answers[name]["rows"] = len(made["rows"]["load"])
    return answers


def better(stories, one, other, right):
    """How many campaigns only `one` has right, how many only `other`, and the sign test's two-sided p."""
    a = sum(right(t, s[one]) and not right(t, s[other]) for t, s in stories)
    b = sum(right(t, s[other]) and not right(t, s[one]) for t, s in stories)
    tail = sum(math.comb(a + b, k) for k in range(max(a, b), a + b + 1)) / 2 ** (a + b)
    return a, b, min(1.0, 2 * tail)


def report(stories, wanted):
    """The table."""
    right = lambda t, a: a.get("verdict") == "effect_found" and measure.named(a) == set(t["effects"])  # noqa: E731
    n = len(stories)
    for plan in wanted:
        asked = [(t, s[plan]) for t, s in stories]
        found = [a for _, a in asked if a.get("verdict") == "effect_found"]
        print(f"{plan}: {measure.median([a['rows'] for _, a in asked])} runs (median)")
        print("  detected              ", measure.interval(sum(a.get("verdict") in ("effect_found", "unknown_effect") for _, a in asked), n))
        print("  right name            ", measure.interval(sum(right(t, a) for t, a in asked), n))
        print("  truth in ambiguity set", measure.interval(sum(a.get("verdict") == "effect_found" and measure.in_set(t, a) for t, a in asked), n))
        print("  one name, the right one", measure.interval(sum(right(t, a) and len(a["ambiguity_set"]) == 1 for t, a in asked), n))
        print("  wrong and unflagged   ", measure.interval(sum(a.get("verdict") == "effect_found" and not measure.in_set(t, a) for t, a in asked), n))
        print(f"  mean size of the set   {sum(len(a['ambiguity_set']) for a in found) / max(1, len(found)):.2f}")
    for other in wanted[1:]:
        print(f"right name by {wanted[0]} alone, by {other} alone, p of the sign test: {better(stories, wanted[0], other, right)}")
    for plan in ("design", "sweep"):
        print(f"expected to be named right, {plan}: {100 * sum(s['expected'][plan] for _, s in stories) / n:.1f} %")


def main():
    """Command line; exit 0 unless a campaign failed."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--soilbin", default="build/release/soilbin")
    parser.add_argument("--runs", type=int, default=24)
    parser.add_argument("--seed", type=int, default=1, help="of the noise")
    parser.add_argument("--plans", nargs="+", choices=PLANS, default=PLANS)
    parser.add_argument("--answers", type=Path)
    options = parser.parse_args()
    truth = json.loads((options.folder / "truth.json").read_text())
    stories = []
    for name in sorted(truth):
        if truth[name]["verdict"] != "effect_found":
            continue
        folder = options.folder / name
        stories.append((truth[name], ask(options.soilbin, folder, campaign.read(folder), options.runs, options.seed, options.plans)))
        line = {p: sorted(measure.named(stories[-1][1][p])) if "effects" in stories[-1][1][p] else "?" for p in options.plans}
        print(name, truth[name]["effects"], line, file=sys.stderr, flush=True)
    if options.answers:
        options.answers.write_text(json.dumps(stories, indent=1))
    report(stories, options.plans)
    return 1 if any("verdict" not in s[p] for _, s in stories for p in options.plans) else 0


if __name__ == "__main__":
    sys.exit(main())
