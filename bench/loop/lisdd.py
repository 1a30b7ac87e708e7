#!/usr/bin/env python3
"""A baseline beside the loop, after LISDD (arXiv 2606.23215, 2026), on the same campaigns and with the same equations.

    PYTHONPATH=build/release/python /usr/bin/python3 bench/loop/lisdd.py SET [--loop ANSWERS] [--answers FILE] [--first N]
    ... lisdd.py --self-test

SET: made by `python3 -m nature`, with its hidden .nature/. ANSWERS: what `measure.py SET --answers ANSWERS` kept of the loop.

Its steps are those that the paper's abstract names; the paper itself was not at hand. What is assumed of each:

1 fit on a clean regime   which conditions are clean nobody knows beforehand, since each effect acts elsewhere: the half of
                          the setpoints that one soil fits best (least trimmed squares, Rousseeuw 1984)
2 flag regions            runs that lie off that fit together with the four nearest ones, its own error counted (F-test)
3 hold-out                every form of soilbin's catalogue fitted, soil free within its declared sd, on one half of the
                          setpoints (drawn at random), scored by leaving out each setpoint in turn (PRESS, Allen 1974); so
                          every pair of effects by their linear traces, and the ten best in full
4 sample-split F-test     each effect in its best form against the base model on the other half, which no choice has seen; a
                          pair against both of its single effects, the worse counts
5 false-discovery rate    Benjamini and Hochberg 1995 over the effects, and over the pairs, 5 %. Of those that stand, the one
                          of least hold-out error is named. Where none stands and a region is flagged: unknown

The noise of a channel is that of its re-runs, else of all residuals, the same for all runs.
"""
import argparse
import itertools
import json
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy import stats

import measure
from fitting import CATALOGUE, CHANNELS, SOIL_KEYS, Campaign, Fit, Fitter, changed
from kept import Kept
from nature import campaign as nature_campaign
from nature import sets
from nature.selftest import Checks
from places import LARGE, Places, SoilErrors, fails_at, rows_of

LEVEL = 0.05  # false-discovery rate
NEAR = 5  # runs of a region: one and those nearest to it
REGIONS = 0.2  # false-discovery rate of the runs flagged; unknown is said at LEVEL
TRACE = 1e-4  # least change of a cell by a form at a fifth of its usual size that is looked at [sd]
PAIRS = 10  # of effects that are fitted in full, of least hold-out error by their traces


def discoveries(p, level=LEVEL):
    """Which of these p-values stand at a false-discovery rate (Benjamini and Hochberg 1995)."""
    p = np.asarray(p, float)
    order = np.argsort(p)
    good = np.flatnonzero(p[order] <= level * np.arange(1, len(p) + 1) / max(1, len(p)))
    stands = np.zeros(len(p), bool)
    stands[order[:good[-1] + 1 if len(good) else 0]] = True
    return stands


def left_out(residual, slopes, blocks, soil=8):
    """Sum of squares of what each block misses when it is left out of a linear fit whose first `soil` values have priors."""
    prior = np.diag((np.arange(slopes.shape[1]) < soil).astype(float))
    curvature = slopes.T @ slopes + prior + 1e-9 * np.eye(slopes.shape[1])
    leverage = slopes @ np.linalg.solve(curvature, slopes.T)
    total = 0.0
    for block in blocks:
        own = np.eye(len(block)) - leverage[np.ix_(block, block)]
        total += float(np.sum(np.linalg.lstsq(own, residual[block], rcond=1e-6)[0] ** 2))
    return total


