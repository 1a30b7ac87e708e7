"""What requests that nobody sensible makes do to the command."""
import os
import signal
import time
import unittest

from attack import CASE, Attack


class OddRequests(Attack):
    def test_as_many_threads_as_no_machine_has(self):
        for words in (["run", self.case], ["element-test", "tilting-board", "paper-sand"], ["calibrate", "paper-sand"]):
            self.expect(2, "--threads: 0 (one a core) ..", *words, "--threads", "100000", within=10)

    def test_a_time_step_that_gets_nowhere(self):
        self.expect(2, "a time step of 1e-300 s is too short to get anywhere", *self.grains("--time-step", "1e-300s"), within=10)

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
        line = self.first_progress(process)
        waited = time.monotonic() - began
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertRegex(line, r"dem, [a-z ]+: \d+ %")
        self.assertLess(waited, 30)
        self.assertGreater(waited, 5)


if __name__ == "__main__":
    unittest.main(verbosity=1)
