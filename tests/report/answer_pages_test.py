"""The pages that answer a question - loop, reproduction, failure map - in a real browser: the answer comes first, the
figure that shows it next, each control does what it says, nothing is asked for from elsewhere, no console error.

Usage: answer_pages_test.py SOILBIN SOURCES     skipped (exit status 77) where no Chromium is installed
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import browser

SOURCES = Path(sys.argv.pop(2))
SOILBIN = sys.argv.pop(1)

COMMANDS = {
    "loop": ["loop", "docs/guide/first-campaign", "--folds", "2"],
    "scattered": ["loop", "made-lesson", "--folds", "2"],
    "reproduction": ["reproduce"],
    "map": ["failure-map", "bench/dem_nature/studies/dem-lugs.yaml", "--incline", "longitudinal", "--load", "40N..100N",
            "--lug-height", "0mm..15mm", "--angle", "0deg..15deg", "--slip", "5%..40%", "--boundary", "0", "--rounds", "0",
            "--settling-friction", "0.2", "--bed-length", "0.5m", "--behind", "0.12m", "--ahead", "0.12m", "--lowering",
            "0.2s", "--resting", "0.1s", "--starting", "0.1s", "--tilting", "0.2s", "--sleep", "0", "--store",
            "bench/dem_nature/failure_maps/dem-nature-longitudinal.json", "--stored"]}


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.pages, cls.words = {}, {}
        cls.browser = browser.Browser(1400, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.scratch.cleanup()

    def js(self, expression):
        return self.browser.js(expression)

    def made(self, name):
        """The page of a command, made once. A store whose runs are of another engine has no map to show."""
        if name not in self.pages:
            page = Path(self.scratch.name) / f"{name}.html"
            done = subprocess.run([SOILBIN, *COMMANDS[name], "--report", str(page)], cwd=SOURCES, capture_output=True, text=True)
            if "have an answer of both models" in done.stderr:
                self.skipTest(done.stderr.splitlines()[-1])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.pages[name], self.words[name] = page, done.stdout
        return self.pages[name]

    def show(self, name):
        self.browser.size(1400, 900)
        self.browser.open(self.made(name))
        self.assertTrue(self.browser.until("document.documentElement.dataset.ready === 'yes'"))
        self.assertEqual(self.browser.errors, [])
        elsewhere = [a for a in self.browser.addresses if not a.startswith(("file://", "blob:", "data:"))]
        self.assertEqual(elsewhere, [])

    def parts(self):
        """Of the box on top: what each paragraph is about, and its text."""
        return self.js("[...document.querySelector('.summary').children].map(p => [p.querySelector('b').textContent.slice(0, -1), "
                       "p.textContent.slice(p.querySelector('b').textContent.length + 1)])")

    def test_the_loop_answers_first_and_the_terminal_says_the_same(self):
        for name in ("loop", "scattered"):
            self.show(name)
            self.assertEqual([about for about, _ in self.parts()],
                             ["What is missing", "What it does to the error", "What to measure next"])
            for about, text in self.parts():
                self.assertIn(f"{about}. {text}".replace("\u00a0", " "), self.words[name])
            self.assertIn("1 of 4,000 campaigns", self.parts()[0][1])

    def test_the_loops_figure_holds_measured_points_and_both_models(self):
        self.show("loop")
        figure = "document.querySelector('#figure ~ .choices .choice:not([hidden])')"
        labels = self.js(f"[...{figure}.querySelectorAll('.legend li')].map(li => li.textContent)")
        self.assertEqual(labels, ["measured", "model before", "model after"])
        chart = f"{figure}.querySelector('.chart')"
        self.assertGreater(self.js(f"{chart}.querySelectorAll('circle').length"), 3)
        self.assertEqual(self.js(f"{chart}.querySelectorAll('path.line').length"), 2)
        self.assertRegex(self.js(f"{chart}.querySelector('.title').textContent"), r"\[N\]")

    def test_another_curve_of_the_loop_can_be_chosen(self):
        self.show("loop")
        box = "document.querySelector('#figure ~ .choices')"
        self.assertGreater(self.js(f"{box}.querySelectorAll(':scope > .choice').length"), 2)
        self.js(f"(s => {{ s.value = 1; s.dispatchEvent(new Event('change')); }})({box}.querySelector('select'))")
        self.assertEqual(self.js(f"[...{box}.querySelectorAll(':scope > .choice')].map(c => c.hidden).indexOf(false)"), 1)

    def test_scattered_runs_are_drawn_as_pairs_over_the_variable_that_matters(self):
        self.show("scattered")
        figure = "document.querySelector('#figure ~ figure')"
        self.assertEqual(self.js(f"{figure}.querySelector('.live .quiet:not(.title)').textContent"), "pass")
        self.assertIn("model after", self.js(f"{figure}.querySelector('.legend').textContent"))

    def test_the_loops_tables_mark_gain_and_tell_units(self):
        self.show("loop")
        self.assertGreater(self.js("document.querySelectorAll('#error ~ .scroll td.good').length"), 0)
        effects = self.js("document.querySelector('#effects + .scroll').textContent")
        self.assertIn("slip_sinkage", effects)  # the id, in grey
        self.assertIn("yes", effects)
        self.assertFalse(self.js("document.querySelector('#appendix ~ details').open"))

    def test_a_cell_of_the_reproduction_opens_its_figure(self):
        self.show("reproduction")
        self.assertIn("37 of 48 findings are shown", self.js("document.querySelector('.summary').textContent"))
        self.assertEqual(self.js("document.querySelectorAll('.marked tbody tr').length"), 48)
        self.assertTrue(self.js("[...document.querySelectorAll('.marked td a')].every("
                                "a => document.getElementById(a.hash.slice(1)).matches('details'))"))
        self.js("document.querySelector('.marked td.bad a').click()")
        fold = "document.getElementById(location.hash.slice(1))"
        self.assertTrue(self.browser.until(f"{fold} && {fold}.open"))
        self.assertTrue(self.browser.until(f"{fold}.querySelectorAll('svg.live circle').length > 2"))

    def test_no_two_ticks_of_an_axis_bear_the_same_number(self):
        self.show("reproduction")
        twice = self.js("""(() => {
          for (const fold of document.querySelectorAll('details')) fold.open = true;
          return [...document.querySelectorAll('svg.live .axis')].map(axis => [...axis.querySelectorAll('text')]
            .map(t => t.textContent)).filter(all => new Set(all).size < all.length); })()""")
        self.assertEqual(twice, [])

    def test_the_sliders_of_the_failure_map_change_it(self):
        self.show("map")
        self.assertEqual(self.js("document.querySelector('h1').textContent"), "Where may I trust the quick estimate?")
        figure = "document.querySelector('.sliding-map')"
        self.assertLess(self.js(f"{figure}.getBoundingClientRect().top"), 900)
        self.assertEqual(self.js(f"{figure}.querySelectorAll('input').length"), 2)
        shown = f"[...{figure}.querySelectorAll('.cell text')].map(t => t.textContent).join()"
        before, title = self.js(shown), self.js(f"{figure}.querySelector('svg text').textContent")
        slide = ("(i => {{ i.value = i.max; i.dispatchEvent(new Event('input')); }})"
                 f"({figure}.querySelectorAll('input')[{{}}])")
        self.js(slide.format(1))
        self.assertNotEqual(self.js(shown), before)
        self.assertNotEqual(self.js(f"{figure}.querySelector('svg text').textContent"), title)
        self.assertIn("40 %", self.js(f"{figure}.querySelectorAll('output')[1].textContent"))
        self.assertIn("slip 40 %", self.js(f"{figure}.querySelector('.cell').dataset.tip"))
        self.js(slide.format(0))
        self.assertIn("lug height 15 mm", self.js(f"{figure}.querySelector('.cell').dataset.tip"))

    def test_all_fit_a_phone_a_desk_and_the_dark(self):
        for name in ("loop", "scattered", "reproduction", "map"):  # the map last: it may have nothing to show
            self.show(name)
            browser.assert_fits_a_phone_a_desk_and_the_dark(self, self.browser)


if __name__ == "__main__":
    if not browser.find():
        print("no Chromium: skipped")
        sys.exit(77)
    unittest.main(verbosity=2)
