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


# What is refused, and how.
WRONG = ["estimatee", "estimate --sol dry-sand", "estimate --soil dry-snad --radius 1m --width 1m --load 1N --slip 1%",
         "estimate --soil dry-sand --radius 110mm", "estimate --soil dry-sand --tire rover-wheel --load 60 --slip 20%",
         "estimate --soil dry-sand --tire rover-wheel --load 60N --slip 20% --effect slip_sinkge",
         "estimate --soil dry-sand --tire rover-wheel --load 60N --slip 20% --effect slip_sinkage,b=1",
         "estimate --soil dry-sand --tire rover-wheel --load 60N --slip 20% --slip-by wheel", "run paper-straigt",
         "run paper-straight --model dme", "run paper-straight --shard 1/2", "run rover-climb", "drive rover-slip",
         "drive rover-climb --model grains", "compare paper-straight --model dme", "compare paper-straight --recorded nowhere",
         "compare paper-straight --effect slip_sinkage:lin", "limits --soil dry-sand --tire rover-wheel --load 60N --slip 1%",
         "predict cmu-smoot", "predict cmu-smooth --model paper-straight", "loop cmu-smooth --limit lod=1N..2N",
         "loop cmu-smooth --limit load=3N..2N", "design cmu-smooth --noise sinkag=1mm", "design cmu-smooth --effect slip_sinkge",
         "plates cases/measured/plates/cmu-plates.csv --only box", "plates nothing.csv", "list tyres", "schema cases",
         "check nothing", "record merg a b", "record show", "record missing paper-straight", "reproduce papers", "report",
         "sweep paper-straight", "sweep status nowhere", "bed paper-straight --packings 0", "verify --case sprng",
         "calibrate papr-sand", "calibrate paper-sand --contact tyre", "calibrate paper-sand --target friction_angle=31",
         "calibrate paper-sand --vary sliding_frction=0.2..0.8", "calibrate paper-sand --strength top",
         "calibrate paper-sand --decide ding2011-smooth --decide-at slop=1%..2%", "calibrate paper-sand --rolling elastic_plastik",
         "element-test direct-sheer paper-sand", "element-test repose dry-sand", "bevameter paper-sand --packings 0",
         "failure-map paper-longitudinal --load 2kN..8kN --lug-height 0mm..30mm --angle 0deg..15deg --slip 5%..50% --incline up",
         "campaign nothing.json --output {out}/told", "estimate --plot a.svg", "run paper-straight --plot a.gif"]
MAP = ("failure-map bench/dem_nature/studies/dem-lugs.yaml --incline longitudinal --load 40N..100N --lug-height 0mm..15mm "
       "--angle 0deg..15deg --slip 5%..40% --first 24 --boundary 8 --rounds 2 --check 5 --settling-friction 0.2 "
       "--bed-length 0.5m --behind 0.12m --ahead 0.12m --lowering 0.2s --resting 0.1s --starting 0.1s --tilting 0.2s --sleep 0 "
       "--store bench/dem_nature/failure_maps/dem-nature-longitudinal.json --stored")
PLATES = "plates cases/measured/plates/cmu-plates.csv --pressure 1kPa..30kPa"
LIMITS = "limits --soil dry-sand --tire rover-wheel --load 64.68N"
RECORD = "cases/studies/recorded/paper-smooth.json"


