"""What a full disk, a killed process, a second one, a stranger's link and a damaged file do to soilbin: each test is the attack.

Usage: attack_test.py SOILBIN [unittest's words]
"""
import fcntl
import http.client
import json
import os
import random
import resource
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOILBIN = os.path.abspath(sys.argv.pop(1))
NOBODY = 65534

PEBBLES = """format: soilbin-soil/1
name: pebbles
source: chosen
granular:
  radius_min: 16 mm
  radius_max: 20 mm
  grain_density: 2500 kg/m^3
  youngs_modulus: 2 MPa
  poisson_ratio: 0.2
  grain_grain: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}
  grain_tire: {restitution: 0.4, sliding_friction: 0.5, rolling_friction: 0.1}
"""
CASE = """format: soilbin-case/1
name: pebbles
tire: {radius: 150 mm, width: 100 mm}
soil: pebbles.yaml
study:
  models: [dem]
  conditions: {load: 60 N, slip: 20 %, speed: 0.6 m/s}
"""
BED = ["--bed-length", "1.2m", "--bed-width", "0.25m", "--bed-depth", "0.09m", "--threads", "1"]
# Four grains across, two boards, the law that takes the longer step: an experiment is a second of work.
BOARD = ["calibrate", "paper-sand", "--contact", "tire", "--target", "board_angle=31.47deg", "--rolling",
         "elastic_plastic", "--across", "4", "--packings", "2", "--threads", "1", "--runs", "9", "--json"]
SMALL_TABLE = ["run", "rover-slip"]


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


