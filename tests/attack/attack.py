"""The scene of every attack: a folder with a small bed of pebbles, and the command run in it.

A file NAME_test.py beside this one is a subject; `python3 tests/attack/NAME_test.py SOILBIN [unittest's words]` runs it.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOILBIN = os.path.abspath(sys.argv.pop(1))
NOBODY = 65534

PEBBLES = (Path(__file__).resolve().parents[1] / "fixtures/pebbles.yaml").read_text(encoding="utf-8")
CASE = """format: soilbin-case/1
name: pebbles
tire: {radius: 150 mm, width: 100 mm}
soil: pebbles.yaml
study:
  models: [dem]
  conditions: {load: 60 N, slip: 20 %, speed: 0.6 m/s}
"""
BED = ["--bed-length", "1.2m", "--bed-width", "0.25m", "--bed-depth", "0.09m", "--threads", "1"]
# Four grains across, two boards, soft grains and the law that takes the longer step: an experiment is a third of a
# second of work.
BOARD = ["calibrate", "pebbles.yaml", "--contact", "tire", "--target", "board_angle=31.47deg", "--rolling",
         "elastic_plastic", "--across", "4", "--packings", "2", "--threads", "1", "--runs", "9", "--json"]
SMALL_TABLE = ["run", "rover-slip"]
SMALL_MAP = ["failure-map", "paper-longitudinal", "--soil", "paper-sand-virtual", "--load", "1N..2N", "--lug-height",
             "0mm..1mm", "--angle", "0deg..1deg", "--slip", "0%..1%"]


def limited(**limits):
    """What a child does before it runs: RLIMIT_<NAME> = value."""
    def apply():
        for name, value in limits.items():
            resource.setrlimit(getattr(resource, "RLIMIT_" + name), (value, value))
    return apply


def files_in(folder):
    """Names of all files below a folder, hidden ones too."""
    return sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*") if not path.is_dir())


class Attack(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="soilbin-attack-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.beds = self.folder / "beds"
        self.here = self.folder / "here"
        self.here.mkdir()
        (self.here / "pebbles.yaml").write_text(PEBBLES)
        self.case = self.here / "case.yaml"
        self.case.write_text(CASE)

    def environment(self, **more):
        return os.environ | {"SOILBIN_BEDS": str(self.beds), "XDG_CACHE_HOME": str(self.folder / "cache"),
                             "OMP_WAIT_POLICY": "passive"} | more

    def start(self, *words, **more):
        environment = self.environment(**more.pop("environment", {}))
        process = subprocess.Popen([SOILBIN, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env=environment, cwd=self.here, **more)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        """Nothing that a test started outlives it."""
        if process.poll() is None:
            process.kill()
            process.wait()
        for pipe in (process.stdout, process.stderr):
            pipe.close()

    def soilbin(self, *words, within=120, **more):
        process = self.start(*words, **more)
        try:
            out, err = process.communicate(timeout=within)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            self.fail(f"took longer than {within} s: {words}")
        return process.returncode, out, err

    @staticmethod
    def first_progress(process):
        """The first line of progress of a run in the soil bin; a note on coarse grains may stand before it."""
        while (line := process.stderr.readline()).startswith("note: the grains are coarse"):
            pass
        return line

    def grains(self, *more):
        """A run of the soil bin: a second or two."""
        return ["run", self.case, *BED, "--json", *more]

    def expect(self, status, words, *command, **more):
        """The command ends with this status and says these words; gives what it said in whole."""
        found, out, err = self.soilbin(*command, **more)
        self.assertEqual(found, status, f"{command}: {out}{err}")
        for one in [words] if isinstance(words, str) else words:
            self.assertIn(one, err)
        for internal in ("json.exception", "filesystem error", "stod", "terminate called", "std::"):
            self.assertNotIn(internal, err)
        return out, err

    @staticmethod
    def as_nobody():
        if os.geteuid() == 0:
            os.setgid(NOBODY)
            os.setuid(NOBODY)

    def skip_unless_nobody_can_run(self):
        """Another user can run the program and read the library here."""
        os.chmod(self.folder, 0o755)
        if os.geteuid() == 0 and subprocess.run([SOILBIN, "list", "soils"], preexec_fn=self.as_nobody, check=False,
                                                capture_output=True).returncode != 0:
            self.skipTest("another user can't run the program here")
