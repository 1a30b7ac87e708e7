#!/usr/bin/env python3
"""How often could any method name the one effect that nature hid? An oracle that knows nature's equations answers.

    ceiling.py SET [SET ...] [--posteriors FILE] [--first N] [--unknown SHARE]
    ceiling.py --self-test

SET: a folder made by `python3 -m nature --only one_rich` (or one_poor), with its hidden .nature/. With --unknown, also
`--only unknown`: then the oracle knows nature's effects outside the catalogue too, as one more answer, `unknown`, of that
prior probability, and the question is how often any method could tell whether the catalogue has a name.

For each effect the oracle weighs nature's own forms, all equally likely, with the generator's prior on the effect's
size (ln of its ratio to the detectable size uniform over a wide range, held at the form's largest scale), draws of the form's
other constants, the declared priors of the soil's eight values, and the true noise law, which no method knows. The evidence
is Laplace's over the soil, a sum over sizes, and importance sampling for the forms that matter. The mean of the largest
posterior is the expected share of right names of the best possible method (after Ishida and others 2023, arXiv 2202.00395,
who estimate Bayes errors so): an estimate of the ceiling, since the oracle's hits must come out the same. It is told that
exactly one effect of the catalogue is there and what the forms' typical values are; the loop is told neither.

Not used: a campaign that was made for an effect varies what this effect needs. `hint` in the posteriors weighs with that too.
"""
import argparse
import json
import math
import sys
from pathlib import Path

import numpy as np
from scipy import stats

from kept import Kept
from nature import campaign, design, noise, sensitivity, sets
from nature import wheel as base
from nature.families import Form, build, catalogue, unknown
from nature.selftest import Checks

# Ratios to the detectable size, as sets.ratio_range but wider: nature takes them from a non-linear refit about the true
# soil, the oracle from the linearised one about the declared soil.
SIZES = (0.4, 12.0)
SHAPES = 16  # draws of a form's other constants
SAMPLES = 48  # importance samples of a form that matters
ENOUGH = 6.0  # effective samples below which Laplace's value stands
LOOK_AGAIN, MATTERS = 25.0, 6.0  # ln evidence behind the best form within which a form is relinearised, and sampled


def log_mean(logs):
    """ln of the mean of exp(logs)."""
    return float(np.logaddexp.reduce(logs) - np.log(len(logs)))


