#!/usr/bin/env python3
"""How often could any method name both effects of a pair? The oracle of ceiling.py, told that there are exactly two.

    ceiling_of_pairs.py SET [--posteriors FILE] [--first N] [--answers FILE]
    ceiling_of_pairs.py --self-test

SET: a folder made by `python3 -m nature --only two`, with its hidden .nature/. --answers: what `measure.py SET --answers FILE`
kept of the loop; then its misses are set beside the oracle's.

All pairs of nature's forms are screened with their linear traces about the fit of the base model, and about the fits of
the best single forms; the most promising pairs of each two effects are fitted over the soil's eight values and the two
sizes, and weighed by Laplace's evidence, with the priors that ceiling.py states. What screening misses makes the oracle
worse than it could be, so the ceiling is a lower bound: its own hits must come out as it expects.
"""
import argparse
import itertools
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import ceiling
from kept import Kept
from nature import campaign, sets
from nature.selftest import Checks

SHAPES = 8  # draws of a form's other constants
SINGLES = 8  # fits of single effects beside which a second one is looked for
PAIRS, VARIANTS = 24, 4  # two effects that are fitted, most promising first, and pairs of variants of each
STEPS = 12  # of a fit at the most


@dataclass(frozen=True)
class Variant:
    """A form of nature with its other constants and its sign; low, high: scales between which nature draws it."""
    name: str
    kind: type
    shape: dict
    sign: float
    log_prior: float
    low: float
    high: float

    def at(self, log_scale):
        """The form at a scale."""
        return self.kind(self.sign * np.exp(log_scale), self.shape)


def variants_of(oracle, rng):
    """Every form that these data could show, several draws of its constants each, with the scales that nature gives it."""
    found = []
    for name, kind, shape, sign, log_prior in ceiling.variants(oracle.world, rng, SHAPES):
        sized = oracle.scales(kind, shape, sign)
        if sized is not None:
            found.append(Variant(name, kind, shape, sign, log_prior, sized[0][0], sized[0][-1]))
    return found


@dataclass
class Fit:
    """Soil and ln scales of best fit: what they leave, and Laplace's ln evidence up to a constant of the campaign."""
    variants: tuple
    x: np.ndarray
    chi2: float
    log_evidence: float