class Outputs(Attack):
    """Every place is tried before the work; what fails after it costs nobody the answer."""

    PLACES = [[*SMALL_TABLE, "--csv"], [*SMALL_TABLE, "--plot"], [*SMALL_TABLE, "--output"],
              ["run", "paper-straight", "--model", "dem", "--record"], ["run", "paper-straight", "--model", "dem", "--replay"],
              ["drive", "rover-climb", "--plot"], ["drive", "rover-climb", "--csv"], ["drive", "rover-climb", "--report"],
              ["loop", "cmu-smooth", "--report"], ["loop", "cmu-smooth", "--save-model"], ["predict", "cmu-smooth", "--plot"],
              ["compare", "paper-straight", "--recorded", "--report"], ["compare", "paper-straight", "--csv"],
              ["compare", "paper-straight", "--markdown"], ["report", "rover-slip", "--output"], ["reproduce", "--report"],
              ["element-test", "repose", "paper-sand", "--plot"], ["bevameter", "paper-sand", "--output"],
              ["calibrate", "paper-sand", "--store"], ["calibrate", "paper-sand", "--output"],
              ["failure-map", "dem-lugs", "--load", "1N..2N", "--lug-height", "0mm..1mm", "--angle", "0deg..1deg", "--slip",
               "0%..1%", "--report"],
              ["failure-map", "dem-lugs", "--load", "1N..2N", "--lug-height", "0mm..1mm", "--angle", "0deg..1deg", "--slip",
               "0%..1%", "--store"]]

    def test_a_place_that_takes_no_file_is_refused_before_any_work(self):
        (self.here / "file").write_text("in the way")
        for words in self.PLACES:
            with self.subTest(flag=" ".join(words)):
                before = files_in(self.here)
                out, _ = self.expect(2, "where a folder is to be", *words, "file/deep/x.svg", within=10)
                self.assertEqual(out, "")
                self.assertEqual(files_in(self.here), before)

    def test_where_one_may_not_write_too(self):
        if os.geteuid() == 0 and not self.nobody_can_run():
            self.skipTest("another user can't run the program here")
        locked = self.here / "locked"
        locked.mkdir(mode=0o555)
        for words in self.PLACES:
            with self.subTest(flag=" ".join(words)):
                self.expect(2, "you may write to", *words, "locked/x.svg", within=10, preexec_fn=self.as_nobody)

    def nobody_can_run(self):
        os.chmod(self.folder, 0o755)
        process = subprocess.run([SOILBIN, "--version"], preexec_fn=self.as_nobody, check=False, capture_output=True)
        listed = subprocess.run([SOILBIN, "list", "soils"], preexec_fn=self.as_nobody, check=False, capture_output=True)
        return process.returncode == 0 and listed.returncode == 0

    @staticmethod
    def as_nobody():
        if os.geteuid() == 0:
            os.setgid(NOBODY)
            os.setuid(NOBODY)

    def test_missing_folders_are_made_by_all_alike(self):
        for k, words in enumerate(([*SMALL_TABLE, "--csv"], [*SMALL_TABLE, "--plot"], ["report", "rover-slip", "--output"],
                                   ["predict", "cmu-smooth", "--plot"], ["compare", "rover-slip", "--no-loop", "--report"])):
            place = self.here / f"new{k}" / "deep" / "x.svg"
            self.expect(0, [], *words, place)
            self.assertGreater(place.stat().st_size, 100)

    def test_a_drawing_is_what_its_ending_says(self):
        begins = {"svg": b"<?xml", "png": b"\x89PNG\r\n\x1a\n", "pdf": b"%PDF-"}
        for ending, begin in begins.items():
            self.expect(0, [], *SMALL_TABLE, "--plot", f"x.{ending}")
            self.assertTrue((self.here / f"x.{ending}").read_bytes().startswith(begin), ending)
        width, height = (int.from_bytes((self.here / "x.png").read_bytes()[at:at + 4], "big") for at in (16, 20))
        self.assertGreater(min(width, height), 400)
        self.assertIn(b"%%EOF", (self.here / "x.pdf").read_bytes()[-16:])
        for name in ("x.jpg", "x", "x.svgz"):
            self.expect(2, ".svg, .png or .pdf", "run", "paper-straight", "--model", "dem", "--plot", name, within=10)
            self.assertFalse((self.here / name).exists())

    def test_a_file_that_grows_too_large_leaves_nothing_and_the_answer_is_printed(self):
        out, _ = self.expect(1, "File too large", *SMALL_TABLE, "--json", "--plot", "x.svg", preexec_fn=limited(FSIZE=2000))
        self.assertEqual(json.loads(out)["format"], "soilbin-run/1")
        self.assertEqual(files_in(self.here), ["case.yaml", "pebbles.yaml"])

    def test_a_hundred_kills_leave_whole_files_and_no_others(self):
        draw = random.Random(28)
        self.expect(0, [], *SMALL_TABLE, "--csv", "x.csv")
        right = (self.here / "x.csv").read_bytes()
        for _ in range(100):
            process = self.start(*SMALL_TABLE, "--csv", "x.csv", "--plot", "x.svg", "--output", "all")
            time.sleep(draw.uniform(0.0, 0.12))
            process.kill()
            process.communicate()
            self.assertEqual((self.here / "x.csv").read_bytes(), right)
        self.expect(0, [], *SMALL_TABLE, "--csv", "x.csv", "--plot", "x.svg", "--output", "all")
        self.assertLessEqual(set(files_in(self.here)), {"case.yaml", "pebbles.yaml", "x.csv", "x.svg", "all/case.yaml",
                                                        "all/results.csv", "all/results.json"})

    def test_a_file_keeps_its_permissions_and_a_link_stays_a_link(self):
        secret = self.here / "secret.csv"
        secret.write_text("old")
        secret.chmod(0o600)
        (self.here / "link.csv").symlink_to("secret.csv")
        self.expect(0, [], *SMALL_TABLE, "--csv", "link.csv")
        self.assertTrue((self.here / "link.csv").is_symlink())
        self.assertGreater(len(secret.read_text()), 100)
        self.assertEqual(stat.S_IMODE(secret.stat().st_mode), 0o600)

    def test_a_record_that_is_a_link_stays_one(self):
        (self.here / "far").mkdir()
        (self.here / "record.json").symlink_to("far/record.json")
        self.expect(0, [], *self.grains("--record", "record.json"))
        self.assertTrue((self.here / "record.json").is_symlink())
        self.assertEqual(json.loads((self.here / "far/record.json").read_text())["format"], "soilbin-recorded/1")