class Oracle:
    """One campaign: readings, whitener, declared soil, and the linearised fit of the base model."""

    def __init__(self, record, sizes=SIZES):
        self.sizes = np.linspace(*np.log(sizes), 25)
        self.world = world = campaign.restore(record)
        count = len(world.rows["load"])
        read = [record["read"].get(c, [None] * count) for c in base.CHANNELS]
        world.present = np.array([[column[i] is not None for column in read] for i in range(count)])
        truth = world.truth([build(e) for e in record["effects"]])
        world.white = noise.whitener(record["noise"], truth, world.present)
        self.declared, self.sd = record["declared"], record["sd"]
        self.read = sensitivity.whiten(world, {c: np.array([0.0 if v is None else v for v in column])
                                               for c, column in zip(base.CHANNELS, read)})
        self.least = np.array([0.05 * self.declared[k] / self.sd[k] for k in base.SOIL_KEYS])
        self.least -= np.array([self.declared[k] / self.sd[k] for k in base.SOIL_KEYS])
        world.guess = truth["entry"]
        u = np.zeros(8)
        for _ in range(4):
            predicted, columns = self.linear(u)
            if columns is None:
                break
            u = self.step(u, self.read - predicted, columns)[0]
        self.points = []  # the declared soil and the base fit: where first looks start
        for start in (np.zeros(8), u):
            predicted, columns = self.linear(start)
            if columns is not None:
                self.points.append((start, columns))
                if len(self.points) == 1:
                    self.start, self.predicted = start, predicted
                    self.basis = np.linalg.qr(np.vstack([columns, np.eye(8)]))[0]

    def predict(self, u, *forms):
        """Whitened channels at the soil u (sd from the declared one) with these forms, or None where some run has no balance."""
        u = np.maximum(u, self.least)
        soil = {**self.world.soil, **{k: self.declared[k] + u[i] * self.sd[k] for i, k in enumerate(base.SOIL_KEYS)}}
        out = self.world.truth(forms, soil)
        return sensitivity.whiten(self.world, out) if out["ok"].all() else None

    def linear(self, u, *forms):
        """Prediction at u and its derivatives by u; (None, None) where some run has no balance."""
        middle, step = self.predict(u, *forms), 0.05
        if middle is None:
            return None, None
        ends = [self.predict(u + step * e, *forms) for e in np.eye(8)]
        if any(end is None for end in ends):
            return None, None
        return middle, np.stack([(end - middle) / step for end in ends], axis=1)

    def step(self, u, gap, columns):
        """Best soil for the gap (readings less prediction at u), linearised: soil, chi2, Cholesky factor of the curvature."""
        factor = np.linalg.cholesky(columns.T @ columns + np.eye(8))
        du = np.linalg.solve(factor.T, np.linalg.solve(factor, columns.T @ gap - u))
        return u + du, float(np.sum((gap - columns @ du) ** 2) + np.sum((u + du) ** 2)), factor

    def ratio(self, change):
        """Size of a change of the prediction beyond what the soil absorbs, against the detectable one."""
        d = np.concatenate([change, np.zeros(8)])
        return sensitivity.ratio(d - self.basis @ (self.basis.T @ d))

    def scales(self, kind, shape, sign):
        """The form's scale at each of the sizes, and {scale: prediction} of those tried; None where it stays too small."""
        tried, sizes, (least, most) = {}, {}, np.exp(self.sizes[[0, -1]])

        def size(a):
            if a not in sizes:
                value = self.predict(self.start, kind(sign * a, shape))
                sizes[a] = math.inf if value is None else self.ratio(value - self.predicted)
                if value is not None:
                    tried[a] = value
            return sizes[a]

        low = high = 0.5 * kind.TYPICAL
        for _ in range(8):  # a scale below which nature makes none
            if size(low) <= least:
                break
            low *= float(np.clip(0.8 * least / size(low), 0.2, 0.8))
        for _ in range(12):  # and one above; some forms are nothing below a threshold
            if size(high) >= most or high >= kind.LARGEST:
                break
            high = min(high * float(np.clip(1.1 * most / max(size(high), 1e-9), 1.2, 2.0)), kind.LARGEST)
        for _ in range(8):  # no gap between neighbours wider than a factor of two in size
            known = sorted(a for a in sizes if low <= a <= high)
            gaps = [(a, b) for a, b in zip(known, known[1:])
                    if sizes[b] > least and sizes[a] < most and sizes[b] > 2 * sizes[a] and b > 1.02 * a]
            if not gaps:
                break
            size(math.sqrt(gaps[0][0] * gaps[0][1]))
        known = sorted(tried)
        ratios = np.maximum.accumulate([max(sizes[a], 1e-6) for a in known])
        if not known or ratios[-1] < least:
            return None
        ratios = ratios * (1 + 1e-9 * np.arange(len(known)))
        return np.exp(np.interp(self.sizes, np.log(ratios), np.log(known))), tried

    def profile(self, u, columns, scales, tried):
        """For every scale the best soil near u, ln evidence (up to a constant of the data), and the curvature's factor.

        tried: {scale: prediction at u}, between which predictions are interpolated.
        """
        if not tried:
            return None
        known = np.array(sorted(tried))
        values = np.array([tried[a] for a in known])
        logs, soils = np.full(len(scales), -np.inf), [u] * len(scales)
        factor = None
        for i, a in enumerate(scales):
            if a > known[-1] * 1.1:
                continue
            j = int(np.clip(np.searchsorted(known, a), 1, max(len(known) - 1, 1)))
            if len(known) == 1:
                value = values[0]
            else:
                t = (a - known[j - 1]) / max(known[j] - known[j - 1], 1e-300)
                value = values[j - 1] + t * (values[j] - values[j - 1])
            soils[i], chi2, factor = self.step(u, self.read - value, columns)
            logs[i] = -0.5 * chi2 - np.sum(np.log(np.diag(factor)))
        return None if factor is None else (logs, soils, factor)

    def first_look(self, kind, shape, sign):
        """ln evidence of a form about the declared soil or the base fit, with what a second look needs; None where the form can't be there."""
        sized = self.scales(kind, shape, sign)
        if sized is None:
            return None
        scales, tried = sized
        looks = [self.profile(self.points[0][0], self.points[0][1], scales, tried)]
        for u, columns in self.points[1:]:
            again = {a: self.predict(u, kind(sign * a, shape)) for a in np.unique(scales[::6])}
            looks.append(self.profile(u, columns, scales, {a: v for a, v in again.items() if v is not None}))
        looks = [look for look in looks if look]
        if not looks:
            return None
        found = max(looks, key=lambda look: log_mean(look[0]))
        return {"kind": kind, "shape": shape, "sign": sign, "scales": scales, "found": found, "log": log_mean(found[0])}

    def second_look(self, look):
        """The same about the form's own fit."""
        kind, shape, sign, scales = (look[k] for k in ("kind", "shape", "sign", "scales"))
        for _ in range(4):
            logs, soils, _ = look["found"]
            best = int(np.argmax(logs))
            u = np.maximum(soils[best], self.least)
            predicted, columns = self.linear(u, kind(sign * scales[best], shape))
            if columns is None:
                break
            near = scales[np.unique(np.clip(best + np.array([-24, -12, -6, -3, -1, 0, 1, 3, 6, 12, 24]), 0, len(scales) - 1))]
            tried = {a: self.predict(u, kind(sign * a, shape)) for a in np.unique(near)}
            found = self.profile(u, columns, scales, {a: v for a, v in tried.items() if v is not None})
            if found is None:
                break
            look["found"], look["log"] = found, log_mean(found[0])
        return look

    def sampled(self, look, rng):
        """ln evidence by importance sampling about the second look, and the effective number of samples."""
        logs, soils, factor = look["found"]
        share = np.exp(logs - np.logaddexp.reduce(logs))
        share = 0.9 * share + 0.1 / len(share)
        width, weights = 1.15, np.full(SAMPLES, -np.inf)
        for n in range(SAMPLES):
            i = int(rng.choice(len(share), p=share))
            z = rng.normal(size=8)
            u = soils[i] + width * np.linalg.solve(factor.T, z)
            value = self.predict(u, look["kind"](look["sign"] * look["scales"][i], look["shape"]))
            if value is None or np.any(u < self.least):
                continue
            chi2 = np.sum((self.read - value) ** 2) + np.sum(u ** 2)
            drawn = -0.5 * z @ z - 8 * np.log(width) + np.sum(np.log(np.diag(factor)))
            weights[n] = -0.5 * chi2 - np.log(len(share)) - np.log(share[i]) - drawn
        top = np.max(weights)
        if not np.isfinite(top):
            return look["log"], 0.0
        w = np.exp(weights - top)
        return float(top + np.log(np.mean(w))), float(w.sum() ** 2 / np.sum(w ** 2))


