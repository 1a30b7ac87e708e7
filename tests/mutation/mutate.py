#!/usr/bin/python3
"""Breaks one line at a time and sees whether a test notices.

    tests/mutation/mutate.py [--only FOLDER] [--count N] [--seed N] [--scratch DIR]

Draws lines of code by the seed, breaks each by one small change (a sign, a comparison, a constant, a condition, a
statement left out, a value not returned), builds the test program of that folder and runs its tests. A mutant that a
test or the compiler notices is killed; one that nothing notices is either equivalent to the code (equivalent.txt says
which and why) or shows a test that is missing. The work is done in a copy of the tree under --scratch; the checkout is
only read. What was tried is kept there in results.jsonl and not tried again: a run that was stopped goes on.
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EQUIVALENT = pathlib.Path(__file__).with_name("equivalent.txt")

# What is broken, the program that should notice, and those of its tests that look at it within half a minute.
FLOORS = {
    "bekker_wong": ("bekker_wong_tests", "-Slow*"),
    "compare/fit": ("compare_tests", "-Slow*"),
    "compare/attribution": ("compare_tests", "-Slow*"),
    "compare/test_design": ("compare_tests", "-Slow*"),
    "compare/loop": ("compare_tests", "-Slow*"),
    "dem/rig": ("dem_tests",
                "WheelResult*:SteadyDrive*:WheelMotion*:TreadForces*:SlowSmallWheel*:Rut*:SoilFlow*:StepCriteria*:"
                "SlowRigOutputs*:AutocorrelationTime*:MeanWithError*:EndOfStartUp*:DriftOverError*:*FreeDrive*:"
                "SlowRigResume.ADamaged*:SlowRigResume.OfTwo*:SlowRigResume.ADriveWithoutAnAnswer*-*ArrivesToTheStep*"),
}

NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*(?:e[+-]?\d+)?)(?![\w.])")
SWAPS = [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" += ", " -= "), (" -= ", " += "), (" *= ", " /= "),
         (" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "), (" == ", " != "), (" != ", " == "),
         (" && ", " || "), (" || ", " && "), ("std::min(", "std::max("), ("std::max(", "std::min("),
         ("std::sin(", "std::cos("), ("std::cos(", "std::sin(")]


def scaled(number):
    """A constant that is clearly another one, of the same type."""
    if re.fullmatch(r"\d+", number):
        return str(int(number) + 1)
    return repr(float(f"{1.5 * float(number):.12g}")) if float(number) else "0.1"


def mutations(line):
    """(kind, broken line) for each way in which this line can be broken."""
    code = line.split("//")[0].rstrip("\n")
    stripped = code.strip()
    if not stripped or stripped.startswith(("#", "using", "namespace", "template", "static_assert", "}", "*", "/")):
        return
    if '"' in code or "'" in code:  # a word that people read is not what is looked at here
        return
    for old, new in SWAPS:
        for at in (m.start() for m in re.finditer(re.escape(old), code)):
            yield f"{old.strip()} -> {new.strip()}", code[:at] + new + code[at + len(old):]
    for found in NUMBER.finditer(code):
        yield "constant", code[:found.start()] + scaled(found[1]) + code[found.end():]
    if found := re.match(r"(\s*(?:\} else )?(?:if|while) \()([^;]*)(\) ?(?:\{|[^()]*;)?)$", code):
        yield "condition negated", f"{found[1]}!({found[2]}){found[3]}"
    if found := re.match(r"(\s*(?:.*\) )?return )([^{].*);$", code):
        yield "nothing returned", f"{found[1]}{{}};"
    if found := re.search(r"(return |= |\()-(?=[\w(])", code):
        yield "sign", code[:found.end() - 1] + code[found.end():]
    if re.match(r"\s+[\w.>\[\]()*-]+ [-+*/]?= [^;]*;$", code) or re.match(r"\s+[\w.>:-]+\([^;]*\);$", code):
        yield "statement left out", re.match(r"\s*", code)[0] + ";"


def drawn(folder, count, seed):
    """`count` mutants of a folder: lines with equal chances, then one of the ways to break each."""
    lines = []
    for path in sorted((ROOT / folder).rglob("*.cpp")):
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n")):
            if ways := list(mutations(line)):
                lines.append((str(path.relative_to(ROOT)), number, line, ways))
    chance = random.Random(f"{seed} {folder}")
    for file, number, line, ways in chance.sample(lines, min(count, len(lines))):
        kind, broken = chance.choice(ways)
        yield {"file": file, "line": number + 1, "kind": kind, "old": line.strip(), "new": broken.strip(),
               "text": broken, "folder": folder}


def identity(mutant):
    return hashlib.sha256("\0".join((mutant["file"], mutant["old"], mutant["new"])).encode()).hexdigest()[:12]


def known_equivalents():
    """(file, old, new) -> why, from equivalent.txt: a block of four lines each, blank lines between."""
    known = {}
    for block in EQUIVALENT.read_text(encoding="utf-8").split("\n\n"):
        rows = [row for row in block.strip().split("\n") if row and not row.startswith("#")]
        if len(rows) >= 4:
            known[rows[0], rows[1].removeprefix("- "), rows[2].removeprefix("+ ")] = " ".join(rows[3:])
    return known


def copy_tree(tree):
    """Makes `tree` what the checkout is; a file that is the same keeps its time, so that nothing is built for it."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            capture_output=True).stdout.decode().split("\0")
    for name in filter(None, listed):
        source, target = ROOT / name, tree / name
        if not source.is_file():
            target.unlink(missing_ok=True)
        elif not target.is_file() or source.read_bytes() != target.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
            shutil.copymode(source, target)


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Workshop:
    """The copy of the tree, what is built in it and run from it."""

    def __init__(self, scratch, jobs):
        self.tree, self.jobs = scratch / "tree", jobs
        self.build = self.tree / "build" / "strict"
        copy_tree(self.tree)
        if not (self.build / "build.ninja").exists():
            subprocess.run(["cmake", "--preset", "strict"], cwd=self.tree, check=True, stdout=subprocess.DEVNULL)

    def builds(self, program):
        done = subprocess.run(["cmake", "--build", self.build, "--target", program, "-j", str(self.jobs)],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.told = done.stdout
        return done.returncode == 0

    def passes(self, program, tests, limit):
        """Whether the tests pass, within `limit` seconds of processor time: so an endless loop ends. One that waits for
        ever ends after 30 times that on the clock; other work on the machine may be in the way.
        """
        command = [self.build / program, f"--gtest_filter={tests}", "--gtest_fail_fast", "--gtest_brief=1"]
        self.told = ""
        around = {**os.environ, "OMP_WAIT_POLICY": "passive", "RC_PARAMS": "seed=1"}
        with tempfile.TemporaryDirectory() as folder:
            try:
                done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                      errors="replace", env=around, timeout=30 * limit,
                                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
            except subprocess.TimeoutExpired:
                return False
        self.told = done.stdout
        return done.returncode == 0

    def killer(self):
        """The test that failed."""
        found = re.search(r"\[  FAILED  \] ([\w./]+)", self.told)
        return found[1] if found else "crashed or did not end"


def judge(workshop, mutant, tests, limit):
    path = workshop.tree / mutant["file"]
    whole = path.read_bytes()
    lines = whole.decode().split("\n")
    lines[mutant["line"] - 1] = mutant["text"]
    program = FLOORS[mutant["folder"]][0]
    before = processor_time()
    try:
        path.write_text("\n".join(lines), encoding="utf-8")
        if not workshop.builds(program):
            mutant["result"] = "did not compile"
        elif workshop.passes(program, tests, limit):
            mutant["result"] = "survived"
        else:
            mutant["result"], mutant["by"] = "killed", workshop.killer()
    finally:
        path.write_bytes(whole)
    mutant["seconds"] = round(processor_time() - before, 1)


def told(mutant, known):
    result = mutant["result"]
    if result == "survived" and (why := known.get((mutant["file"], mutant["old"], mutant["new"]))):
        mutant["result"] = result = "equivalent"
        mutant["by"] = why
    print(f"{result:<15} {mutant['seconds']:7.1f} s  {mutant['file']}:{mutant['line']}  ({mutant['kind']})")
    if result in ("survived", "equivalent"):
        print(f"    - {mutant['old']}\n    + {mutant['new']}" + (f"\n    {mutant['by']}" if "by" in mutant else ""))
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=FLOORS, help="break lines of this folder alone")
    parser.add_argument("--count", type=int, default=14, help="mutants a folder (default 14)")
    parser.add_argument("--seed", type=int, default=1, help="of the draw (default 1)")
    parser.add_argument("--tests", help="a filter of GoogleTest in place of the folder's own")
    parser.add_argument("--again", action="store_true", help="try those once more that survived: a test was added")
    parser.add_argument("--jobs", type=int, default=2, help="compilers side by side (default 2)")
    parser.add_argument("--scratch", type=pathlib.Path, default=pathlib.Path(tempfile.gettempdir(), "soilbin-mutation"))
    asked = parser.parse_args()

    workshop = Workshop(asked.scratch.resolve(), asked.jobs)
    results, known = asked.scratch / "results.jsonl", known_equivalents()
    tried = {}
    if results.exists():
        tried = {identity(m): m for m in map(json.loads, results.read_text(encoding="utf-8").splitlines())}
    counts = {}
    for folder in [asked.only] if asked.only else FLOORS:
        program, tests = FLOORS[folder][0], asked.tests or FLOORS[folder][1]
        limit = None
        for mutant in drawn(folder, asked.count, asked.seed):
            earlier = tried.get(identity(mutant))
            if earlier and not (asked.again and earlier["result"] == "survived"):
                mutant = earlier
            else:
                if limit is None:  # the tests as they are: they pass, and say how long they take
                    if not workshop.builds(program):
                        sys.exit(f"{program} does not build:\n{workshop.told}")
                    before = processor_time()
                    if not workshop.passes(program, tests, 3600):
                        sys.exit(f"{program} fails as it is:\n{workshop.told}")
                    limit = int(30 + 4 * (processor_time() - before))
                judge(workshop, mutant, tests, limit)
                with results.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(mutant) + "\n")
            told(mutant, known)
            counts[mutant["result"]] = counts.get(mutant["result"], 0) + 1
    print(", ".join(f"{number} {result}" for result, number in sorted(counts.items())))
    return 1 if counts.get("survived") else 0


if __name__ == "__main__":
    sys.exit(main())