class TwoProcesses(Attack):
    def test_lose_no_experiment_of_one_store(self):
        both = [self.start(*BOARD, "--store", "two.json", "--seed", seed) for seed in (1, 2)]
        for process in both:
            _, err = process.communicate(timeout=240)
            self.assertIn(process.returncode, (0, 1), err)
        tests = json.loads((self.here / "two.json").read_text())["tests"]
        self.assertEqual(sum(len(test["experiments"]) for test in tests), 18)

    def test_settle_one_bed_side_by_side(self):
        all_of_them = [self.start(*self.grains("--slip", f"{10 + k}%")) for k in range(6)]
        for process in all_of_them:
            _, err = process.communicate(timeout=240)
            self.assertEqual(process.returncode, 0, err)
        self.assertEqual([name[:4] for name in files_in(self.beds)], ["bed-"], files_in(self.beds))


class TheStoreOfBeds(Attack):
    """It is shared, it may be full, and a stranger may have been there."""

    def test_a_full_disk_stops_no_run(self):
        right, _ = self.expect(0, [], *self.grains())
        self.beds = self.folder / "full"
        out, err = self.expect(0, ["warning: ", "File too large", "isn't kept"], *self.grains(),
                               preexec_fn=limited(FSIZE=20000))
        self.assertEqual(json.loads(out)["rows"], json.loads(right)["rows"])
        self.assertIn("goes on without", err)
        self.assertEqual(files_in(self.beds), [])

    def test_a_store_that_is_no_folder_stops_no_run(self):
        self.beds.write_text("in the way")
        self.expect(0, ["warning: ", "the bed isn't kept", "can't be gone on with"], *self.grains())

    def test_a_store_that_may_only_be_read_serves_its_bed(self):
        _, _ = self.expect(0, [], *self.grains())
        os.chmod(self.folder, 0o755)
        mode = self.beds.stat().st_mode
        self.beds.chmod(0o555)
        self.addCleanup(self.beds.chmod, mode)
        if os.geteuid() == 0 and subprocess.run([SOILBIN, "list", "soils"], preexec_fn=Outputs.as_nobody, check=False,
                                                capture_output=True).returncode != 0:
            self.skipTest("another user can't run the program here")
        _, err = self.expect(0, "can't be gone on with", *self.grains("--slip", "30%"), preexec_fn=Outputs.as_nobody)
        self.assertNotIn("the bed isn't kept", err)

    def test_a_strangers_links_lead_nowhere(self):
        self.expect(1, [], *self.grains("--csv", "/dev/full"))  # leaves the names of bed and run
        bed, run = (next(self.beds.glob(f"{kind}-*.h5")).name for kind in ("bed", "run"))
        shutil.rmtree(self.beds)
        self.beds.mkdir(mode=0o777)
        victim = self.folder / "victim"
        victim.write_text("precious")
        for name in (bed, f"{bed}.writing", f"{bed}.keeping", f"{run}.writing", f"{run}.keeping", f"{run}.lock",
                     f"{run}.stopped"):
            (self.beds / name).symlink_to(victim)
        absent = self.folder / "absent"
        (self.beds / f"{bed}.previous").symlink_to(absent)
        self.expect(0, [], *self.grains())
        self.assertEqual(victim.read_text(), "precious")
        self.assertFalse(absent.exists())
        self.assertFalse((self.beds / bed).is_symlink(), "the bed took the place of the link")