def variants(world, rng, shapes, outside=0.0):
    """(id, form's class, its other constants, sign, ln prior) of what these data could show: `shapes` draws of the constants.

    The effects of the catalogue are equally likely; `outside` is the probability of one that it lacks.
    """
    answers = dict(catalogue())
    known = len(answers)
    if outside > 0:
        answers["unknown"] = unknown()
    for name, kinds in answers.items():
        likely = np.log(outside if name == "unknown" else (1 - outside) / known)
        for kind in kinds:
            if not campaign.usable(world, kind):
                continue
            drawn = shapes if kind.draw.__func__ is not Form.draw.__func__ else 1
            signs = (1.0, -1.0) if kind.SIGNED else (1.0,)
            for _ in range(drawn):
                shape = kind.draw(rng, world.scale)
                for sign in signs:
                    yield name, kind, shape, sign, likely - np.log(len(kinds) * drawn * len(signs))


def hint(plan, kind):
    """ln of how much likelier this plan is where it was made for a form of this class: factors, side force, loads."""
    odds = 0.5 if plan["runs"] >= 40 else 0.22
    return sum(-np.log(odds * (0.6 if need == "transverse" else 1.0)) for need in kind.NEEDS if need in design.FACTORS)


def posterior(record, sizes=SIZES, seed=1, outside=0.0):
    """{id: probability} of one campaign without and with the plan's hint, and the least effective number of samples."""
    oracle, rng = Oracle(record, sizes), np.random.default_rng([seed, len(record["rows"]["load"])])
    looks = []  # (id, ln prior, look)
    for name, kind, shape, sign, prior in variants(oracle.world, rng, SHAPES, outside):
        look = oracle.first_look(kind, shape, sign)
        if look:
            looks.append((name, prior, look))
    if not looks:
        return None
    best = max(prior + look["log"] for _, prior, look in looks)
    for _, prior, look in looks:
        if prior + look["log"] > best - LOOK_AGAIN:
            oracle.second_look(look)
    best = max(prior + look["log"] for _, prior, look in looks)
    least = SAMPLES
    for _, prior, look in looks:
        if prior + look["log"] > best - MATTERS:
            value, effective = oracle.sampled(look, rng)
            if effective >= ENOUGH:
                look["log"] = value
            least = min(least, effective)
    answer = {}
    for key, weigh in (("posterior", 0.0), ("hint", 1.0)):
        logs = {}
        for name, prior, look in looks:
            value = prior + look["log"] + weigh * hint(record["plan"], look["kind"])
            logs[name] = np.logaddexp(logs.get(name, -np.inf), value)
        total = np.logaddexp.reduce(list(logs.values()))
        answer[key] = {name: round(float(np.exp(v - total)), 6) for name, v in sorted(logs.items(), key=lambda x: -x[1])}
    answer["effective"] = round(least, 1)
    return answer