class Pairs:
    """One campaign of two effects."""

    def __init__(self, record, rng):
        self.oracle = ceiling.Oracle(record)
        self.variants = variants_of(self.oracle, rng)

    def predict(self, variants, x):
        """Whitened channels at the soil x[:8] and the ln scales x[8:]; None where some run has no balance."""
        return self.oracle.predict(x[:8], *(v.at(s) for v, s in zip(variants, x[8:])))

    def jacobian(self, variants, x, middle):
        """Forward differences of the prediction; None where some run has no balance."""
        columns = []
        for i in range(len(x)):
            step = 0.05 if i < 8 else 0.03
            for h in (step, -step):
                end = self.predict(variants, x + h * np.eye(len(x))[i])
                if end is not None:
                    columns.append((end - middle) / h)
                    break
            else:
                return None
        return np.stack(columns, axis=1)

    def fit(self, variants, x):
        """Levenberg-Marquardt from x; None where it has no balance at the start."""
        o = self.oracle
        low = np.concatenate([o.least, [np.log(v.low) for v in variants]])
        high = np.concatenate([np.full(8, np.inf), [np.log(v.high) for v in variants]])
        x, damping = np.clip(x, low, high), 1e-3

        def cost(y):
            value = self.predict(variants, y)
            return (np.inf, None) if value is None else (float(np.sum((o.read - value) ** 2) + np.sum(y[:8] ** 2)), value)

        prior = np.diag([1.0] * 8 + [0.0] * len(variants))
        chi2, value = cost(x)
        if value is None:
            return None
        for _ in range(STEPS):
            columns = self.jacobian(variants, x, value)
            if columns is None:
                return None
            curvature, slope = columns.T @ columns + prior, columns.T @ (o.read - value) - prior @ x
            before = chi2
            for _ in range(6):
                trial = np.clip(x + np.linalg.solve(curvature + damping * np.diag(np.diag(curvature) + 1e-6), slope), low, high)
                better, there = cost(trial)
                if better < chi2:
                    x, chi2, value, damping = trial, better, there, 0.2 * damping
                    break
                damping *= 8
            if before - chi2 < 0.02:
                break
        width = high[8:] - low[8:]  # ln scales are uniform over their range: its variance as a weak prior of the curvature
        curvature = curvature + np.diag([0.0] * 8 + list(12 / np.maximum(width, 0.1) ** 2))
        evidence = -0.5 * chi2 - 0.5 * np.linalg.slogdet(curvature)[1] - np.sum(np.log(np.maximum(width, 0.1))) \
            + 0.5 * len(variants) * np.log(2 * np.pi) + sum(v.log_prior for v in variants)
        return Fit(variants, x, chi2, float(evidence))

    def traces(self, x, beside=()):
        """Each variant's change of the prediction at x, at the middle of its scales, beside others; 0 where there is no balance."""
        middle = self.predict(beside, x)
        changes = []
        for v in self.variants:
            value = self.predict((*beside, v), np.append(x, 0.5 * (np.log(v.low) + np.log(v.high))))
            changes.append(np.zeros_like(middle) if value is None else value - middle)
        return middle, np.array(changes)

    def off_soil(self, x, beside=()):
        """What the data leave at x and every variant's trace, both off what soil and the sizes of the others absorb."""
        middle, changes = self.traces(x, beside)
        columns = self.jacobian(beside, x, middle)
        if columns is None:
            return None
        rows = np.diag([1.0] * 8 + [0.0] * len(beside))[:8]
        basis = np.linalg.qr(np.vstack([columns, rows]))[0]
        left = np.concatenate([self.oracle.read - middle, -x[:8]])
        changes = np.hstack([changes, np.zeros((len(changes), 8))])
        return left - basis @ (basis.T @ left), changes - (changes @ basis) @ basis.T

    def start(self, x, multipliers, variants):
        """ln scales from multipliers of the middle scales, after x."""
        sizes = [0.5 * (np.log(v.low) + np.log(v.high)) + np.log(np.clip(m, 0.05, 10)) for v, m in zip(variants, multipliers)]
        return np.concatenate([x, sizes])

    def promising(self):
        """Pairs of variants with a start each, most promising first: {pair of names: [(gain, variants, start)]}."""
        names = np.array([v.name for v in self.variants])
        asked = {}

        def ask(gain, variants, x):
            asked.setdefault(frozenset(v.name for v in variants), []).append((gain, variants, x))

        u = self.oracle.points[-1][0]
        left, traces = self.off_soil(u)
        gram, seen = traces @ traces.T, traces @ left
        norm = np.maximum(np.diag(gram), 1e-9)
        first, second = np.triu_indices(len(names), 1)
        det = norm[first] * norm[second] - gram[first, second] ** 2
        a = (norm[second] * seen[first] - gram[first, second] * seen[second]) / np.maximum(det, 1e-9)
        b = (norm[first] * seen[second] - gram[first, second] * seen[first]) / np.maximum(det, 1e-9)
        good = (names[first] != names[second]) & (a > 0) & (b > 0) & (det > 1e-3 * norm[first] * norm[second])
        gain = np.where(good, a * seen[first] + b * seen[second], 0.0)
        for k in np.argsort(-gain)[:400]:
            if gain[k] > 0:
                pair = (self.variants[first[k]], self.variants[second[k]])
                ask(gain[k], pair, self.start(u, (a[k], b[k]), pair))
        base_chi2 = float(left @ left)
        single = np.where(seen > 0, seen ** 2 / norm, 0.0)
        fits = []
        for k in np.argsort(-single)[:4 * SINGLES]:
            if sum(f.variants[0].name == self.variants[k].name for f in fits) < 2:
                found = self.fit((self.variants[k],), self.start(u, [seen[k] / norm[k]], [self.variants[k]]))
                if found:
                    fits.append(found)
        for one in sorted(fits, key=lambda f: f.chi2)[:SINGLES]:
            beside = self.off_soil(one.x, one.variants)
            if beside is None:
                continue
            left, traces = beside
            norm, seen = np.maximum(np.sum(traces ** 2, axis=1), 1e-9), traces @ left
            gain = np.where((seen > 0) & (names != one.variants[0].name), seen ** 2 / norm, 0.0)
            for k in np.argsort(-gain)[:60]:
                pair = (one.variants[0], self.variants[k])
                if gain[k] > 0:
                    ask(base_chi2 - one.chi2 + gain[k], pair, self.start(one.x, [seen[k] / norm[k]], pair[1:]))
        return asked

    def posterior(self):
        """{'one + other': probability} over pairs of effects."""
        asked = self.promising()
        order = sorted(asked, key=lambda names: -max(gain for gain, _, _ in asked[names]))[:PAIRS]
        logs = {}
        for names in order:
            fits = [self.fit(variants, x) for _, variants, x in sorted(asked[names], key=lambda one: -one[0])[:VARIANTS]]
            fits = [f for f in fits if f]
            if fits:
                logs[" + ".join(sorted(names))] = float(np.logaddexp.reduce([f.log_evidence for f in fits]))
        if not logs:
            return {}
        total = np.logaddexp.reduce(list(logs.values()))
        return {n: round(float(np.exp(v - total)), 6) for n, v in sorted(logs.items(), key=lambda one: -one[1])}