class DamagedFiles(Attack):
    def record(self):
        self.expect(0, [], *self.grains("--record", "record.json"))
        return self.here / "record.json"

    def test_no_flipped_bit_of_a_record_changes_an_answer(self):
        file = self.record()
        text = file.read_bytes()
        right = json.loads(self.expect(0, [], "run", self.case, "--json", "--recorded", file)[0])["rows"]
        draw = random.Random(26)
        refused = 0
        for _ in range(200):
            damaged = bytearray(text)
            damaged[draw.randrange(len(text))] ^= 1 << draw.randrange(8)
            (self.here / "damaged.json").write_bytes(damaged)
            status, out, err = self.soilbin("run", self.case, "--json", "--recorded", "damaged.json")
            self.assertIn(status, (0, 2), err)
            if status == 0:
                self.assertEqual(json.loads(out)["rows"], right)
            else:
                self.assertIn("damaged.json", err + out)
                refused += 1
        self.assertGreater(refused, 150)

    def test_an_answer_that_was_edited_is_refused(self):
        file = self.record()
        document = json.loads(file.read_text())
        document["runs"][0]["drawbar_pull"] += 1.0
        file.write_text(json.dumps(document))
        self.expect(2, ["record.json: runs[0]", "its seal doesn't fit", "hint"], "run", self.case, "--recorded", file)
        del document["runs"][0]["seal"]
        file.write_text(json.dumps(document))
        self.expect(2, ["record.json: runs[0]", "its seal is missing"], "run", self.case, "--recorded", file)

    def test_a_record_from_before_there_were_seals_is_read_and_that_is_said(self):
        file = self.record()
        document = json.loads(file.read_text())
        del document["seal"]
        for run in document["runs"]:
            del run["seal"]
        file.write_text(json.dumps(document))
        self.expect(0, "1 of its 1 runs carry no seal", "run", self.case, "--recorded", file)

    def test_depth_and_size_have_bounds_and_errors_name_the_place(self):
        stored = ["failure-map", "dem-lugs", "--load", "1N..2N", "--lug-height", "0mm..1mm", "--angle", "0deg..1deg",
                  "--slip", "0%..1%", "--stored", "--store"]
        readers = {"record": ["run", "paper-straight", "--recorded"], "store": stored,
                   "replay": ["compare", "paper-straight", "--no-loop", "--replay"],
                   "campaign of a record": ["campaign", "--output", "told"]}
        bounded = limited(AS=3 << 30)
        for reader, words in readers.items():
            with self.subTest(reader=reader):
                (self.here / "deep").write_text('{"format": ' + "[" * 100000 + "\n")
                self.expect(2, ["deep:1:", "nested deeper than 32 levels"], *words, "deep")
                (self.here / "large").write_text('{"format": 1e309}\n')
                self.expect(2, ["large:1:12", "this number is too large"], *words, "large")
                self.expect(2, ["/dev/zero", "is not a regular file"], *words, "/dev/zero", within=20, preexec_fn=bounded)
                with open(self.here / "huge", "wb") as huge:
                    huge.truncate(1 << 40)
                self.expect(2, ["huge", "larger than"], *words, "huge", within=60, preexec_fn=bounded)