class Half:
    """The fits of one half of the setpoints."""

    def __init__(self, readings, noise, setpoints, held=None):
        self.held = held
        self.fitter = Fitter(readings, noise, np.flatnonzero(np.isin(readings.setpoint, setpoints)))
        owner = readings.setpoint[self.fitter.cell_rows]
        self.blocks = [np.flatnonzero(owner == s) for s in np.unique(owner)]
        self.base = self.fitter.fit(held=held)
        self.singles = {}

    def hold_out(self, fit):
        """Error of a fit on setpoints left out [sd^2]."""
        return left_out(fit.residual, fit.slopes[:, fit.free], self.blocks, fit.free[:8].sum())

    def single(self, term):
        """The fit of a term, from the start that leads where the base fit's residual points; None where it has no trace."""
        if term not in self.singles:
            plain, best = self.fitter.whitened((), self.base.x), None
            for start in term.starts():
                near = self.fitter.whitened([term], np.concatenate([self.base.x, start]))
                if near is not None and np.abs(near - plain).max() > TRACE:
                    gain = (near - plain) @ self.base.residual / np.linalg.norm(near - plain)
                    best = max(best or (-np.inf, ()), (gain, tuple(start)))
            start = None if best is None else np.concatenate([self.base.x, best[1]])
            self.singles[term] = None if best is None else self.fitter.fit([term], start, self.base, self.held)
        return self.singles[term]

    def pair(self, terms):
        """The fit of two terms from where the better of them ended."""
        one, two = (self.single(t) for t in terms)
        if one is None or two is None:
            return None
        soil = min(one, two, key=lambda f: f.squares).x[:8]
        return self.fitter.fit(terms, np.concatenate([soil, one.x[8:], two.x[8:]]), self.base, self.held)

    def f_test(self, small, large):
        """p of the F-test of a fit against one with fewer parameters."""
        more = large.free.sum() - small.free.sum()
        spare = len(large.residual) + 8 - large.free.sum()
        if more <= 0 or spare <= 0 or large.squares >= small.squares:
            return 1.0
        return float(stats.f.sf((small.squares - large.squares) / more / (large.squares / spare), more, spare))


