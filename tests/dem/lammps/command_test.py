"""soilbin run --engine lammps: records, flags that it has not, a process that dies, Ctrl-C and going on, damage.

Usage: command_test.py SOILBIN      with soilbin-lammps beside it; mpirun may start more processes than there are cores
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOILBIN = Path(sys.argv.pop(1)).resolve()
CASE = """format: soilbin-case/1
name: small-wheel
tire: {name: small, radius: 100 mm, width: 80 mm, lugs: {height: 8 mm, count: 12, thickness: 10 mm}}
soil:
  name: coarse
  granular:
    radius_min: 8 mm
    radius_max: 12 mm
    grain_density: 2500 kg/m^3
    youngs_modulus: 5 MPa
    poisson_ratio: 0.2
    rolling_resistance: elastic_plastic
    grain_grain: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1, cohesion: 5 kJ/m^3}
    grain_tire: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}
study: {models: [{model: dem}], conditions: {load: 20 N, slip: 30 %, speed: 0.3 m/s}}
"""
BIN = ("--bed-length 0.4m --bed-width 0.16m --bed-depth 0.08m --behind 0.12m --ahead 0.12m --lowering 0.1s "
       "--starting 0.05s").split()
LONG = ["--load", "25N", "--resting", "1.5s"]  # some seconds, so that a signal finds it at work
PATIENCE = 240  # seconds that anything may take


class Lammps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        (cls.folder / "small.yaml").write_text(CASE, encoding="utf-8")
        cls.environment = {**os.environ, "SOILBIN_BEDS": str(cls.folder / "beds"),
                           "SOILBIN_MPIRUN": "mpirun --allow-run-as-root --oversubscribe"}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def words(self, *flags):
        resting = [] if "--resting" in flags else ["--resting", "0.05s"]
        return [str(SOILBIN), "run", "small.yaml", "--model", "dem", *BIN, *resting, *flags]

    def run_it(self, *flags):
        return subprocess.run(self.words(*flags), cwd=self.folder, env=self.environment, text=True,
                              capture_output=True, timeout=PATIENCE, check=False)

    def start(self, *flags, logs="lammps-*/log.lammps"):
        """A run in LAMMPS that has begun to move grains; `logs` of what moves."""
        child = subprocess.Popen(self.words("--engine", "lammps", *flags), cwd=self.folder, env=self.environment,
                                 text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if any("run 1 pre no" in log.read_text(errors="replace") for log in self.logs(logs)):
                return child
            self.assertIsNone(child.poll(), "it ended before it moved anything")
            time.sleep(0.05)
        self.fail("it moved nothing")

    def logs(self, which="lammps-*/log.lammps"):
        return list((self.folder / "beds").glob(which))

    def workers(self):
        """Processes of soilbin-lammps on a folder of this test."""
        found = []
        for entry in Path("/proc").glob("[0-9]*"):
            try:
                command = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
            except OSError:
                continue
            if Path(command[0]).name == "soilbin-lammps" and str(self.folder) in command[1]:
                found.append(int(entry.name))
        return found

    def test_a_launcher_that_refuses_is_told_with_what_to_type(self):
        for flags, launcher, hint in ((["--ranks", "500"], "mpirun --allow-run-as-root", "--oversubscribe"),
                                      ([], "mpirun", "--allow-run-as-root")):
            if launcher == "mpirun" and os.geteuid() != 0:
                continue
            environment = {k: v for k, v in self.environment.items() if not k.startswith("OMPI_ALLOW")}
            done = subprocess.run(self.words("--engine", "lammps", *flags), cwd=self.folder, text=True,
                                  env={**environment, "SOILBIN_MPIRUN": launcher}, capture_output=True,
                                  timeout=PATIENCE, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("hint: ", done.stderr)
            self.assertIn(hint, done.stderr)

    def test_grains_of_several_spheres_are_refused(self):
        (self.folder / "rods.yaml").write_text(CASE.replace("  granular:", "  granular:\n    shape: two_spheres"),
                                               encoding="utf-8")
        words = [word.replace("small.yaml", "rods.yaml") for word in self.words("--engine", "lammps")]
        done = subprocess.run(words, cwd=self.folder, env=self.environment, text=True, capture_output=True,
                              timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("shape: sphere", done.stderr)

    def test_a_run_is_recorded_as_that_of_dem_lammps(self):
        done = self.run_it("--engine", "lammps", "--ranks", "2", "--record", "two.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("grains (LAMMPS)", done.stdout)
        self.assertIn("grain-steps/s", done.stderr)
        record = json.loads((self.folder / "two.json").read_text(encoding="utf-8"))
        self.assertEqual(record["model"], "dem-lammps")
        self.assertEqual(record["inputs"]["engine"], "lammps")
        self.assertEqual(len(record["runs"]), 1)
        self.assertEqual(self.logs(), [], "what is kept of a run goes when its answer is safe")
        engine = self.run_it("--record", "two.json")
        self.assertEqual(engine.returncode, 2)  # one record, one engine
        self.assertIn("engine", engine.stderr)

    def test_a_dry_run_counts_processes(self):
        def seconds(*flags):
            plan = self.run_it(*flags, "--dry-run", "--json")
            self.assertEqual(plan.returncode, 0, plan.stderr)
            answer = json.loads(plan.stdout)
            return answer["runs"][0]["seconds"], answer["seconds_a_bed"], answer["threads"]
        engine, bed, _ = seconds("--threads", "1")
        one, engines_bed, _ = seconds("--engine", "lammps")
        two, own_bed, ranks = seconds("--engine", "lammps", "--settled-by", "lammps", "--ranks", "2")
        self.assertEqual(ranks, 2)
        scatter = 2  # of a trial of a second, which is made anew each time
        for value, expected in ((one, 5 * engine), (two, 2.5 * engine), (engines_bed, bed), (own_bed, 2.5 * bed)):
            self.assertTrue(expected / scatter < value < expected * scatter, f"{value} s, not about {expected} s")

    def test_flags_that_lammps_has_not_are_refused(self):
        ranks = self.run_it("--ranks", "2")
        self.assertEqual(ranks.returncode, 2)
        self.assertIn("--engine lammps", ranks.stderr)
        replay = self.run_it("--engine", "lammps", "--record", "replay.json", "--replay", "motion.replay")
        self.assertEqual(replay.returncode, 2)
        self.assertIn("leave out --engine lammps, or --replay", replay.stderr)

    def test_a_bed_that_lammps_settles_is_kept_and_told_in_the_record(self):
        alone = self.run_it("--settled-by", "lammps")
        self.assertEqual(alone.returncode, 2)
        self.assertIn("--engine lammps", alone.stderr)
        child = self.start("--settled-by", "lammps", "--record", "own.json", logs="bed-*/log.lammps")
        child.send_signal(signal.SIGINT)  # while it settles
        child.communicate(timeout=PATIENCE)
        self.assertNotEqual(child.returncode, 0)
        self.assertEqual(list((self.folder / "beds").glob("bed-*/report.txt")), [])
        own = self.run_it("--engine", "lammps", "--settled-by", "lammps", "--record", "own.json")
        self.assertEqual(own.returncode, 0, own.stderr)
        record = json.loads((self.folder / "own.json").read_text(encoding="utf-8"))
        self.assertEqual(record["inputs"]["bed.settled_by"], "lammps")
        self.assertAlmostEqual(record["runs"][0]["bed"]["void_ratio"], 0.75, delta=0.15)
        [report] = (self.folder / "beds").glob("bed-*/report.txt")
        self.assertEqual(list((self.folder / "beds").glob("lammps-*")), [], "what is kept of the run is gone")
        before = report.stat().st_mtime_ns
        again = self.run_it("--engine", "lammps", "--settled-by", "lammps", "--ranks", "2", "--travel", "0.03m")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(report.stat().st_mtime_ns, before, "one bed carries several runs, on any number of processes")

    def test_a_process_that_dies_is_told_and_the_record_stays_whole(self):
        child = self.start("--ranks", "2", *LONG, "--record", "dead.json")
        os.kill(self.workers()[0], signal.SIGKILL)
        _, errors = child.communicate(timeout=PATIENCE)
        self.assertEqual(child.returncode, 1, errors)
        self.assertIn("soilbin-lammps ended without an answer, on 2 processes", errors)
        self.assertIn("signal 9", errors)
        if (self.folder / "dead.json").exists():
            self.assertEqual(json.loads((self.folder / "dead.json").read_text(encoding="utf-8"))["runs"], [])
        again = self.run_it("--engine", "lammps", "--ranks", "1", *LONG, "--record", "dead.json")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_stopped_it_goes_on_from_there_and_says_what_is_damaged(self):
        child = self.start(*LONG, "--record", "stopped.json")
        time.sleep(0.3)
        child.send_signal(signal.SIGINT)
        _, errors = child.communicate(timeout=PATIENCE)
        self.assertNotEqual(child.returncode, 0)
        self.assertIn("the same command goes on from there", errors)
        self.assertEqual(self.workers(), [])
        [state] = (self.folder / "beds").glob("lammps-*/state")
        whole = state.read_bytes()
        state.write_bytes(whole[:-10])
        damaged = self.run_it("--engine", "lammps", *LONG, "--record", "stopped.json")
        self.assertEqual(damaged.returncode, 2, damaged.stderr)
        self.assertIn(str(state), damaged.stderr)
        state.write_bytes(whole)
        again = self.run_it("--engine", "lammps", "--ranks", "2", *LONG, "--record", "stopped.json")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("going on from step", again.stderr)


if __name__ == "__main__":
    unittest.main()
