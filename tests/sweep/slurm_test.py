"""A sweep on a real Slurm: a shard is killed with -9, another one requeued, slurmctld killed and started again; the
merged record is, byte for byte but for seconds, the one that a single process writes.

Usage: slurm_test.py SOILBIN
"""
import json
import os
import re
import signal
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from slurm_cluster import Cluster, children_of

SOILBIN = os.path.abspath(sys.argv.pop(1))
ROOT = Path(__file__).resolve().parents[2]

# The wheel of dem-lugs on coarse soft grains: a run is a few seconds of one core.
CASE = """format: soilbin-case/1
name: lugs
tire: dem-nature-lugged.yaml
soil: fine-pebbles.yaml
study:
  models: [dem]
  conditions: {load: [20 N, 40 N], slip: [5 %, 20 %, 40 %], speed: 0.3 m/s}
"""
FLAGS = ["--bed-length", "0.7m", "--bed-width", "0.2m", "--bed-depth", "0.09m", "--behind", "0.15m", "--ahead", "0.15m",
         "--lowering", "0.2s", "--resting", "0.1s", "--starting", "0.1s", "--deepest-overlap", "1", "--packings", "2",
         "--half-step", "yes", "--threads", "1"]
SHARDS = 4


def but_for_seconds(file):
    return re.sub(r'"(seconds|seal)": ?("[^"]*"|[^,}]*)', r'"\1":0', Path(file).read_text())


class OnSlurm(unittest.TestCase):
    def setUp(self):
        self.began = time.monotonic()
        self.assertEqual(os.geteuid(), 0, "slurmd needs root")
        for program in ("munged", "mungekey", "slurmctld", "slurmd", "sbatch"):
            self.assertTrue(shutil.which(program), f"{program} is missing: packaging/debian-packages.txt lists its package")
        scratch = tempfile.TemporaryDirectory(prefix="soilbin-slurm-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.case = self.folder / "case.yaml"
        self.case.write_text(CASE)
        shutil.copy(ROOT / "bench/dem_nature/tires/dem-nature-lugged.yaml", self.folder)
        shutil.copy(ROOT / "tests/sweep/fine-pebbles.yaml", self.folder)
        self.sweep = self.folder / "sweep"

    def tell(self, words):
        print(f"{time.monotonic() - self.began:6.1f} s  {words}", flush=True)

    def soilbin(self, *words, statuses=(0,), **more):
        done = subprocess.run([SOILBIN, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=400, **more)
        self.assertIn(done.returncode, statuses, f"{words}: {done.stdout}{done.stderr}")
        return done.stdout

    def status(self):
        return json.loads(self.soilbin("sweep", "status", self.sweep, "--json", statuses=(0, 3),
                                       env=self.cluster.environment()))

    def shard_process(self, number):
        """Of the shard that is at work now, else None."""
        for pid, line in children_of(os.getpid()):
            if line.startswith(SOILBIN) and f"--shard {number}/{SHARDS} " in line:
                return pid
        return None

    def recorded(self, number):
        return self.status()["shards"][number - 1]["recorded"]

    def queue(self):
        """{"4_2": ("RUNNING", reason)} of what is not over."""
        lines = self.cluster.ask("squeue", "--noheader", "--array", "--format=%i|%T|%r").splitlines()
        return {job: (state, reason) for job, state, reason in (line.split("|") for line in lines)}

    def until_the_queue_is_empty(self, seconds):
        """Helps along what Slurm holds back: a requeued task waits two minutes, a lost one is held, and one that ended
        just before the controller died counts as running until its node is asked again, minutes later."""
        ghosts = {}

        def empty():
            queue = self.queue()
            for job, (state, reason) in queue.items():
                _, _, number = job.partition("_")
                if state == "RUNNING" and number and self.shard_process(int(number)) is None:
                    if time.monotonic() - ghosts.setdefault(job, time.monotonic()) > 5:
                        self.cluster.ask("scancel", job)
                    continue
                ghosts.pop(job, None)
                if reason == "BeginTime":
                    self.cluster.ask("scontrol", "update", f"jobid={job}", "starttime=now")
                elif "held" in reason.lower():
                    self.cluster.ask("scontrol", "release", job)
            return not queue and self.cluster.ask("sinfo", "-h")
        self.cluster.wait_for(empty, seconds, "an empty queue")

    def test_a_sweep_survives_kills_a_requeue_and_a_dead_controller(self):
        environment = os.environ | {"SOILBIN_BEDS": str(self.folder / "beds"), "OMP_WAIT_POLICY": "passive"}
        os.environ.update(environment)
        slurm = self.folder / "slurm"
        slurm.mkdir()
        with Cluster(slurm) as self.cluster:
            self.tell("Slurm runs")
            said = self.soilbin("sweep", self.case, *FLAGS, "--on", "slurm", "--shards", SHARDS, "--output", self.sweep,
                                "--submit", env=self.cluster.environment())
            self.assertIn("13 runs in 4 shards", said)
            self.assertIn("submitted", said)
            runs = (self.sweep / "jobs").read_text().split()[1]
            submitted = time.monotonic()

            victim = self.cluster.wait_for(lambda: self.shard_process(1), 120, "shard 1 at work")
            self.cluster.wait_for(lambda: self.recorded(1) >= 1, 120, "a run of shard 1")
            os.kill(victim, signal.SIGKILL)
            self.tell("shard 1 killed with -9")

            self.cluster.wait_for(lambda: self.shard_process(2) and self.recorded(2) >= 1, 120, "a run of shard 2")
            self.cluster.ask("scontrol", "requeue", f"{runs}_2")
            self.tell("shard 2 requeued")

            time.sleep(max(0.0, submitted + 12 - time.monotonic()))  # younger jobs are lost with it
            self.cluster.kill_control()
            self.tell("slurmctld killed with -9")
            time.sleep(1)
            self.cluster.start_control()
            self.until_the_queue_is_empty(120)
            states = {shard["shard"]: shard["state"] for shard in self.status()["shards"]}
            self.tell(f"the queue is empty: {states}")
            self.assertEqual(states[1], "failed")

            self.soilbin("sweep", "status", self.sweep, statuses=(3,), env=self.cluster.environment())
            subprocess.run(["bash", self.sweep / "sweep.sh"], env=self.cluster.environment(), check=True, timeout=60,
                           capture_output=True)
            self.until_the_queue_is_empty(120)
            self.tell("gone on with, to the end")
            self.assertIn("13 of 13 runs recorded",
                          self.soilbin("sweep", "status", self.sweep, env=self.cluster.environment()))
        self.soilbin("run", self.case, "--model", "dem", *FLAGS, "--record", self.folder / "one.json")
        self.tell("one process has made all of them")
        self.assertEqual(but_for_seconds(self.sweep / "record.json"), but_for_seconds(self.folder / "one.json"))
        self.assertEqual(children_of(os.getpid()), [], "nothing is left")


if __name__ == "__main__":
    unittest.main(verbosity=1)
