"""The pages that answer a question - loop, reproduction, failure map - in a real browser: the answer comes first, the
figure that shows it next, each control does what it says, nothing is asked for from elsewhere, no console error.

Usage: answer_pages_test.py SOILBIN SOURCES     skipped (exit status 77) where no Chromium is installed
"""
import base64
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import browser

SOURCES = Path(sys.argv.pop(2))
SOILBIN = sys.argv.pop(1)

COMMANDS = {
    "start": ["report", "paper-straight", "paper-longitudinal", "--measured", "cmu-smooth"],
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
            flag = "--output" if COMMANDS[name][0] == "report" else "--report"
            done = subprocess.run([SOILBIN, *COMMANDS[name], flag, str(page)], cwd=SOURCES, capture_output=True, text=True)
            if "have an answer of both models" in done.stderr:
                self.skipTest(done.stderr.splitlines()[-1])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.pages[name], self.words[name] = page, " ".join(done.stdout.split())
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
                             ["What is missing", "Error with the effect", "What to measure next"])
            for about, text in self.parts():
                self.assertIn(f"{about}. {text}".replace("\u00a0", " "), self.words[name])
            self.assertIn("not explained by noise (p < 0.00025)", self.parts()[0][1])

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
        self.assertIn("The analytic wheel shows 37 of 48 findings (", self.js("document.querySelector('.summary').textContent"))
        self.assertEqual(self.js("document.querySelectorAll('.marked tbody tr').length"), 48)
        self.assertTrue(self.js("[...document.querySelectorAll('.marked td a')].every("
                                "a => document.getElementById(a.hash.slice(1)).matches('details'))"))
        self.js("document.querySelector('.marked td.bad a').click()")
        fold = "document.getElementById(location.hash.slice(1))"
        self.assertTrue(self.browser.until(f"{fold} && {fold}.open"))
        self.assertTrue(self.browser.until(f"{fold}.querySelectorAll('svg.live circle').length > 2"))

    def test_the_appendix_of_the_reproduction_says_each_thing_once_and_with_its_unit(self):
        self.show("reproduction")
        heads = self.js("[...document.querySelectorAll('.marked thead th')].map(t => t.textContent)")
        self.assertEqual(heads, ["section", "finding", "analytic wheel", "analytic wheel with slip sinkage", "grains"])
        told = self.js("""[...document.querySelectorAll('details')].filter(d => d.querySelector('figcaption')).map(d => ({
          caption: d.querySelector('figcaption').textContent.split(': at ')[0], text: d.textContent,
          columns: [...d.querySelectorAll('thead th')].map((_, c) => [...d.querySelectorAll('tbody tr')].map(r => r.children[c].textContent).join('')),
          verdicts: [...d.querySelectorAll('tbody tr')].map(r => r.children[1].textContent).filter(t => t.includes(':'))}))""")
        self.assertGreater(len(told), 40)
        for one in told:
            self.assertEqual(one["text"].count(one["caption"]), 1)
            self.assertTrue(all(one["columns"]), one)
            for verdict in one["verdicts"]:
                self.assertRegex(verdict, r"[0-9)] (N|mm|%|kN|deg|times)", one["caption"])

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
        self.assertLess(self.js(f"{figure}.querySelector('svg.heat').getBoundingClientRect().bottom"), 900, "map and x axis")
        self.assertEqual(self.js("document.querySelector('nav a').hash"), "#map")
        self.assertEqual(self.js(f"{figure}.querySelectorAll('output')[0].textContent"), "15 mm", "the tire's own lugs")
        self.assertNotIn("Left out one at a time", self.js("document.body.textContent"))
        self.js(f"{figure}.querySelectorAll('input').forEach(i => {{ i.value = 0; i.dispatchEvent(new Event('input')); }})")
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

    def test_the_start_page_tells_the_peaks_that_it_draws(self):
        self.show("start")
        figure = self.js("document.querySelector('.choice:not([hidden]) figure').id")
        sheet = f"JSON.parse(document.getElementById('figures').textContent)['{figure}']"
        of = lambda plot, label: self.js(f"{sheet}.plots.find(p => p.title.startsWith('{plot}')).series.find(s => s.label === {label!r})")
        text = self.js("document.querySelector('.summary p').textContent").replace("\u00a0", " ")
        told = re.search(r"At (.*?) the largest pull is ([0-9.]+)(?: ± [0-9.]+)? kN, .*? at ([0-9.]+) % slip.*?; "
                         r"peak tractive efficiency ([0-9]+) %, at ([0-9.]+) % slip", text)
        self.assertTrue(told, text)
        self.assertEqual(self.js("document.querySelector('.choice:not([hidden])').dataset.name"), told[1])
        label = self.js(f"{sheet}.plots[0].series[0].label")
        pull, efficiency = of("Drawbar", label), of("Tractive", label)
        most = max(range(len(pull["y"])), key=lambda i: pull["y"][i])
        best = max(range(len(efficiency["y"])), key=lambda i: efficiency["y"][i] or 0)
        self.assertAlmostEqual(1000 * float(told[2]), pull["y"][most], delta=10)
        self.assertAlmostEqual(float(told[3]), pull["x"][most], delta=0.1)
        self.assertEqual(float(told[4]), round(efficiency["y"][best]))
        self.assertAlmostEqual(float(told[5]), efficiency["x"][best], delta=0.1)

    def test_the_start_page_says_which_curves_have_a_band_and_shows_the_others_when_pointed_at(self):
        self.show("start")
        figure = self.js("document.querySelector('.choice:not([hidden]) figure').id")
        bands = f"document.querySelector('#{figure} .chart').querySelectorAll('path.band').length"
        series = self.js(f"JSON.parse(document.getElementById('figures').textContent)['{figure}'].plots[0].series")
        drawn = [s for s in series if s["error"] and s.get("band", True)]
        kept_back = [s for s in series if s["error"] and not s.get("band", True)]
        self.assertEqual(len(drawn) + len(kept_back), len(series), "each curve knows its errors")
        self.assertEqual(len(drawn), 1, "two bands would mix their colours")
        self.assertIn("Band: one standard error", self.js(f"document.querySelector('#{figure} figcaption').textContent"))
        self.assertEqual(self.js(bands), len(drawn))
        name = f"[...document.querySelectorAll('#{figure} .legend button')].find(b => b.textContent === {kept_back[0]['label']!r})"
        self.js(f"{name}.focus()")
        self.assertEqual(self.js(bands), len(drawn) + 1)
        self.js(f"{name}.blur()")
        self.assertEqual(self.js(bands), len(drawn))

    def test_a_table_that_goes_on_by_a_few_pixels_shows_it(self):
        self.show("start")
        self.browser.size(500, 900)
        for beyond in (8, 12, 300):
            place = self.js(f"""(() => {{ const box = document.querySelector('.scroll'), table = box.querySelector('table');
              table.style.minWidth = table.style.width = (box.clientWidth + {beyond}) + 'px'; table.style.tableLayout = 'fixed';
              table.replaceChildren(); box.style.height = '60px'; box.scrollIntoView();
              const r = box.getBoundingClientRect(); return [r.right - 1 - Math.min({beyond}, 10), r.top + 30, r.left + r.width / 2]; }})()""")
            picture = base64.b64encode(self.browser.screen()).decode()
            shades = self.js(f"""(async () => {{ const image = new Image(); image.src = 'data:image/png;base64,{picture}';
              await image.decode(); const c = document.createElement('canvas'); c.width = image.width; c.height = image.height;
              const x = c.getContext('2d'); x.drawImage(image, 0, 0);
              return [{place[0]} + 1, {place[2]}].map(at => x.getImageData(at, {place[1]}, 1, 1).data[0]); }})()""")
            self.assertLess(shades[0], shades[1] - 15, f"{beyond} px beyond the edge")

    def test_all_fit_a_phone_a_desk_and_the_dark(self):
        for name in ("start", "loop", "scattered", "reproduction", "map"):  # the map last: it may have nothing to show
            self.show(name)
            browser.assert_fits_a_phone_a_desk_and_the_dark(self, self.browser)


if __name__ == "__main__":
    if not browser.find():
        print("no Chromium: skipped")
        sys.exit(77)
    unittest.main(verbosity=2)
