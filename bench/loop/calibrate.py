#!/usr/bin/env python3
"""Accuracy against the share answered, and sets of candidates with a coverage that was calibrated (split conformal).

    calibrate.py --one SET [SET ...] --other SET [SET ...] [--coverage 0.95] [--figure FILE.svg]
    calibrate.py --self-test

SET: a folder with truth.json and answers.json (`measure.py SET --answers SET/answers.json`), of one kind or mixed.

Split conformal prediction (Vovk and others 2005): a rule has a scale q. For each of n calibration campaigns of a class
take the q at which the truth joins the set, and of these the ceil((n + 1) coverage)-th smallest. The set of a fresh
campaign like them then holds the truth with at least that probability. Each half is told by what was calibrated on the
other. The rules, where a set of effects stands b of ln evidence behind the best one:

    today     the loop's own set, nothing calibrated
    behind    b <= q
    growing   b <= q g (4 + 3 % of what the best one explains), g as in the loop; today's rule is q = 1
    share     sets by falling share of the evidence until the shares add up to q
"""
import argparse
import json
import math
import sys
from pathlib import Path

from measure import in_set, interval, named
from nature.selftest import Checks

CLASSES = (("rich, one effect", lambda t: t["kind"] == "one_rich"), ("poor, one effect", lambda t: t["kind"] == "one_poor"),
           ("two effects", lambda t: t["kind"] == "two"))
RULES = ("behind", "growing", "share")


def load(folders):
    """(truth, answer) of the campaigns that were answered."""
    cases = []
    for folder in folders:
        truth, answers = (json.loads((folder / name).read_text()) for name in ("truth.json", "answers.json"))
        cases += [(truth[n], answers[n]) for n in sorted(truth) if "verdict" in answers.get(n, {})]
    return cases


def best_of(answer):
    """Effects of the set that the loop sets first; none where it names no set."""
    return frozenset(answer["ambiguity_set"][0]["effects"]) if answer["ambiguity_set"] else None


def scores(answer):
    """{rule: {set: the least q at which it is told}} of an answer with sets."""
    details, best = answer["details"], best_of(answer)
    sets = {frozenset(s["effects"]): s for s in details["sets"] if s["set_log_evidence"] is not None}
    if best not in sets:
        return None
    top = sets[best]["set_log_evidence"]
    behind = {ids: max(0.0, top - s["set_log_evidence"]) for ids, s in sets.items()}
    wide = min(max(math.sqrt(200 / details["values"]), 1.0), 2.0)
    allowed = wide * (4 + 0.03 * max(0.0, top - details["log_evidence_base"]))
    above = {ids: sum(o["share"] for other, o in sets.items() if o["share"] > s["share"]) for ids, s in sets.items()}
    return {"behind": behind, "growing": {ids: b / allowed for ids, b in behind.items()}, "share": above}


def of_truth(case, rule):
    """Least q at which the truth is told; infinite where it was never weighed or no set is told."""
    found = scores(case[1])
    return found[rule].get(frozenset(case[0]["effects"]), math.inf) if found else math.inf


def quantile(values, coverage):
    """The ceil((n + 1) coverage)-th smallest; infinite where n is too small for that coverage."""
    rank = math.ceil((len(values) + 1) * coverage - 1e-9)
    return sorted(values)[rank - 1] if rank <= len(values) else math.inf


def told(answer, rule, q):
    """Number of sets that a rule tells."""
    found = scores(answer)
    return sum(s <= q for s in found[rule].values()) if found else 0


def mean(values):
    return sum(values) / max(1, len(values))


