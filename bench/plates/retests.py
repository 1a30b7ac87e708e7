#!/usr/bin/env python3
"""Do the errors of `soilbin plates` cover what re-tests scatter, and does a bed predict another one?

    bench/plates/retests.py build/release/soilbin

First table: some tests of a bed are fitted, one more test of each plate is held against the fit. For n, k_c and k_phi
(k where one size of plate was pressed, both at the n of the fitted tests) it prints the root mean square of how far the
others are off, that of the errors `between tests` that were told, and the ratio of the two: 1 is right, above 1 the
errors are too small. Second table: Cullinan sand; each density is left out and asked of the other two (`plates --by
--density`), as a soil file of these two beds would give it; and each re-test from the rest of its bed.
"""
import csv
import itertools
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

MEASURED = pathlib.Path(__file__).resolve().parents[2] / "cases/measured"


def rows(name, **only):
    with open(MEASURED / name, newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if all(row[key] == value for key, value in only.items())]


def tests_of(table, test, diameter):
    """{(test, plate's diameter in mm): [(sinkage in mm, pressure in kPa)]}"""
    tests = {}
    for row in table:
        sinkage = float(row["sinkage_m"]) * 1e3 if "sinkage_m" in row else float(row["sinkage_mm"])
        tests.setdefault((row[test], diameter(row)), []).append((sinkage, float(row["pressure_kPa"])))
    return tests


def beds():
    for box in ("large-box", "small-box"):
        yield f"CMU, {box}", tests_of(rows("plates/cmu-plates.csv", box=box), "test",
                                      lambda row: float(row["tool"][len("plate_d"):-len("mm")]))
    yield "GRC-1", tests_of(rows("plates/grc1-plates.csv"), "test_id", lambda row: 1e3 * float(row["plate_diameter_m"]))
    for name in ("1-loosest", "2-little"):
        yield f"Cullinan, {name}", cullinan(name)


def cullinan(preparation):
    return tests_of(rows("cullinan/plates.csv", preparation=preparation), "test",
                    lambda row: float(row["plate_diameter_mm"]))


def fit(soilbin, tests):
    """soilbin-plates/1, and the lines of the file that it read: (test, sinkage, pressure)."""
    lines = {}
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "plates.csv"
        text = "test,plate_diameter_mm,sinkage_mm,pressure_kPa\n"
        for (test, diameter), readings in tests.items():
            for sinkage, pressure in readings:
                text += f"{test},{diameter:.6g},{sinkage:.6g},{pressure:.6g}\n"
                lines[len(lines) + 2] = ((test, diameter), sinkage / 1e3, pressure * 1e3)
        path.write_text(text, encoding="utf-8")
        answer = subprocess.run([soilbin, "plates", path, "--json"], capture_output=True, text=True, check=False)
    if not answer.stdout.startswith("{"):
        raise SystemExit(answer.stderr)
    return json.loads(answer.stdout), lines


def sums(soilbin, tests):
    """What a test's loading curve tells: b, weighted means of ln z and ln p, sums of squares (Wong's weights p^2)."""
    answer, lines = fit(soilbin, tests)
    aside = {line for one in answer["set_aside"] for line in one["lines"]}
    found = {}
    for key in tests:
        readings = [(math.log(z), math.log(p), p * p) for line, (test, z, p) in lines.items()
                    if test == key and line not in aside and z > 0 and p > 0]
        weight = sum(w for _, _, w in readings)
        z0, p0 = (sum(r[2] * r[i] for r in readings) / weight for i in (0, 1))
        found[key] = {"u": 2e3 / key[1], "z": z0, "p": p0, "zz": sum(w * (z - z0) ** 2 for z, _, w in readings),
                      "zp": sum(w * (z - z0) * (p - p0) for z, p, w in readings)}
    return found


def moduli(found, keys, n):
    """k_c and k_phi of these tests at this n; of one size of plate 0 and k."""
    k = [math.exp(found[key]["p"] - n * found[key]["z"]) for key in keys]
    u = [found[key]["u"] for key in keys]
    mean_u, mean_k = sum(u) / len(u), sum(k) / len(k)
    spread = sum((x - mean_u) ** 2 for x in u)
    k_c = sum((x - mean_u) * y for x, y in zip(u, k)) / spread if spread > 0 else 0.0
    return k_c, mean_k - k_c * mean_u


def values(answer):
    modulus = answer["k_phi"] or answer["modulus"]
    return answer["exponent"], answer["k_c"], modulus