def every_command(quick):
    """Commands and flags that the questions below leave out, in the same form; each writes what it can write."""
    for text in ["list --json", "list studies", "list measured", "list soils --json", "list studies --json", "list effects --json",
                 "list measured --json", "schema", "schema tire", "schema soil", "schema campaign", "schema recorded", "manual",
                 "manual --markdown", "manual --bash-completion", "doctor", "doctor --json", "check cmu-smooth", "check rover-climb",
                 "check paper-straight --json", f"check {RECORD}", "check paper-sand", f"record show {RECORD}",
                 f"record missing paper-smooth {RECORD}", f"record merge {{out}}/merged.json {RECORD} {RECORD}",
                 "explain paper-straight --load 4kN --slip 20% --json", "explain paper-longitudinal --load 4kN --slip 20%",
                 f"{LIMITS} --csv {{out}}/limits.csv --plot {{out}}/limits.svg", f"{LIMITS} --json", "limits rover-slip --json",
                 f"{PLATES} --plot {{out}}/plates.svg", f"{PLATES} --json",
                 "drive rover-climb --samples 50 --csv {out}/drive.csv --plot {out}/drive.svg --report {out}/drive.html",
                 "drive rover-climb --samples 50 --json", "predict cmu-smooth --csv {out}/predict.csv --plot {out}/predict.svg",
                 "reproduce --report {out}/reproduce.html",
                 "report paper-straight rover-slip --measured made-lesson cmu-smooth --output {out}/report.html",
                 "run paper-straight --recorded --json", "run paper-transverse --recorded --output {out}/run-output",
                 "run paper-straight --recorded --load 4kN --slip 20%", "run paper-smooth --csv {out}/run.csv --plot {out}/run.svg",
                 "compare paper-smooth --recorded --markdown {out}/markdown --csv {out}/compare.csv --no-loop",
                 f"campaign {RECORD} --hide pass,bin --effect slip_sinkage --output {{out}}/told --soil paper-sand-virtual",
                 "calibrate paper-sand --contact tire --target board_angle=31.47deg --across 4 --packings 2 --threads 1 "
                 "--store {out}/store.json --ask 3 --batch {out}/batch.json",
                 "init {out}/first", "init {out}/second --campaign"]:
        yield text.replace("/", "_").replace("{out}", "OUT")[:100], text.split()
    for text in WRONG:
        yield "wrong-" + text.replace("/", "_").replace("{out}", "OUT")[:100], text.split()
    if quick:
        return
    for flags in ["", "--json", "--show-rows --report {out}/map.html"]:
        yield f"map{flags[:8]}", f"{MAP} {flags}".split()
    for flags in ["--csv {out}/design.csv", "--json"]:
        yield f"design{flags[:6]}", f"design cmu-smooth --runs 12 --limit load=50N..90N {flags}".split()
    for campaign in ["cmu-smooth", "ding2011-smooth"]:
        yield f"details-{campaign}", ["loop", campaign, "--json", "--details"]
        yield f"next-{campaign}", ["loop", campaign, "--next", "--limit", "slip=0%..80%"]
    board = "calibrate paper-sand --contact tire --target board_angle=31.47deg --rolling elastic_plastic --across 4 --packings 2"
    for flags in ["--show-runs", "--json --output {out}/calibrated.yaml"]:
        yield f"calibrate{flags[:6]}", f"{board} --threads 1 --runs 10 --store {{out}}/board{len(flags)}.json {flags}".split()
    for test in ["repose", "tilting-board", "direct-shear", "triaxial"]:
        yield f"element-{test}", f"element-test {test} paper-sand --size 0.4 --threads 1 --plot {{out}}/{test}.svg --json".split()


def questions(quick, campaigns):
    """(name of the answer, arguments); `{out}` stands for the folder of answers."""
    yield from every_command(quick)
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
    environment = {**os.environ, "SOILBIN_BEDS": str(out.resolve() / "beds"), "XDG_CACHE_HOME": str(out.resolve() / "beds"),
                   "LC_ALL": "C.UTF-8"}

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
    text = re.sub(r"^[ 0-9]+ %  \d+ of \d+, .*\n", "", text, flags=re.M)  # how far it is, where it took ten seconds
    text = re.sub(r"soilbin 0\.[0-9.]+[^\n\"<]*", "soilbin #", text)
    return re.sub(r"\b[0-9.]+ (?:min|s|seconds)\b(?= (?:of work|left|in all)|\)$)", "# s", text)


def differences(before, after):
    names = sorted({str(p.relative_to(folder)) for folder in (before, after) for p in folder.rglob("*")
                    if p.is_file() and "beds" not in p.parts})
    found = 0
    for name in names:
        missing = [str(folder / name) for folder in (before, after) if not (folder / name).is_file()]
        texts = [] if missing else [blanked((folder / name).read_text(encoding="utf-8", errors="replace"), folder)
                                    for folder in (before, after)]
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
