#!/usr/bin/env python3
"""Proves that a redesign keeps behaviour: the same answers to the bit before and after.

    same_answers.py ask BINARY FOLDER [--quick] [--campaigns DIR...]   runs every command below, keeps what it answers
    same_answers.py differences BEFORE AFTER                           what differs, file by file; exit 1 where anything does

Ask once before the redesign begins, with the binary kept aside, and again after each step. `--campaigns` adds folders of
measured campaigns to those of the library. `--quick` leaves out what takes longer than seconds. What legitimately
changes from run to run is blanked before comparing: commit and version, seconds of work, folders of this machine.
"""
import argparse
import difflib
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CAMPAIGNS = ["cmu-smooth", "cmu-grousered", "made-lesson", "nasa", "ding2011-smooth", "ding2011-lugged"]
QUICK_CAMPAIGNS = ["made-lesson"]
STUDIES = ["paper-straight", "paper-longitudinal", "paper-transverse", "paper-horizontal", "paper-smooth"]
WHEEL = "--soil dry-sand --radius 110mm --width 100mm --load 80N --slip 20%".split()


def questions(quick, campaigns):
    """(name of the answer, arguments); `{out}` stands for the folder of answers."""
    for name, flags in [("plain", []), ("effects", ["--effect", "slip_sinkage", "--effect", "exit_angle"]),
                        ("slope", ["--longitudinal-incline", "5 deg", "--yaw", "10 deg"])]:
        yield f"estimate-{name}", ["estimate", *WHEEL, *flags]
        yield f"estimate-{name}.json", ["estimate", *WHEEL, *flags, "--json"]
    yield "explain", ["explain", *WHEEL]
    yield "list", ["list"]
    for what in ["effects", "soils", "tires"]:
        yield f"list-{what}", ["list", what]
    yield "reproduce", ["reproduce"]
    yield "reproduce.json", ["reproduce", "--json"]
    yield "verify.json", ["verify", "--json"] if not quick else ["verify", "--json", "--case", "spring"]
    for study in STUDIES[:1] if quick else STUDIES:
        for form, flags in [("", []), (".json", ["--json"])]:
            yield f"compare-{study}{form}", ["compare", study, "--recorded", *flags]
            yield f"run-{study}{form}", ["run", study, *flags]
        yield f"page-{study}", ["compare", study, "--recorded", "--report", f"{{out}}/compare-{study}.html"]
    yield "compare-effect", ["compare", "paper-straight", "--recorded", "--soil", "paper-sand-virtual", "--effect", "slip_sinkage"]
    yield "rover-slip", ["run", "rover-slip", "--csv", "{out}/rover-slip.csv", "--plot", "{out}/rover-slip.svg"]
    yield "limits", ["limits", "rover-slip"]
    yield "check", ["check", "paper-straight"]
    for name in QUICK_CAMPAIGNS if quick else CAMPAIGNS:
        yield f"predict-{name}.json", ["predict", name, "--json"]
        yield f"predict-{name}", ["predict", name, "--report", f"{{out}}/predict-{name}.html"]
        yield f"loop-{name}.json", ["loop", name, "--json", "--save-model", f"{{out}}/model-{name}.yaml"]
        yield f"loop-{name}", ["loop", name, "--report", f"{{out}}/loop-{name}.html"]
    for folder in campaigns:
        for campaign in sorted(p for p in Path(folder).iterdir() if (p / "campaign.yaml").is_file()):
            yield f"loop-{campaign.name}.json", ["loop", str(campaign), "--json"]
    if not quick:
        yield "drive.json", ["run", "rover-climb", "--json"]
        yield "bevameter.json", ["bevameter", "paper-sand", "--json"]
        yield "grains.json", ["run", "bench/dem_nature/studies/dem-null.yaml", "--model", "dem", "--load", "70N", "--slip", "20%",
                              "--packings", "1", "--settling-friction", "0.2", "--bed-length", "0.5m", "--behind", "0.12m",
                              "--ahead", "0.12m", "--lowering", "0.2s", "--resting", "0.1s", "--starting", "0.1s", "--sleep", "0",
                              "--threads", "1", "--json", "--record", "{out}/grains-record.json"]


def ask(binary, out, quick, campaigns, jobs):
    out.mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, "SOILBIN_BEDS": str(out.resolve() / "beds"), "LC_ALL": "C.UTF-8"}

    def one(question):
        name, arguments = question
        arguments = [argument.replace("{out}", str(out)) for argument in arguments]
        done = subprocess.run([str(binary), *arguments], cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
        (out / name).write_text(done.stdout, encoding="utf-8")
        (out / f"{name}.errors").write_text(f"exit {done.returncode}\n{done.stderr}", encoding="utf-8")
        print(f"{name}: exit {done.returncode}", flush=True)

    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, questions(quick, campaigns)))


def blanked(text, folder):
    text = text.replace(str(folder), "FOLDER").replace(str(folder.resolve()), "FOLDER")
    text = re.sub(r'("(?:seconds|cpu_seconds|soilbin|commit|seal)": *)("[^"]*"|[-+.e0-9]+|\{[^}]*\})', r"\1#", text)
    text = re.sub(r"soilbin 0\.[0-9.]+[^\n\"<]*", "soilbin #", text)
    return re.sub(r"\b[0-9.]+ (?:min|s|seconds)\b(?= (?:of work|left|in all)|\)$)", "# s", text)


def differences(before, after):
    names = sorted({p.name for folder in (before, after) for p in folder.iterdir() if p.is_file()})
    found = 0
    for name in names:
        sides = [folder / name for folder in (before, after)]
        missing = [str(side) for side in sides if not side.is_file()]
        texts = [] if missing else [blanked(side.read_text(encoding="utf-8", errors="replace"), side.parent) for side in sides]
        if missing or texts[0] != texts[1]:
            found += 1
            print(f"{name}: {'missing ' + missing[0] if missing else 'differs'}")
            for line in list(difflib.unified_diff(*(t.splitlines() for t in texts), lineterm="", n=0))[2:8] if texts else []:
                print(f"    {line[:200]}")
    print(f"{len(names)} answers, {found} differ")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    asks = verbs.add_parser("ask")
    asks.add_argument("binary", type=Path)
    asks.add_argument("folder", type=Path)
    asks.add_argument("--quick", action="store_true")
    asks.add_argument("--campaigns", nargs="*", default=[])
    asks.add_argument("--jobs", type=int, default=1)
    compares = verbs.add_parser("differences")
    compares.add_argument("before", type=Path)
    compares.add_argument("after", type=Path)
    given = parser.parse_args()
    if given.verb == "ask":
        ask(given.binary.resolve(), given.folder, given.quick, given.campaigns, given.jobs)
        return 0
    return 1 if differences(given.before, given.after) else 0


if __name__ == "__main__":
    sys.exit(main())
