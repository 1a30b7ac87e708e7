"""Does the suggested next test decide? Loop, make the runs that it asks for, loop again, three times.

Works on a copy of a set made by `python3 -m nature`; `nature --more` makes the runs. Counts the campaigns in which an effect
was found and that end with a single name, and with the right one.
"""
import argparse
import json
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import measure  # noqa: E402
from nature import campaign  # noqa: E402


def names(found):
    """Number of sets of effects that the answer can't tell apart; 0 unless an effect is found."""
    return len(found["ambiguity_set"]) if found.get("verdict") == "effect_found" else 0


def ask(found, folder, most):
    """Makes the suggested runs; the number made."""
    test = found.get("next_test")
    if not test:
        return 0
    runs = max(1, min(test["runs"], most))
    try:
        return len(campaign.more(folder, test["condition"], runs))
    except ValueError:  # the wheel would sink there: nature refuses, as a rig would
        return 0


def names_only(command, folder):
    """The loop's answer; as few folds as may be, for the names do not depend on the honest errors."""
    return measure.answer(command, folder, "--folds", "2")


def follow(command, folder, rounds, most):
    """The answers before and after each round, and the runs made."""
    answers, made = [names_only(command, folder)], 0
    for _ in range(rounds):
        if names(answers[-1]) < 2:
            break
        runs = ask(answers[-1], folder, most)
        if runs == 0:
            break
        made += runs
        answers.append(names_only(command, folder))
    return answers, made


def report(stories, rounds, most):
    """The shares, over campaigns with an effect found at first."""
    for kind in measure.KINDS:
        cases = [(t, a, m) for t, a, m in stories if t["kind"] == kind and names(a[0]) > 0]
        open_ones = [c for c in cases if names(c[1][0]) > 1]
        if not cases:
            continue
        single = lambda c: names(c[1][-1]) == 1  # noqa: E731
        right = lambda c: single(c) and measure.named(c[1][-1]) == set(c[0]["effects"])  # noqa: E731
        n, m = len(cases), len(open_ones)
        print(f"{kind}: {n} campaigns with an effect found, {m} of them with more than one name")
        print(f"  at most {rounds} suggestions of at most {most} runs; {sum(c[2] for c in open_ones) / max(1, m):.1f} runs made on average")
        print("  a single name at first          ", measure.interval(n - m, n))
        print("  a single name at the end        ", measure.interval(sum(map(single, cases)), n))
        print("  the right one alone at the end  ", measure.interval(sum(map(right, cases)), n))
        print("  of those with several, one name ", measure.interval(sum(map(single, open_ones)), m))
        print("  and the right one               ", measure.interval(sum(map(right, open_ones)), m))


def main():
    """Command line; exit 0 unless a campaign failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="made by: python3 -m nature --set report --seed 1 --count 200 --out FOLDER")
    parser.add_argument("--soilbin", default="build/release/soilbin")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--runs", type=int, default=3, help="most runs made for one suggestion")
    options = parser.parse_args()
    truth = json.loads((options.folder / "truth.json").read_text())
    with tempfile.TemporaryDirectory() as place:
        copy = Path(place) / "set"
        shutil.copytree(options.folder, copy)
        stories = [(truth[n],) + follow(options.soilbin, copy / n, options.rounds, options.runs)
                   for n in sorted(truth) if truth[n]["verdict"] == "effect_found"]
    report(stories, options.rounds, options.runs)
    failed = sum("error" in a[-1] and "verdict" not in a[-1] for _, a, _ in stories)
    if failed:
        print(f"{failed} campaigns failed", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