def summary(cases, key):
    """Ceiling, its standard error, the oracle's hits, and a reliability table of (truth, answer) pairs."""
    first = [next(iter(a[key].items())) for _, a in cases]
    tops, hits = np.array([p for _, p in first]), np.array([t == name for (t, _), (name, _) in zip(cases, first)])
    n = len(cases)
    print(f"  {key}: ceiling {100 * tops.mean():.1f} % +- {100 * tops.std(ddof=1) / np.sqrt(n):.1f}; hits {hits.sum()} of {n}, "
          f"expected {tops.sum():.1f} +- {np.sqrt(np.sum(tops * (1 - tops))):.1f}")
    every = np.array([(p, name == t) for t, a in cases for name, p in a[key].items()])
    for low, high in ((0.02, 0.2), (0.2, 0.5), (0.5, 0.8), (0.8, 0.95), (0.95, 1.01)):
        chosen = every[(every[:, 0] >= low) & (every[:, 0] < high)]
        if len(chosen):
            print(f"    told {100 * low:.0f} - {100 * min(high, 1):.0f} %: {len(chosen)} effects, mean {100 * chosen[:, 0].mean():.0f} %, "
                  f"true {int(chosen[:, 1].sum())} ({100 * chosen[:, 1].mean():.0f} %)")


def power_without_equations(record, leftover, level=0.05):
    """How often a chi2 test that knows the noise sees a change of this size beyond the soil and every one or two effects.

    leftover: squared size of the change that none of them takes over [noise variances], as truth.json has it (lambda).
    """
    readings = sum(value is not None for column in record["read"].values() for value in column)
    free = readings - len(base.SOIL_KEYS)
    return float(stats.ncx2.sf(stats.chi2.isf(level, free), free, leftover))


def self_test():
    """The evidence of a problem whose answer is known: sampling and Laplace agree where the model is all but linear."""
    check = Checks()
    check.true("mean of logs", abs(log_mean(np.log([1.0, 3.0])) - np.log(2.0)) < 1e-12)
    record, truth = sets.draw("check", 21, 1, "one_rich", ["sensor_offset"])
    record["sd"] = {k: 0.02 * v for k, v in record["sd"].items()}  # so narrow that the soil acts linearly
    record["declared"] = {k: record["soil"][k] for k in base.SOIL_KEYS}
    oracle, rng = Oracle(record), np.random.default_rng([3])
    effect = record["effects"][0]
    kind = type(build(effect))
    look = oracle.second_look(oracle.first_look(kind, effect["shape"], np.sign(effect["a"])))
    by_samples, effective = oracle.sampled(look, rng)
    check.true(f"Laplace {look['log']:.2f} and sampling {by_samples:.2f} agree", abs(look["log"] - by_samples) < 0.5 and effective > 8)
    gap = oracle.read - oracle.predict(np.zeros(8), build(effect))
    cells = int(oracle.world.present.sum())
    check.true(f"the true soil and effect leave noise: chi2/N {gap @ gap / cells:.2f}", abs(gap @ gap / cells - 1) < 5 * np.sqrt(2 / cells))
    check.true("no change is seen as often as the level says", abs(power_without_equations(record, 0.0) - 0.05) < 1e-9)
    check.true("a large one always", power_without_equations(record, 1000.0) > 0.999)
    found = posterior(record)
    check.true("the posteriors sum to 1", all(abs(sum(found[k].values()) - 1) < 1e-4 for k in ("posterior", "hint")))
    check.true("an offset among known soils is named", next(iter(found["posterior"])) == truth["effects"][0])
    return check.status()


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--posteriors", type=Path, help="keep the posteriors in this file, and go on from it")
    parser.add_argument("--first", type=int, help="so many campaigns of each set")
    parser.add_argument("--sizes", nargs=2, type=float, default=SIZES, metavar=("LOW", "HIGH"),
                        help="ratios to the detectable size that an effect may have; 0.4 12")
    parser.add_argument("--unknown", type=float, default=0.0, metavar="SHARE",
                        help="prior probability of an effect that the catalogue lacks; 0")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    kept = Kept(options.posteriors)
    for folder in options.folders:
        truth = json.loads((folder / "truth.json").read_text())
        cases = []
        for name in sorted(truth)[:options.first]:
            key = f"{folder.name}/{name}"
            if key not in kept:
                kept.keep(key, posterior(campaign.read(folder / name), options.sizes, outside=options.unknown))
            if kept[key]:
                cases.append(((truth[name]["effects"] or ["unknown"])[0], kept[key]))
        print(f"{folder.name}: {len(cases)} campaigns")
        for key in ("posterior", "hint"):
            summary(cases, key)
        powers = [power_without_equations(campaign.read(folder / name), truth[name]["lambda"][0])
                  for name in sorted(truth)[:options.first] if truth[name]["verdict"] == "unknown_effect"]
        if powers:
            print(f"  a chi2 test that knows the noise, not the effect: {100 * np.mean(powers):.1f} % seen at level 5 %")
    return 0


if __name__ == "__main__":
    sys.exit(main())
