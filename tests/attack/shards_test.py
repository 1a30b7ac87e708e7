"""Shards of a study: killed, stopped, run twice and beside each other; their records put together."""
import json
import re
import signal
import time
import unittest
from pathlib import Path

from attack import BED, BOARD, Attack, files_in

STUDY = """format: soilbin-case/1
name: pebbles
tire: {radius: 150 mm, width: 100 mm}
soil: pebbles.yaml
study:
  models: [dem]
  conditions: {load: [40 N, 60 N], slip: [5 %, 20 %], speed: 0.6 m/s}
"""
# Two packings, so eight runs, and one more at half the time step.
FLAGS = ["--model", "dem", *BED, "--lowering", "0.1s", "--starting", "0.05s", "--travel", "0.3m",
         "--packings", "2", "--half-step", "yes"]


def but_for_seconds(file):
    return re.sub(r'"(seconds|seal)": ?("[^"]*"|[^,}]*)', r'"\1":0', Path(file).read_text())


class Shards(Attack):
    def setUp(self):
        super().setUp()
        self.case.write_text(STUDY)

    def run_words(self, *more):
        return ["run", self.case, *FLAGS, *more]

    def shard(self, number, of, record=None):
        return self.run_words("--shard", f"{number}/{of}", "--record", record or f"{number}.json")

    def plan(self, *more):
        return json.loads(self.expect(0, [], *self.run_words("--dry-run", "--json", *more))[0])

    def test_together_are_the_record_of_one_process_whatever_becomes_of_them(self):
        self.expect(0, [], *self.run_words("--record", "one.json"))
        self.assertEqual(len(files_in(self.beds)), 2, "two beds, and no run that isn't finished")

        killed = self.start(*self.shard(1, 3))
        while not (self.here / "1.json").exists():
            self.assertIsNone(killed.poll())
            time.sleep(0.02)
        killed.kill()
        killed.wait()
        stopped = self.start(*self.shard(2, 3))
        self.assertIn("run 1 of 3", self.first_progress(stopped))
        stopped.send_signal(signal.SIGTERM)
        _, err = stopped.communicate()
        self.assertEqual(stopped.returncode, 3, err)
        self.assertIn("the same command goes on from there", err)
        twice = [self.start(*self.shard(3, 3)) for _ in range(2)]
        for process in twice:
            process.communicate()
            self.assertEqual(process.returncode, 0)
        self.expect(3, [], "record", "missing", self.case, "1.json", "--packings", "2", "--half-step", "yes")

        self.expect(0, "run 1 of 3: load 60 N, slip 20 %", *self.shard(1, 3))
        self.expect(0, [], *self.shard(2, 3))
        out, err = self.expect(0, [], "record", "merge", "whole.json", "3.json", "1.json", "2.json", "3.json")
        self.assertIn("8 runs and 1 at half the time step of 4 records", out)
        self.assertEqual(but_for_seconds(self.here / "whole.json"), but_for_seconds(self.here / "one.json"))
        self.expect(0, [], "record", "missing", self.case, "whole.json", "--packings", "2", "--half-step", "yes")
        out, _ = self.expect(0, [], "record", "show", "whole.json")
        self.assertIn("8 runs by dem", out)
        self.assertIn("half the time step changes", out)
        out, _ = self.expect(0, [], "run", self.case, "--recorded", "whole.json", "--json")
        self.assertEqual(len(json.loads(out)["rows"]), 4)

    def test_a_plan_tells_what_is_recorded_and_beds_and_runs_of_another_record_are_not_made_again(self):
        plan = self.plan()
        self.assertEqual((len(plan["runs"]), plan["recorded"], plan["beds"], plan["beds_to_settle"]), (9, 0, 2, [1, 2]))
        self.assertEqual([run["half_step"] for run in plan["runs"][:3]], [False, True, False])
        self.assertGreater(plan["core_hours_left"], 0)
        self.assertEqual(files_in(self.here), ["case.yaml", "pebbles.yaml"], "a dry run makes nothing")
        out, _ = self.expect(0, [], "bed", self.case, *BED, "--packings", "2", "--shard", "2/2")
        self.assertIn("bed sample 2: ", out)
        self.assertEqual(self.plan()["beds_to_settle"], [1])
        out, _ = self.expect(0, [], "bed", self.case, *BED, "--packings", "2")
        self.assertEqual((out.count("settled:"), out.count("is there:")), (1, 1))
        self.assertEqual(self.plan()["beds_to_settle"], [])

        self.expect(0, [], *self.shard(3, 3))
        made = len(json.loads((self.here / "3.json").read_text())["runs"])
        plan = self.plan("--known", "3.json")
        self.assertEqual((plan["recorded"], plan["from_recorded_runs"]), (made, made))
        self.expect(0, [], *self.run_words("--known", "3.json", "--record", "rest.json"))
        self.assertEqual(len(json.loads((self.here / "rest.json").read_text())["runs"]), 8 - made)
        self.expect(2, ["3.json holds answers to another question", "rig.resting"],
                    *self.run_words("--known", "3.json", "--record", "x.json", "--resting", "0.3s"))

    def test_a_sweep_on_this_machine_is_the_same_graph(self):
        sweep = ["sweep", self.case, *FLAGS[2:], "--on", "local", "--shards", "3", "--output", "swept"]
        out, _ = self.expect(0, [], *sweep)
        self.assertIn("9 runs in 3 shards", out)
        out, _ = self.expect(3, [], "sweep", "status", "swept")
        self.assertIn("0 of 9 runs recorded; shards: 0 done, 0 running, 0 waiting, 0 failed, 3 missing", out)
        log = self.here / "swept/logs/run-2.log"
        log.parent.mkdir(exist_ok=True)
        log.write_text("run 3 of 3: load 60 N\n2 runs in 2-of-3.json: the same command goes on from there\n")
        out, _ = self.expect(3, [], "sweep", "status", "swept")
        self.assertIn("0 waiting, 1 stopped, 0 failed, 2 missing", out)
        log.unlink()
        out, _ = self.expect(0, [], *sweep, "--submit")
        self.assertIn("9 of 9 runs recorded; shards: 3 done", out)
        self.expect(0, [], *self.run_words("--record", "one.json"))
        self.assertEqual(but_for_seconds(self.here / "swept/record.json"), but_for_seconds(self.here / "one.json"))

    def test_a_calibration_asked_in_batches_is_the_one_made_in_one_go(self):
        def told(out):
            answer = json.loads(out)
            return {key: answer[key] for key in ("best", "parameters", "reached") if key in answer}
        status, out, err = self.soilbin(*BOARD, "--store", "one.json")
        self.assertIn(status, (0, 1), err)
        right = told(out)
        self.assertTrue(right)
        sizes = []
        asking = [*BOARD, "--store", "map.json", "--ask", "4", "--batch", "batch.json"]
        status, out, err = self.soilbin(*asking)
        while status == 3:
            sizes.append(len(json.loads((self.here / "batch.json").read_text())["experiments"]))
            self.assertLess(len(sizes), 12)
            for k in (1, 2):
                self.expect(0, [], *BOARD, "--batch", "batch.json", "--shard", f"{k}/2", "--store", f"answers-{k}.json")
            status, out, err = self.soilbin(*asking, "--tell", "answers-1.json", "answers-2.json")
        self.assertIn(status, (0, 1), err)
        self.assertEqual(sizes[0], 9, "the whole design at once")
        self.assertEqual(told(out), right)
        self.expect(2, ["asked for by another question", "hint"], *BOARD, "--keep", "restitution", "--batch", "batch.json",
                    "--store", "x.json")

    def test_wrong_words_are_refused(self):
        self.expect(2, ["--shard: expected K/N", "hint"], *self.shard(4, 3))
        self.expect(2, ["--shard needs a record", "hint"], *self.run_words("--shard", "1/2"))
        self.expect(2, ["--dry-run has no effect on the analytic model", "--model dem"], "run", "rover-slip", "--dry-run")
        self.expect(2, ["did you mean 'merge'", "hint"], "record", "mrge", "a", "b")
        self.expect(2, ["expected OUT.json SHARD.json", "hint"], "record", "merge", "a.json")
        self.expect(2, ["holds no sweep", "hint"], "sweep", "status", self.here)
        self.expect(2, ["where?", "--on slurm"], "sweep", self.case)


if __name__ == "__main__":
    unittest.main(verbosity=1)