def clean_regime(half):
    """The fit to the half of the setpoints that one soil fits best, as its soil [sd] and the covariance of that."""
    fitter, fit = half.fitter, half.base
    seen = fitter.campaign.setpoint[fitter.cell_rows]
    chosen = None
    for _ in range(8):
        per_setpoint = {s: np.mean(fit_residual(fitter, fit)[seen == s] ** 2) for s in np.unique(seen)}
        best = sorted(per_setpoint, key=per_setpoint.get)[:max(3, (len(per_setpoint) + 1) // 2)]
        if best == chosen:
            break
        chosen = best
        part = Fitter(fitter.campaign, fitter.noise, np.flatnonzero(np.isin(fitter.campaign.setpoint, best)))
        fit = part.fit(start=fit.x) or fit
    return fit.x, np.linalg.inv(fit.slopes.T @ fit.slopes + np.eye(8))


def fit_residual(fitter, fit):
    """What a fit of other rows leaves of all of a fitter's cells [sd]."""
    f = fitter.whitened(fit.terms, fit.x)
    return fitter.target - f if f is not None else np.zeros(len(fitter.target))


def standing_out(half, residual, covariance, freedom):
    """Of each run the p-value of the mean residuals, by channel, of it and its nearest runs off a fit of known covariance."""
    fitter, slopes = half.fitter, half.base.slopes[:, :8]
    at = fitter.campaign.conditions()
    p = np.ones(len(at))
    for row in range(len(at)):
        near = np.argsort(np.sum((at - at[row]) ** 2, axis=1))[:NEAR]
        cells = np.isin(fitter.cell_rows, near)
        means = np.array([cells & (fitter.cell_channels == c) for c in range(4)], float)
        means = means[means.any(axis=1)]
        means /= means.sum(axis=1, keepdims=True)
        off, spread = means @ residual, means @ means.T + means @ slopes @ covariance @ slopes.T @ means.T
        p[row] = stats.f.sf(off @ np.linalg.solve(spread, off) / len(off), len(off), freedom)
    return p


def search(choice, test):
    """Terms that the catalogue is found to add, chosen on one half and tested on the other; none where none stands."""
    best = {}  # of each effect: hold-out error of its best form
    for term in CATALOGUE:
        fit = choice.single(term)
        if fit is not None:
            error = choice.hold_out(fit)
            if term.id not in best or error < best[term.id][0]:
                best[term.id] = (error, term)
    traces = {}
    for error, term in best.values():
        fit = choice.single(term)
        plain = choice.fitter.whitened((), fit.x[:8])
        if plain is not None:
            trace = choice.fitter.target - fit.residual - plain
            traces[term] = trace / max(1e-12, np.linalg.norm(trace))
    ranked = []
    for pair in itertools.combinations(traces, 2):
        columns = np.column_stack([choice.base.slopes, *(traces[t] for t in pair)])
        wanted = np.concatenate([choice.base.residual, -choice.base.x])
        size = np.linalg.lstsq(np.vstack([columns, np.eye(8, 10)]), wanted, rcond=1e-6)[0]
        ranked.append((left_out(choice.base.residual - columns @ size, columns, choice.blocks), pair))
    pairs = [(choice.pair(pair), pair) for _, pair in sorted(ranked, key=lambda r: r[0])[:PAIRS]]
    pairs = [(choice.hold_out(fit), pair) for fit, pair in pairs if fit is not None]

    def p_of(pair):
        both = test.pair(pair)
        return 1.0 if both is None else max(test.f_test(test.single(t), both) for t in pair)

    def p_single(term):
        fit = test.single(term)
        return 1.0 if fit is None else test.f_test(test.base, fit)

    found = [(error, (term,)) for error, term in best.values()]
    stands = list(discoveries([p_single(t[0]) for _, t in found])) + list(discoveries([p_of(pair) for _, pair in pairs]))
    standing = [c for c, s in zip(found + pairs, stands) if s]
    return min(standing, key=lambda c: c[0])[1] if standing else ()


def answer(folder, seed=1, held=False):
    """What the baseline says of a campaign."""
    start = time.monotonic()
    readings = Campaign(folder)
    noise, freedom = readings.noise(readings.predict(readings.declared))
    everything = np.unique(readings.setpoint)
    whole = Half(readings, noise, everything)
    noise, freedom = readings.noise(readings.predict(whole.fitter.soil(whole.base.x)))
    whole = Half(readings, noise, everything)
    clean, covariance = clean_regime(whole)
    residual = fit_residual(whole.fitter, Fit((), clean))
    p = standing_out(whole, residual, covariance, freedom)
    dealt = np.random.default_rng(seed).permutation(everything)
    halves = [Half(readings, noise, part, clean if held else None) for part in (dealt[::2], dealt[1::2])]
    terms = search(*halves) if all(h.base for h in halves) else ()
    fits = [whole.single(terms[0])] if len(terms) == 1 else [whole.pair(terms)] if terms else []
    final = fits[0] if fits and fits[0] else whole.base
    soil = whole.fitter.soil(final.x)
    return {"verdict": "effect_found" if final.terms else "unknown_effect" if discoveries(p).any() else "nothing_missing",
            "effects": [{"id": t.id, "form": t.form} for t in final.terms],
            "flagged": np.flatnonzero(discoveries(p, REGIONS)).tolist(),
            "changed": np.flatnonzero(changed(readings, soil, final.effects(), noise, LARGE)).tolist(),
            "soil": {key: {"value": float(a), "without": float(b), "clean": float(c)} for key, a, b, c in
                     zip(SOIL_KEYS, soil, whole.fitter.soil(whole.base.x), whole.fitter.soil(clean))},
            "seconds": time.monotonic() - start}


def wrong(truth, found):
    """Whether effects are named, and they are not those that nature hid."""
    return found["verdict"] == "effect_found" and measure.named(found) != set(truth["effects"])


def report(folder, truth, found, loop):
    """Both methods on the campaigns that both answered: names, alarms, soil, places."""
    names = [n for n in found if loop is None or "verdict" in loop.get(n, {})]
    sides = ([("loop", loop)] if loop else []) + [("baseline", found)]
    kinds = {kind: [n for n in names if truth[n]["kind"] == kind and truth[n]["effects"]] for kind in measure.KINDS}
    nulls = [n for n in names if truth[n]["verdict"] == "nothing_missing"]
    unknown = [n for n in names if truth[n]["verdict"] == "unknown_effect"]
    for side, answers in sides:
        print(f"{side}: {len(names)} campaigns, {measure.median([answers[n]['seconds'] for n in names]):.1f} s each (median)")
        for kind, cases in kinds.items():
            if cases:
                right = sum(measure.named(answers[n]) == set(truth[n]["effects"]) for n in cases)
                print(f"  {kind:9} names right {measure.interval(right, len(cases))}")
                print(f"  {kind:9} names wrong {measure.interval(sum(wrong(truth[n], answers[n]) for n in cases), len(cases))}")
        alarms = sum(answers[n]["verdict"] in ("effect_found", "unknown_effect") for n in nulls)
        print(f"  false alarms          {measure.interval(alarms, len(nulls))}")
        print(f"  unknown flagged       "
              f"{measure.interval(sum(answers[n]['verdict'] == 'unknown_effect' for n in unknown), len(unknown))}")
        told = {n: a if not loop or loop[n]["soil"] else {**a, "soil": {}} for n, a in answers.items()}  # soils side by side
        measure.report_soil_and_places([(truth[n], told[n], folder / n) for n in names])
    flags, declared, clean = Places(), SoilErrors(), SoilErrors()
    for n in names:
        record = nature_campaign.read(folder / n)
        if not record["effects"]:
            continue
        true = fails_at(record)
        flags.add(rows_of(found[n]["flagged"], len(true)), true)
        if not loop or loop[n]["soil"]:
            declared.add(record, record["declared"])
            clean.add(record, {key: v["clean"] for key, v in found[n]["soil"].items()})
    print("runs in flagged regions ", flags.words())
    print("soil as declared        ", declared.words())
    print("soil of clean regime    ", clean.words())


def self_test():
    """The steps on problems whose answer is known."""
    check = Checks()
    check.true("of p-values those on Benjamini and Hochberg's line and below stand",
               discoveries([0.04, 0.011, 0.9, 0.021, 0.3]).tolist() == [False, False, False, False, False]
               and discoveries([0.03, 0.01, 0.9, 0.02, 0.3]).tolist() == [True, True, False, True, False])
    rng = np.random.default_rng(5)
    slopes, prior = rng.normal(size=(12, 8)), np.eye(8)
    y = rng.normal(size=12)
    missed = 0.0
    for block in np.split(np.arange(12), 4):
        kept = np.setdiff1d(np.arange(12), block)
        x = np.linalg.solve(slopes[kept].T @ slopes[kept] + prior, slopes[kept].T @ y[kept])
        missed += np.sum((y[block] - slopes[block] @ x) ** 2)
    whole = np.linalg.solve(slopes.T @ slopes + prior, slopes.T @ y)
    quick = left_out(y - slopes @ whole, slopes, np.split(np.arange(12), 4))
    check.true(f"a setpoint left out by leverages {quick:.6f} and by fitting anew {missed:.6f}",
               abs(quick - missed) < 1e-6 * missed)
    with tempfile.TemporaryDirectory() as folder:
        for seed, kind, ids in ((25, "null_poor", []), (22, "one_poor", ["sensor_offset"])):
            record, _ = sets.draw("check", seed, 1, kind, ids)
            nature_campaign.write(Path(folder) / kind, record)
        readings = Campaign(Path(folder) / "one_poor")
        true = np.array([record["soil"][key] for key in SOIL_KEYS])
        nature = nature_campaign.restore(record).truth()
        channels = np.stack([nature[c] for c in CHANNELS], axis=1)
        gap = np.max(np.abs(readings.predict(true) - channels).max(axis=0) / np.maximum(np.abs(channels).max(axis=0), 1.0))
        check.true(f"soilbin and nature are one base model: channels within {gap:.0e} of their largest", gap < 1e-4)
        null, one = answer(Path(folder) / "null_poor"), answer(Path(folder) / "one_poor")
        check.true("nothing is named where nothing is missing", null["verdict"] != "effect_found")
        check.true("a zero that is off is named", [e["id"] for e in one["effects"]] == ["sensor_offset"])
        check.true("and so where it acts", set(one["changed"]) == set(np.flatnonzero(fails_at(record))))
    return check.status()


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("--loop", type=Path, help="answers of measure.py on the same set")
    parser.add_argument("--answers", type=Path, help="keep the baseline's answers in this file, and go on from it")
    parser.add_argument("--first", type=int, help="so many campaigns of the set")
    parser.add_argument("--hold-soil", action="store_true", help="search with the clean regime's soil, not with one refitted")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    truth = json.loads((options.folder / "truth.json").read_text())
    found = Kept(options.answers)
    for name in sorted(truth)[:options.first]:
        if name not in found:
            found.keep(name, answer(options.folder / name, held=options.hold_soil))
    report(options.folder, truth, found, json.loads(options.loop.read_text()) if options.loop else None)
    return 0


if __name__ == "__main__":
    sys.exit(main())
