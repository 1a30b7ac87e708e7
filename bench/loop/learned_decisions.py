#!/usr/bin/env python3
"""Would a learned rule tell better than the loop's levels when to name an effect and when to say 'unknown'?

    learned_decisions.py SET [SET ...]

SET: a folder of `python3 -m nature` whose answers `measure.py SET --answers SET/answers.json` has kept (`--details` is in
them). Of every campaign with something hidden in which any effect stands out, the rule is given what the loop computes
anyway (FEATURES) and learns whether the best set of effects is the truth: by logistic regression, and by the same with all
squares and products. It is cross-validated twice: by leaving out campaigns at random, and by leaving out every campaign
with an effect of a family (known or unknown), so that it can't learn the families. Then as many wrong names are told as
the loop tells, and the right ones are counted.
"""
import argparse
import json
from pathlib import Path

import numpy as np

FEATURES = ("ln of the others' share", "ln gain in evidence", "lead over the second set", "ln p of lack of fit after",
            "share of the excess left", "gain of an unnamed term after", "ln p of re-runs after", "excess over re-runs left",
            "ln p of the runs' order after", "held-out gain over its error", "ln values", "effects in the set",
            "ln chi2 a value after", "ln p of lack of fit before", "gain of an unnamed term before")
FOLDS = 10


def features(found):
    """What the rule is given of an answer, and the effects of the loop's best set; None where no effect stands out."""
    d = found["details"]
    sets = sorted((s for s in d["sets"] if s["set_log_evidence"] is not None and s["effects"]), key=lambda s: -s["set_log_evidence"])
    if not sets or d["p_value"] > 0.05 or not d["choice_gain"] or d["lack_of_fit_p"][1] is None:
        return None
    top, values = sets[0], d["values"]
    runner_up = sets[1]["set_log_evidence"] if len(sets) > 1 else d["log_evidence_base"]
    before, after = d["reruns"] if len(d["reruns"]) == 2 else ([1.0, 0.0], [1.0, 0.0])
    gain, error = d["choice_gain"]
    row = [np.log(1e-6 + 1 - top["weight"]), np.log1p(max(0.0, top["set_log_evidence"] - d["log_evidence_base"])),
           min(30.0, top["set_log_evidence"] - runner_up), np.log(max(1e-5, d["lack_of_fit_p"][1])),
           max(0.0, top["chi2"] - values) / max(1.0, d["chi2_base"] - values), np.clip(d["residual_unnamed_gain"], -5, 15),
           np.log(max(1e-5, after[0])), after[1] / max(1.0, before[1]), np.log(max(1e-4, d["serial_p"][1])),
           np.clip(gain / max(1e-3, error), -3, 6), np.log(values), len(top["effects"]), np.log(top["chi2"] / values),
           np.log(max(1e-5, d["lack_of_fit_p"][0])), np.clip(d["unnamed_gain"], -5, 60)]
    named = {e["id"] for e in found["effects"]}
    return row, named if found["verdict"] == "effect_found" else set(top["effects"])


def logistic(rows, right, ridge):
    """Weights (constant first) of a ridge-penalised logistic regression, by Newton's method."""
    columns = np.c_[np.ones(len(rows)), rows]
    penalty = ridge * np.r_[1e-6, np.ones(rows.shape[1])]
    w = np.zeros(columns.shape[1])
    for _ in range(50):
        p = 1 / (1 + np.exp(-columns @ w))
        w -= np.linalg.solve((columns.T * (p * (1 - p))) @ columns + np.diag(penalty), columns.T @ (p - right) + penalty * w)
    return w


def cross_validated(rows, right, tests, ridge):
    """Log odds of every campaign by rules that have not seen it; tests: which ones each fold leaves out."""
    odds, count = np.zeros(len(right)), np.zeros(len(right))
    for left_out in tests:
        w = logistic(rows[~left_out], right[~left_out], ridge)
        odds[left_out] += w[0] + rows[left_out] @ w[1:]
        count[left_out] += 1
    return odds / np.maximum(count, 1)


def told(odds, right, wrong):
    """The surest answers, as many as hold so many wrong ones."""
    order = np.argsort(-odds)
    most = int(np.searchsorted(np.cumsum(1 - right[order]), wrong, side="right"))
    chosen = np.zeros(len(right), bool)
    chosen[order[:most]] = True
    return chosen


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folders", nargs="+", type=Path)
    options = parser.parse_args()
    rows, right, today, unknown, families = [], [], [], [], []
    for folder in options.folders:
        truth, answers = (json.loads((folder / name).read_text()) for name in ("truth.json", "answers.json"))
        for name, t in truth.items():
            found = features(answers[name]) if t["verdict"] != "nothing_missing" and "details" in answers[name] else None
            if found:
                rows.append(found[0])
                right.append(found[1] == set(t["effects"]))
                today.append(answers[name]["verdict"] == "effect_found")
                unknown.append(t["kind"] == "unknown")
                families.append(set(t["effects"]) or set(t["forms"]))
    rows, right, today, unknown = np.array(rows), np.array(right, float), np.array(today), np.array(unknown)
    rows = (rows - rows.mean(axis=0)) / rows.std(axis=0)
    i, j = np.triu_indices(rows.shape[1])
    products = np.c_[rows, 0.5 * rows[:, i] * rows[:, j]]
    rng = np.random.default_rng(5)
    of = rng.integers(0, FOLDS, len(right))
    names = sorted(set().union(*families))
    rng.shuffle(names)
    tests = {"campaigns left out": [of == k for k in range(FOLDS)],
             "families left out": [np.array([bool(f & set(names[k::FOLDS])) for f in families]) for k in range(FOLDS)]}
    wrong = int(np.sum((1 - right) * today))
    print(f"{len(right)} campaigns, the best set is the truth in {int(right.sum())}; {unknown.sum()} hold an unknown effect")
    print(f"{'today':34s} right names {int(np.sum(right * today))}, wrong ones {wrong}, of them unknown effects {int(np.sum(today & unknown))}")
    for rule, columns, ridges in (("logistic", rows, (1, 10)), ("logistic with products", products, (30, 100))):
        for way, left_out in tests.items():
            for ridge in ridges:
                chosen = told(cross_validated(columns, right, left_out, ridge), right, wrong)
                print(f"{rule}, ridge {ridge}, {way}: right names {int(np.sum(right * chosen))}, of the wrong ones unknown effects "
                      f"{int(np.sum(chosen & unknown))}")


if __name__ == "__main__":
    main()