def conformal(one, other, coverage):
    """The table of rules, each half told by what was calibrated on the other; no set told counts as not covered."""
    for name, chosen in CLASSES:
        halves = [[c for c in cases if chosen(c[0])] for cases in (one, other)]
        every = halves[0] + halves[1]
        if not all(halves):
            continue
        weighed = sum(math.isfinite(of_truth(c, "behind")) for c in every)
        some = [c for c in every if c[1]["ambiguity_set"]]
        print(f"{name}: {len(every)} campaigns; the truth was fitted and weighed in {interval(weighed, len(every))}")
        print(f"  today    covers {interval(sum(in_set(t, a) for t, a in every), len(every))}, "
              f"mean size {mean([len(a['ambiguity_set']) for _, a in some]):.2f}")
        for rule in RULES:
            limits = [quantile([of_truth(c, rule) for c in half], coverage) for half in halves]
            if not all(map(math.isfinite, limits)):
                print(f"  {rule:8} no q reaches {100 * coverage:.0f} %: the truth is too seldom weighed")
                continue
            pairs = [(c, q) for half, q in zip(halves, reversed(limits)) for c in half]
            hits = sum(of_truth(c, rule) <= q for c, q in pairs)
            sizes = [told(c[1], rule, q) for c, q in pairs if c[1]["ambiguity_set"]]
            print(f"  {rule:8} q {limits[0]:.3g} and {limits[1]:.3g}: covers {interval(hits, len(every))}, mean size {mean(sizes):.2f}")


def labels(calibration, report, coverage):
    """'nothing' and 'unknown' as classes: in how many campaigns of each class each of them belongs to the set."""

    def nothing(answer):
        return answer["details"]["p_value"]

    def unknown(answer):  # after the named effects where there are any, else after the base fit
        details, named = answer["details"], bool(answer["ambiguity_set"])
        gain = details.get("residual_unnamed_gain" if named else "unnamed_gain") or 0.0
        p = details.get("lack_of_fit_p", [1.0, 1.0])[named]
        return max(gain, -math.log(max(p, 1e-12)))

    for label, verdict, score in (("nothing", "nothing_missing", nothing), ("unknown", "unknown_effect", unknown)):
        first = [score(a) for t, a in calibration if t["verdict"] == verdict]
        if not first:
            continue
        least = -quantile([-v for v in first], coverage)
        print(f"'{label}' belongs to the set where its score is at least {least:.3g} ({len(first)} to calibrate):")
        for kind in ("one_rich", "one_poor", "two", "unknown", "null_rich", "null_poor"):
            of_kind = [a for t, a in report if t["kind"] == kind]
            if of_kind:
                print(f"  {kind:9} {interval(sum(score(a) >= least for a in of_kind), len(of_kind))}")


def confidence(answer):
    """Share of the first set among those told, where one is named; else none."""
    return answer["ambiguity_set"][0]["weight"] if answer["verdict"] == "effect_found" and answer["ambiguity_set"] else None


def right(case):
    """Whether the names told are the truth."""
    return named(case[1]) == set(case[0]["effects"])


def curve(cases):
    """(share answered, share of the answered that is right, confidence) from the surest answer on."""
    answered = sorted(((confidence(a), right((t, a))) for t, a in cases if confidence(a) is not None), key=lambda x: -x[0])
    points, hits = [], 0
    for n, (sure, good) in enumerate(answered, start=1):
        hits += good
        if n == len(answered) or answered[n][0] < sure:
            points.append((n / len(cases), hits / n, sure))
    return points


def risk_coverage(cases):
    """The table of levels for each class and for all with one effect."""
    classes = CLASSES + (("one effect or unknown, as they come", lambda t: t["kind"] in ("one_rich", "one_poor", "unknown")),)
    for name, chosen in classes:
        some = [c for c in cases if chosen(c[0])]
        if not some:
            continue
        print(f"{name}: {len(some)} campaigns")
        for level in (0.0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99):
            answered = [c for c in some if confidence(c[1]) is not None and confidence(c[1]) >= level]
            if answered:
                print(f"  share of the first at least {100 * level:2.0f} %: answered {100 * len(answered) / len(some):3.0f} %, "
                      f"right {interval(sum(map(right, answered)), len(answered))}, mean share "
                      f"{100 * sum(confidence(a) for _, a in answered) / len(answered):.0f} %")


