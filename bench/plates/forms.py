#!/usr/bin/env python3
"""Which pressure-sinkage form do the plates on Cullinan sand ask for? Needs scipy.

    bench/plates/forms.py build/release/soilbin

Per bed: root mean square of what each form misses, over the mean pressure, in the readings that it was fitted to; and,
where the bed has re-tests, in the test that was left out of the fit. Below it Schwarz's criterion (BIC) less that of
the best form, with the readings counted as N (1 - r)/(1 + r), r the correlation of neighbouring residuals: readings of
one curve are not independent. The forms, z in m:

- Bekker: k z^n. Of one size of plate Reece's is the same.
- limit: p_0 (1 - exp(-z/z_0)), as Kacigin and Guskov (1968) have it.
- two slopes: p_0 (1 - exp(-z/z_0)) + k z: firm until the bed gives way, then growing with depth.
- hard layer: k z^n - p_w ln(1 - z/z_w), the effect hard_layer:logarithmic.
- limit over hard layer: p_0 (1 - exp(-z/z_0)) - p_w ln(1 - z/z_w).
"""
import math
import sys

import numpy as np
from scipy.optimize import least_squares

import retests

PARAMETERS = {"Bekker": [(5, 15), (-3, 1.5)], "limit": [(5, 15), (-8, 0)],
              "two slopes": [(2, 15), (-8, 0), (5, 18)],
              "hard layer": [(5, 15), (-3, 1.5), (3, 15), (math.log(0.082), 1)],
              "limit over hard layer": [(2, 15), (-8, 0), (3, 15), (math.log(0.082), 1)]}


def pressure(form, log, z):
    v = np.exp(log)
    if form == "Bekker":
        return v[0] * z ** v[1]
    if form == "limit":
        return v[0] * -np.expm1(-z / v[1])
    if form == "two slopes":
        return v[0] * -np.expm1(-z / v[1]) + v[2] * z
    soft = v[0] * z ** v[1] if form == "hard layer" else v[0] * -np.expm1(-z / v[1])
    return soft - v[2] * np.log1p(-np.minimum(z / v[3], 0.98))


def fitted(form, z, p):
    low, high = np.array(PARAMETERS[form], float).T
    chance, best = np.random.default_rng(1), None
    for _ in range(12):
        start = low + (high - low) * chance.uniform(0.05, 0.95, low.size)
        one = least_squares(lambda log: (pressure(form, log, z) - p) / p.mean(), start, bounds=(low, high))
        best = one if best is None or one.cost < best.cost else best
    return best.x


def curves(soilbin, preparation):
    """Of each test z [m] and p [Pa] on its loading curve, every millimetre."""
    found = []
    for key, readings in retests.cullinan(preparation).items():
        answer, lines = retests.fit(soilbin, {key: readings})
        aside = {line for one in answer["set_aside"] for line in one["lines"]}
        z, p = np.array([(z, p) for line, (_, z, p) in lines.items() if line not in aside and z > 0 and p > 0]).T
        order = np.argsort(z)
        grid = np.arange(1e-3, z.max(), 1e-3)
        found.append((grid, np.interp(grid, z[order], p[order])))
    return found


def main(soilbin):
    for name in ("1-loosest", "2-little", "3-medium", "4-high", "5-densest"):
        tests = curves(soilbin, name)
        z, p = (np.concatenate(part) for part in zip(*tests))
        told = {}
        for form, limits in PARAMETERS.items():
            misses = [(pressure(form, fitted(form, z, p), one) - two) / p.mean() for one, two in tests]
            rest = np.concatenate(misses)
            near = np.concatenate([one[:-1] * one[1:] for one in misses]).sum() / (rest ** 2).sum()
            near = min(max(near, 0.0), 0.99)
            counted = max(rest.size * (1 - near) / (1 + near), 5.0)

            left = []
            for i in range(len(tests) if len(tests) > 1 else 0):
                others = [test for j, test in enumerate(tests) if j != i]
                log = fitted(form, *(np.concatenate(part) for part in zip(*others)))
                left.append(((pressure(form, log, tests[i][0]) - tests[i][1]) ** 2).mean() / tests[i][1].mean() ** 2)
            told[form] = (100 * math.sqrt((rest ** 2).mean()), 100 * math.sqrt(np.mean(left)) if left else None, counted,
                          (rest ** 2).mean(), len(limits))
        counted = np.median([one[2] for one in told.values()])  # one count for all, or the forms are not comparable
        bics = {form: counted * math.log(one[3]) + one[4] * math.log(counted) for form, one in told.items()}
        for form, (inside, outside, *_) in told.items():
            print(f"| {name} | {form} | {inside:.1f} | {'-' if outside is None else f'{outside:.1f}'} | "
                  f"{bics[form] - min(bics.values()):.1f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