class TheLivePage(Attack):
    def setUp(self):
        super().setUp()
        self.process = None

    def serve(self, **more):
        self.process = self.start("serve", "--port", "0", "paper-straight", "--load", "4kN", **more)
        self.port = int(self.process.stdout.readline().strip().rstrip("/").rsplit(":", 1)[1])

    def ask(self, target, method="GET", body=None, **headers):
        line = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        line.request(method, target, body=body, headers=headers)
        answer = line.getresponse()
        text = answer.read().decode()
        line.close()
        return answer.status, text

    def raw(self, sent):
        """The first line that comes back for these bytes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as line:
            line.sendall(sent)
            return line.makefile("rb").readline().decode()

    def test_answers_while_others_hold_every_connection_that_it_has(self):
        self.serve(preexec_fn=limited(NOFILE=40))
        held = []
        for _ in range(200):
            held.append(socket.create_connection(("127.0.0.1", self.port), timeout=10))
        self.assertEqual(self.ask("/case")[0], 200)
        for line in held:
            line.close()
        self.assertEqual(self.ask("/case")[0], 200)

    def test_answers_after_1100_connections(self):
        self.serve()
        for _ in range(1100):
            socket.create_connection(("127.0.0.1", self.port), timeout=10).close()
        self.assertEqual(self.ask("/case")[0], 200)

    def test_says_what_is_wrong_with_a_request(self):
        self.serve()
        self.assertIn(" 414 ", self.raw(b"GET /estimate?" + b"a" * 9000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n"))
        self.assertIn(" 414 ", self.raw(b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"a" * 100000 + b"\r\n\r\n"))
        self.assertIn(" 400 ", self.raw(b"rubbish\r\n\r\n"))
        self.assertIn(" 400 ", self.raw(b"\x00\xff\x16\x03\x01 / \r\n\r\n"))
        self.assertIn(" 413 ", self.raw(b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000\r\n\r\n" + b"a" * 100000))
        self.assertEqual(self.ask("/case")[0], 200)

    def test_tiny_numbers_are_numbers(self):
        self.serve()
        for load in ("1e-320N", "1e-308N", "4.9e-324N"):
            status, text = self.ask(f"/estimate?load={load}")
            self.assertIn(status, (200, 400, 422), text)
            self.assertNotIn("stod", text)

    def test_another_host_is_refused_however_it_is_spelt(self):
        self.serve()
        for host in ("127.0.0.1:evil.com", "localhost.evil.com", "localhost:80:evil", "evil.com:127.0.0.1", ""):
            self.assertEqual(self.ask("/case", Host=host)[0], 403, host)
        for host in (f"127.0.0.1:{self.port}", "localhost"):
            self.assertEqual(self.ask("/case", Host=host)[0], 200, host)


class OddRequests(Attack):
    def test_as_many_threads_as_no_machine_has(self):
        for words in (["run", self.case], ["element-test", "tilting-board", "paper-sand"], ["calibrate", "paper-sand"]):
            self.expect(2, "--threads: 0 (one a core) ..", *words, "--threads", "100000", within=10)

    def test_a_time_step_that_gets_nowhere(self):
        out, _ = self.expect(1, "no condition of the study has a solution", *self.grains("--time-step", "1e-300s"), within=10)
        self.assertIn("a time step of 1e-300 s is too short to get anywhere", out)

    def test_a_label_that_looks_like_a_script(self):
        self.case.write_text(CASE.replace("name: pebbles", "name: '<!--<script>'")
                             .replace("models: [dem]", "models: [bekker_wong, {model: bekker_wong, effects: [slip_sinkage], "
                                                            "label: '<!--<script>'}]")
                             .replace("soil: pebbles.yaml", "soil: dry-sand"))
        (self.folder / "js").mkdir()
        (self.folder / "js/d3.min.js").write_text("/* stands for d3 */")
        self.expect(0, [], "compare", self.case, "--no-loop", "--report", "page.html",
                    environment={"SOILBIN_JAVASCRIPT": str(self.folder / "js")})
        page = (self.here / "page.html").read_text()
        self.assertTrue("\\u003c!--\\u003cscript>" in page, "the label stands in the page's data")
        self.assertFalse("<!--<script" in page)

    def test_long_work_says_so_where_nobody_sees_a_line_change(self):
        process = self.start("run", "paper-straight", "--model", "dem", "--load", "4kN", "--slip", "20%", "--threads", "1")
        began = time.monotonic()
        os.set_blocking(process.stderr.fileno(), True)
        line = process.stderr.readline()
        waited = time.monotonic() - began
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertRegex(line, r"dem, [a-z ]+: \d+ %")
        self.assertLess(waited, 30)
        self.assertGreater(waited, 5)


if __name__ == "__main__":
    unittest.main(verbosity=1)