def summary(cases, answers):
    """Ceiling, the oracle's hits, and what both say of the loop's misses. cases: {name: (truth, posterior)}."""
    tops = np.array([next(iter(p.values())) for _, p in cases.values()])
    hits = {name: next(iter(p)) == truth for name, (truth, p) in cases.items()}
    print(f"{len(cases)} campaigns: ceiling {100 * tops.mean():.1f} +- {100 * tops.std(ddof=1) / np.sqrt(len(tops)):.1f} %; hits "
          f"{sum(hits.values())}, expected {tops.sum():.1f} +- {np.sqrt(np.sum(tops * (1 - tops))):.1f}; truth fitted "
          f"{sum(t in p for t, p in cases.values())}")
    if not answers:
        return
    rows = {}
    for name, (truth, p) in cases.items():
        found = answers[name]
        wanted = set(truth.split(" + "))
        weighed = [s for s in found["details"]["sets"] if s["set_log_evidence"] is not None]
        best = max(weighed, key=lambda s: s["set_log_evidence"], default={"effects": []})
        named = {e["id"] for e in found["effects"]} if found["verdict"] == "effect_found" else set()
        row = ("both named" if named == wanted else "weighs most, told unknown" if set(best["effects"]) == wanted
               else "fitted, priced out" if any(set(s["effects"]) == wanted for s in weighed) else "never fitted")
        rows.setdefault(row, []).append((hits[name], p.get(truth, 0.0)))
    for row, found in sorted(rows.items()):
        print(f"  {row}: {len(found)}; the oracle names both in {sum(h for h, _ in found)}; its mean probability of the truth "
              f"{100 * np.mean([p for _, p in found]):.0f} %")


def self_test():
    """A pair that nobody could mistake is named, and its fit leaves noise."""
    check = Checks()
    record, truth = sets.draw("check", 33, 1, "two", ["sensor_offset", "slip_sinkage"])
    pairs = Pairs(record, np.random.default_rng(3))
    found = pairs.posterior()
    check.true("the probabilities sum to 1", abs(sum(found.values()) - 1) < 1e-4)
    wanted = " + ".join(sorted(truth["effects"]))
    check.true(f"{wanted} is named: {dict(itertools.islice(found.items(), 2))}", next(iter(found)) == wanted)
    return check.status()


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("--posteriors", type=Path, help="keep the posteriors in this file, and go on from it")
    parser.add_argument("--answers", type=Path, help="the loop's answers, as measure.py keeps them")
    parser.add_argument("--first", type=int, help="so many campaigns of the set")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test or not options.folder:
        return self_test()
    truth = json.loads((options.folder / "truth.json").read_text())
    kept = Kept(options.posteriors)
    cases = {}
    for name in [n for n in sorted(truth) if len(truth[n]["effects"]) == 2][:options.first]:
        if name not in kept:
            rng = np.random.default_rng([5, len(cases)])
            kept.keep(name, Pairs(campaign.read(options.folder / name), rng).posterior())
        if kept[name]:
            cases[name] = (" + ".join(sorted(truth[name]["effects"])), kept[name])
    summary(cases, json.loads(options.answers.read_text()) if options.answers else None)
    return 0


if __name__ == "__main__":
    sys.exit(main())