def figure(cases):
    """The curves as SVG: share answered to the right, share right upwards."""
    width, height, left, bottom = 520, 320, 60, 270
    x, y = lambda v: left + 430 * v, lambda v: bottom - 240 * v
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for v in (0, 0.25, 0.5, 0.75, 1):
        out.append(f'<path d="M{x(0)} {y(v):.0f}H{x(1)}M{x(v):.1f} {y(0)}V{y(1)}" stroke="#ddd"/><text x="{x(0) - 6}" y="{y(v) + 4:.0f}" '
                   f'text-anchor="end">{100 * v:.0f} %</text><text x="{x(v):.0f}" y="{y(0) + 16}" text-anchor="middle">{100 * v:.0f} %</text>')
    for i, ((name, chosen), colour) in enumerate(zip(CLASSES, ("#1b6ca8", "#c8641b", "#5a8f29"))):
        points = curve([c for c in cases if chosen(c[0])])
        if points:
            line = " ".join(f"{x(p):.1f},{y(q):.1f}" for p, q, _ in points)
            out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/><text x="{x(0.03)}" y="{y(0.22) + 18 * i:.0f}" '
                       f'fill="{colour}">{name}</text>')
    out.append(f'<text x="{x(0.5)}" y="{height - 14}" text-anchor="middle">share of the campaigns that is answered, the surest first</text>'
               f'<text x="16" y="{y(0.5)}" text-anchor="middle" transform="rotate(-90 16 {y(0.5)})">names right among the answered</text></svg>')
    return "\n".join(out) + "\n"


def self_test():
    """The conformal rank, a made answer, and coverage of a made score."""
    import random
    check = Checks()
    check.true("the 19th smallest of 19 at 95 %, none of 18", quantile(list(range(19)), 0.95) == 18 and quantile(list(range(18)), 0.95) == math.inf)
    draw = random.Random(5)
    hits = sum(draw.random() <= quantile([draw.random() for _ in range(39)], 0.9) for _ in range(4000))
    check.true(f"fresh draws are covered in {hits / 40:.1f} % (90)", abs(hits / 4000 - 0.9) < 0.02)
    answer = {"verdict": "effect_found", "effects": [{"id": "a"}],
              "ambiguity_set": [{"effects": ["a"], "weight": 0.8}, {"effects": ["b"], "weight": 0.2}],
              "details": {"values": 800, "log_evidence_base": -100.0,
                          "sets": [{"effects": [n], "set_log_evidence": e, "share": s} for n, e, s in (("a", 0, .8), ("b", -3.5, .2), ("c", -14, 0))]}}
    truth = {"kind": "one_rich", "effects": ["c"]}
    check.true("7 is allowed behind a set that explains 100, so 14 is twice that", of_truth((truth, answer), "growing") == 2.0)
    check.true("one set within 3, two within 4", told(answer, "behind", 3) == 1 and told(answer, "behind", 4) == 2)
    check.true("a truth that was not weighed is never covered", of_truth(({**truth, "effects": ["d"]}, answer), "share") == math.inf)
    cases = [({"kind": "one_rich", "effects": [n]}, answer) for n in "ab"]
    check.true("equal confidence is one point of the curve", curve(cases) == [(1.0, 0.5, 0.8)])
    return check.status()


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--one", nargs="+", type=Path, default=[], help="sets of one half")
    parser.add_argument("--other", nargs="+", type=Path, default=[], help="sets of the other half")
    parser.add_argument("--coverage", type=float, default=0.95)
    parser.add_argument("--figure", type=Path, help="draw accuracy against the share answered")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    one, other = load(options.one), load(options.other)
    risk_coverage(one + other)
    if one and other:
        conformal(one, other, options.coverage)
        labels(one, other, options.coverage)
    if options.figure:
        options.figure.write_text(figure(one + other))
    return 0


if __name__ == "__main__":
    sys.exit(main())
