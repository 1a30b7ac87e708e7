"""Counts and work that nobody means: refused in seconds, before anything of that size is made."""
import http.client
import json
import signal
import time
import unittest

from attack import BED, CASE, PEBBLES, Attack

MAP = ["failure-map", "paper-longitudinal", "--soil", "paper-sand-virtual", "--load", "2kN..4kN", "--lug-height",
       "0mm..1mm", "--angle", "0deg..1deg", "--slip", "5%..10%", "--stored"]
HUGE = str(2**31 - 1)


class Counts(Attack):
    def test_counts_are_judged_before_they_are_built(self):
        for words in (["run", self.case, *BED, "--packings", HUGE], ["run", self.case, *BED, "--packings", "10000", "--dry-run",
                                                                     "--slip", "0%..50%:1%"],
                      ["bed", self.case, *BED, "--packings", HUGE], ["sweep", self.case, *BED, "--on", "local", "--packings", HUGE],
                      ["record", "missing", self.case, "x.json", "--packings", HUGE],
                      ["bevameter", "pebbles.yaml", "--packings", HUGE],
                      ["element-test", "direct-shear", "pebbles.yaml", "--packings", HUGE],
                      ["calibrate", "paper-sand", "--packings", HUGE], ["calibrate", "paper-sand", "--ask", HUGE, "--batch", "b.json"],
                      ["calibrate", "paper-sand", "--contact", "tire", "--target", "board_angle=30deg", "--across", "46341"],
                      [*MAP, "--first", HUGE], [*MAP, "--boundary", HUGE], [*MAP, "--check", HUGE], [*MAP, "--rounds", HUGE]):
            _, err = self.expect(2, "", *words, within=20)
            self.assertRegex(err, "from [01246] to|more than|at most|hint", words)

    def test_a_sweep_has_no_more_shards_than_runs_and_many_are_no_work(self):
        self.expect(2, ["--shards 100000", "the study has 1"], "sweep", self.case, *BED, "--on", "local", "--shards", "100000",
                    within=20)
        self.case.write_text(CASE.replace("slip: 20 %", "slip: {from: 0 %, to: 50 %, count: 2000}"))
        words = ["sweep", self.case, *BED, "--half-step", "no", "--on", "local", "--shards", "2000", "--output", "many"]
        self.expect(0, [], *words, within=60)
        out, _ = self.expect(3, [], "sweep", "status", "many", "--json", within=20)
        self.assertEqual([row["runs"] for row in json.loads(out)["shards"]], [1] * 2000)
        plan = json.loads((self.here / "many/sweep.json").read_text())
        plan["shards"] = 2**31 - 1
        (self.here / "many/sweep.json").write_text(json.dumps(plan))
        self.expect(2, "shards of 2000 runs", "sweep", "status", "many", within=20)

    def test_work_that_gets_nowhere_is_refused(self):
        changes = (("youngs_modulus", "1e20 Pa"), ("youngs_modulus", "1e-20 Pa"), ("poisson_ratio", "-0.999999"),
                   ("grain_density", "1e-300 kg/m^3"), ("radius_min", "1 um"))
        for key, value in changes:
            lines = [f"  {key}: {value}" if line.strip().startswith(key + ":") else line for line in PEBBLES.splitlines()]
            (self.here / "pebbles.yaml").write_text("\n".join(lines) + "\n")
            for words in (self.grains(), ["bed", self.case, *BED], ["element-test", "direct-shear", "pebbles.yaml"],
                          ["element-test", "tilting-board", "pebbles.yaml"], ["element-test", "repose", "pebbles.yaml"]):
                _, err = self.expect(2, "", *words, within=20)
                self.assertRegex(err, "a grain needs|make sense", f"{key} {value}")
        (self.here / "pebbles.yaml").write_text(PEBBLES)
        for words in (["--speed", "1e-300m/s"], ["--resting", "1e30s"], ["--pass", "1000000000"]):
            for command in ("run", "sweep"):
                on = ["--on", "local"] if command == "sweep" else []
                self.expect(2, ["time steps", "hint"], command, self.case, *BED, *words, *on, within=20)


class TheLivePage(Attack):
    def setUp(self):
        super().setUp()
        self.process = self.start("serve", "--port", "0", "paper-straight", "--load", "4kN")
        self.port = int(self.process.stdout.readline().strip().rstrip("/").rsplit(":", 1)[1])

    def ask(self, target, **headers):
        line = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        line.request("GET", target, headers=headers)
        answer = line.getresponse()
        text = answer.read().decode()
        line.close()
        return answer.status, text

    def test_a_grid_is_refused_before_it_is_built(self):
        began = time.monotonic()
        for query in ("slip=0..1:0.0001&pass=1,2,3,4,5,6,7,8,9", "load=1N..2kN:0.2N&slip=0..1:0.0001", "pass=" + "1," * 3000 + "1"):
            status, text = self.ask("/estimate?" + query)
            self.assertEqual(status, 400, text)
            self.assertIn("more than 100 conditions", text)
        self.assertLess(time.monotonic() - began, 3)
        status, text = self.ask("/estimate?slip=0%25,10%25")
        self.assertEqual(status, 400)
        self.assertIn("2 conditions are left", text)

    def test_another_sites_page_asks_nothing(self):
        for site in ("cross-site", "same-site"):
            for target in ("/estimate?slip=20%25", "/", "/case", "/curves.csv"):
                status, text = self.ask(target, **{"Sec-Fetch-Site": site, "Sec-Fetch-Dest": "image"})
                self.assertEqual(status, 403, target)
                self.assertIn("its own page only", text)
            self.assertEqual(self.ask("/", **{"Sec-Fetch-Site": site, "Sec-Fetch-Dest": "document"})[0], 200, "a link to the page")
        for site in ("same-origin", "none"):
            self.assertEqual(self.ask("/case", **{"Sec-Fetch-Site": site})[0], 200)

    def test_ctrl_c_ends_it_at_rest_and_at_work(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            began = time.monotonic()
            self.process.send_signal(how)
            self.assertEqual(self.process.wait(20), 0)
            self.assertLess(time.monotonic() - began, 10)
            self.end(self.process)
            self.setUp()


if __name__ == "__main__":
    unittest.main(verbosity=1)