def retests(soilbin):
    print(f"{'bed':20} {'fitted':22} {'n':>5} {'k_c':>6} {'k_phi':>6}")
    for name, tests in beds():
        found = sums(soilbin, tests)
        sizes = {}
        for key in tests:
            sizes.setdefault(key[1], []).append(key)
        for label, share in (("one test of each plate", 0.0), ("half of the tests", 0.5)):
            chance, seen = random.Random(1), set()
            off, told = [0.0] * 3, [0.0] * 3
            for _ in range(300):
                fitted = frozenset(itertools.chain.from_iterable(
                    chance.sample(keys, max(1, math.ceil(share * len(keys)))) for keys in sizes.values()))
                if fitted in seen or len(seen) == 10:
                    continue
                seen.add(fitted)
                answer, _ = fit(soilbin, {key: tests[key] for key in tests if key in fitted})
                n, k_c, k_phi = values(answer)
                others = [[key for key in keys if key not in fitted] for keys in sizes.values()]
                for more in itertools.islice(itertools.product(*others), 6):
                    own_n = sum(found[key]["zp"] for key in more) / sum(found[key]["zz"] for key in more)
                    for i, (value, again) in enumerate(zip((n, k_c, k_phi),
                                                           (own_n, *moduli(found, more, n["value"])))):
                        if value is not None:
                            off[i] += (value["value"] - again) ** 2
                            told[i] += value["between_tests"] ** 2
            ratios = [f"{math.sqrt(a / b):.2f}" if b > 0 else "-" for a, b in zip(off, told)]
            print(f"{name:20} {label:22} {ratios[0]:>5} {ratios[1]:>6} {ratios[2]:>6}", flush=True)


def told(n, k, reference):
    """Pressure at a sinkage [m]: p [Pa] and the standard deviation of ln p, by values as a soil file has them."""
    return lambda z: (k["value"] * z ** n["value"],
                      math.hypot(k["std_error"] / k["value"], math.log(z / reference) * n["std_error"]))


def held(name, sinks, tests, depths=(5, 10, 20, 40, 79)):
    """Predicted pressure with its error, and what was measured, at some depths [mm]; sinks(z) gives p [Pa], sd of ln p."""
    cells = []
    for depth in depths:
        near = [p for _, p in sorted((abs(z - depth), p) for z, p in next(iter(tests.values())))[:3]]
        predicted, sd = sinks(depth / 1e3)
        measured = 1e3 * sorted(near)[1]
        cells.append(f"{measured / 1e3:.0f} | {predicted / 1e3:.0f} ± {100 * sd:.0f} % "
                     f"({math.log(measured / predicted) / sd:+.1f})")
    print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def by_beds(soilbin, beds, density):
    """Pressure at a density between or beyond beds, {density: tests}, by n and k as a soil file has them; None where
    soilbin refuses to tell."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "beds.csv"
        text = "bed,dry_density_kg/m^3,test,plate_diameter_mm,sinkage_mm,pressure_kPa\n"
        for rho, tests in beds.items():
            for (test, diameter), readings in tests.items():
                for sinkage, pressure in readings:
                    text += f"{rho},{rho},{test},{diameter:.6g},{sinkage:.6g},{pressure:.6g}\n"
        path.write_text(text, encoding="utf-8")
        answer = subprocess.run([soilbin, "plates", path, "--by", "bed", "--density", f"{density}kg/m^3", "--json"],
                                capture_output=True, text=True, check=False)
    if "out of reach" in answer.stderr:
        return None
    at = json.loads(answer.stdout)["at_density"]
    return told(at["exponent"], at["modulus"], at["reference_sinkage"])


def left_out(soilbin):
    print("\nmeasured | predicted ± told [kPa] (off, in told errors) at 5, 10, 20, 40 and 79 mm")
    density = {"3-medium": 1390, "4-high": 1511, "5-densest": 1538}
    for name, rho in density.items():
        sinks = by_beds(soilbin, {density[other]: cullinan(other) for other in density if other != name}, rho)
        if sinks is None:
            print(f"| {name} from the other two densities | out of reach |")
        else:
            held(f"{name} from the other two densities", sinks, cullinan(name))
    for name in ("1-loosest", "2-little"):
        tests = cullinan(name)
        for key in tests:
            rest, _ = fit(soilbin, {other: tests[other] for other in tests if other != key})
            held(f"{name}, test {key[0]} from its bed's others",
                 told(rest["exponent"], rest["modulus"], rest["reference_sinkage"]), {key: tests[key]})


if __name__ == "__main__":
    retests(sys.argv[1])
    left_out(sys.argv[1])
