#!/usr/bin/env python3
"""A campaign of any number of rows, to time the loop with: the runs of one that exists, repeated with other loads and slips.

    sizes.py CAMPAIGN ROWS OUT [--seed N]

The first rows are the campaign's own. Each further round has new setpoints near its (load scaled by up to 10 %, slip moved by up
to 0.02; drawbar pull, torque and lateral force scaled with the load) and noise of 2 % of each channel's standard deviation.
It is no measurement and no truth: for times alone.
"""
import argparse
import csv
import random
import shutil
import statistics
from pathlib import Path

FORCES = ("drawbar_pull_N", "torque_Nm", "lateral_force_N")
CHANNELS = (*FORCES, "sinkage_m")


def number(row, name):
    return float(row[name]) if row.get(name) else None


def another(row, number_of, round_of, spread, random_):
    """A run near `row`, as the file holds it."""
    setpoint = random.Random(f"{round_of} {row.get('setpoint')}")
    scale, shift = setpoint.uniform(0.9, 1.1), setpoint.uniform(-0.02, 0.02)
    made = dict(row)
    if "run" in row:
        made["run"] = str(number_of)
    if row.get("setpoint"):
        made["setpoint"] = f"{row['setpoint']}-{round_of}"
    made["load_N"] = f"{number(row, 'load_N') * scale:.4f}"
    made["slip"] = f"{min(max(number(row, 'slip') + shift, -1.0), 0.99):.4f}"
    for name in CHANNELS:
        value = number(row, name)
        if value is not None:
            made[name] = f"{value * (scale if name in FORCES else 1.0) + random_.gauss(0, 0.02 * spread[name]):.6f}"
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("campaign", type=Path)
    parser.add_argument("rows", type=int)
    parser.add_argument("out", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    with open(args.campaign / "runs.csv", encoding="utf-8") as file:
        runs = list(csv.DictReader(file))
    values = {name: [number(r, name) for r in runs if number(r, name) is not None] for name in CHANNELS}
    spread = {name: statistics.pstdev(v) if v else 0.0 for name, v in values.items()}
    random_ = random.Random(args.seed)
    last = max(int(run.get("run") or 0) for run in runs)  # the rounds' runs follow
    made = runs[:args.rows]
    for i in range(len(runs), args.rows):
        made.append(another(runs[i % len(runs)], last + 1 + i - len(runs), i // len(runs), spread, random_))
    args.out.mkdir(parents=True, exist_ok=True)
    shutil.copy(args.campaign / "campaign.yaml", args.out)
    with open(args.out / "runs.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, list(runs[0]))
        table.writeheader()
        table.writerows(made)


if __name__ == "__main__":
    main()
