"""What a full disk, a kill and a lost folder do to a run that is finished: its hours of work are never thrown away."""
import fcntl
import json
import os
import random
import signal
import subprocess
import time
import unittest

from attack import SOILBIN, Attack, files_in


class AFinishedRun(Attack):
    """Hours of work are never thrown away for an output that can't be written."""

    def rows(self, out):
        return json.loads(out)["rows"]

    def undisturbed(self):
        out, _ = self.expect(0, [], *self.grains(), environment={"SOILBIN_BEDS": str(self.folder / "other")})
        self.assertFalse([n for n in files_in(self.folder / "other") if n.startswith("run-")], "a finished run leaves none")
        return self.rows(out)

    def test_stays_where_a_table_meets_a_full_disk(self):
        right = self.undisturbed()
        out, _ = self.expect(1, ["/dev/full: can't write: No space left on device", "the same command goes on from there"],
                             *self.grains("--csv", "/dev/full"))
        self.assertEqual(self.rows(out), right, "the answer is printed all the same")
        self.assertTrue([n for n in files_in(self.beds) if n.startswith("run-")])
        out, _ = self.expect(0, "going on from", *self.grains("--csv", "table.csv"))
        self.assertEqual(self.rows(out), right)
        self.assertFalse([n for n in files_in(self.beds) if n.startswith("run-")], "now it is safe, and its restart gone")

    def test_stays_where_standard_output_is_full(self):
        with open("/dev/full", "w") as full:
            process = subprocess.run([SOILBIN, *map(str, self.grains())], stdout=full, stderr=subprocess.PIPE, text=True,
                                     env=self.environment(), cwd=self.here, check=False)
        self.assertEqual(process.returncode, 1)
        self.assertIn("the same command goes on from there", process.stderr)
        self.expect(0, "going on from", *self.grains())

    def under_way(self, *command):
        """The process, once its run has begun."""
        process = self.start(*command)
        end = time.monotonic() + 60
        while not list(self.beds.glob("run-*.lock")):
            self.assertIsNone(process.poll(), "it ended before it began to run")
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        return process

    def test_stays_where_the_folder_of_its_record_is_lost_meanwhile(self):
        right = self.undisturbed()
        command = self.grains("--record", "kept/record.json")
        process = self.under_way(*command)
        kept = self.here / "kept"
        kept.write_text("in the way")
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, err)
        self.assertIn("the same command goes on from there", err)
        kept.unlink()
        out, _ = self.expect(0, "going on from", *command)
        self.assertEqual(self.rows(out), right)
        self.assertEqual(len(json.loads((kept / "record.json").read_text())["runs"]), 1)
        self.assertFalse([n for n in files_in(self.beds) if n.startswith("run-")])

    def test_stays_where_it_is_killed_between_its_end_and_its_record(self):
        right = self.undisturbed()
        command = self.grains("--record", "record.json")
        lock = os.open(self.here, os.O_RDONLY)
        self.addCleanup(os.close, lock)
        fcntl.flock(lock, fcntl.LOCK_EX)  # the run ends, and waits to write
        process = self.start(*command)
        os.set_blocking(process.stderr.fileno(), True)
        while "waiting: another process is writing in" not in (line := process.stderr.readline()):
            self.assertTrue(line, "it ended without waiting")
        self.assertFalse((self.here / "record.json").exists())
        process.kill()
        process.communicate()
        fcntl.flock(lock, fcntl.LOCK_UN)
        out, _ = self.expect(0, "going on from", *command)
        self.assertEqual(self.rows(out), right)

    def test_a_wait_for_a_lock_ends_by_a_signal(self):
        lock = os.open(self.here, os.O_RDONLY)
        self.addCleanup(os.close, lock)
        fcntl.flock(lock, fcntl.LOCK_EX)
        process = self.start(*self.grains("--record", "record.json"))
        while "waiting" not in process.stderr.readline():
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=10)
        self.assertNotEqual(process.returncode, 0)

    def test_is_the_same_after_any_kills(self):
        right = self.undisturbed()
        command = self.grains("--record", "record.json")
        draw = random.Random(21)
        for _ in range(8):
            process = self.start(*command)
            time.sleep(draw.uniform(0.05, 1.5))
            process.kill()
            process.communicate()
        out, _ = self.expect(0, [], *command)
        self.assertEqual(self.rows(out), right)
        self.assertEqual([n for n in files_in(self.folder) if ".soilbin-" in n], [], "no temporary file stays")


if __name__ == "__main__":
    unittest.main(verbosity=1)
