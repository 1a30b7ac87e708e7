"""The page of `soilbin compare --report` in a real browser: it opens offline, nothing is asked for from elsewhere, no
console error, charts and replay are there, and what a person can do works, by mouse and by keys.

Usage: page_test.py SOILBIN [--pictures DIR]     skipped (exit status 77) where no Chromium is installed
"""
import base64
import csv
import io
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import browser
import replay_of_many

SOILBIN = sys.argv.pop(1)
PICTURES = Path(sys.argv.pop(1)) if "--pictures" in sys.argv[1:2] and sys.argv.pop(1) else None

CASE = """format: soilbin-case/1
name: cmu
tire: cmu-smooth
soil: cmu-sand
study:
  models: [bekker_wong, {model: bekker_wong, effects: [slip_sinkage]}]
  conditions: {load: [24 N, 40 N], slip: [-20 %, 0 %, 23 %, 50 %, 75 %], speed: 0.02 m/s}
"""


def compare(folder, name, *words, **environment):
    (folder / "case.yaml").write_text(CASE)
    page = folder / name
    subprocess.run([SOILBIN, "compare", str(folder / "case.yaml"), "--measured", "cmu-smooth", "--no-loop", "--report",
                    str(page), *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env=os.environ | environment)
    return page


class ThePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        folder = Path(cls.scratch.name)
        (folder / "run.replay").write_bytes(replay_of_many.replay(4000, 6))
        cls.page = compare(folder, "page.html", "--replay", str(folder / "run.replay"))
        cls.plain = compare(folder, "plain.html", "--replay", str(folder / "run.replay"), SOILBIN_JAVASCRIPT=str(folder))
        cls.browser = browser.Browser()
        cls.browser.open(cls.page)
        assert cls.browser.until("document.documentElement.dataset.ready === 'yes'")

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.scratch.cleanup()

    def js(self, expression):
        return self.browser.js(expression)

    def test_1_opens_without_errors_and_asks_for_nothing(self):
        self.assertTrue(self.browser.until("document.querySelector('.replay').dataset.ready === 'yes'"))
        self.assertEqual(self.browser.errors, [])
        elsewhere = [a for a in self.browser.addresses if not a.startswith((f"file://{self.page}", "blob:", "data:"))]
        self.assertEqual(elsewhere, [])

    def test_2_summary_comes_first_and_each_clause_leads_to_its_rows(self):
        self.assertTrue(self.js("document.querySelector('main').children[2].matches('nav') && "
                                "document.querySelector('main').children[3].matches('.summary')"))
        self.assertTrue(self.js("[...document.querySelectorAll('a.evidence, nav a')].length > 5 && "
                                "[...document.querySelectorAll('a.evidence, nav a')].every("
                                "a => document.getElementById(a.hash.slice(1)))"))
        self.js("document.querySelector('a.evidence').click()")
        self.assertTrue(self.browser.until("document.getElementById(location.hash.slice(1)).open === true"))
        self.js("scrollTo(0, 0)")

    def test_2b_the_headline_is_two_lines_and_the_curves_it_speaks_of_are_in_sight(self):
        self.browser.size(1400, 900)
        self.js("scrollTo(0, 0)")
        lines = self.js("(p => p.getBoundingClientRect().height / parseFloat(getComputedStyle(p).lineHeight))"
                        "(document.querySelector('.summary p'))")
        self.assertLess(lines, 2.2)
        axis = self.js("(c => c.querySelector('.quiet').getBoundingClientRect().bottom)"
                       "(document.querySelector('.choice:not([hidden]) .chart'))")
        self.assertLess(axis, 900, "the x axis of the first row")
        said = self.js("document.querySelector('.summary p').textContent").replace("\u00a0", " ")
        shown = self.js("(s => s.selectedOptions[0].textContent)(document.querySelector('.chooser select'))")
        self.assertIn(f"at {shown} and ", said)
        caption = self.js("document.querySelector('.choice:not([hidden]) figcaption').textContent")
        self.assertIn("measured", caption)
        self.assertNotIn("grains", caption, "there are none")
        self.assertNotIn("bekker_wong", self.js("[...document.querySelectorAll('.legend, figcaption, th, td, .summary')]"
                                                ".filter(e => !e.closest('#repeat ~ *')).map(e => e.textContent).join()"))
        self.assertIn("bekker_wong", self.js("document.querySelector('.subtitle').textContent"), "once, for flags")
        self.browser.size(1600, 1000)

    def test_2c_files_are_called_after_their_figure(self):
        self.js("(window.names = [], window.kept = soilbin.saveFile, soilbin.saveFile = name => { window.names.push(name); }, 0)")
        self.js("document.querySelector('.choice:not([hidden]) figure [data-take=csv]').click()")
        shown = self.js("document.querySelector('.chooser select').selectedOptions[0].textContent")
        self.assertEqual(self.js("window.names"), [f"cmu-{shown.lower().replace(' ', '-')}.csv"])
        self.js("(soilbin.saveFile = window.kept, 0)")

    def test_3_charts_read_zoom_and_toggle(self):
        chart = "document.querySelector('.choice:not([hidden]) .chart')"
        self.js(f"{chart}.scrollIntoView({{block: 'center'}})")
        x, y = self.js(f"(r => [r.x + r.width * 0.6, r.y + r.height / 2])({chart}.querySelector('svg').getBoundingClientRect())")
        self.browser.mouse("mouseMoved", x, y)
        self.assertTrue(self.js(f"!{chart}.querySelector('.tip').hidden && {chart}.querySelector('.tip').textContent.includes('slip')"))
        ticks = f"[...{chart}.querySelectorAll('.axis:not(.lines) text')].map(t => t.textContent).join()"
        whole = self.js(ticks)
        self.js(f"{chart}.querySelector('.zoom button').click()")
        self.assertNotEqual(self.js(ticks), whole)
        self.js(f"{chart}.querySelectorAll('.zoom button')[2].click()")
        self.assertEqual(self.js(ticks), whole)
        lines = f"{chart}.querySelectorAll('path.line').length"
        before, switch = self.js(lines), "document.querySelector('.choice:not([hidden]) .legend button')"
        self.js(f"{switch}.click()")
        self.assertEqual(self.js(lines), before - 1)
        self.assertEqual(self.js(f"{switch}.getAttribute('aria-pressed')"), "false")
        self.js(f"{switch}.click()")
        self.assertGreater(self.js(f"{chart}.querySelectorAll('path.band').length"), 0)

    def test_4_keys_read_the_chart_aloud_and_walk_the_heat_map(self):
        self.js("document.querySelector('.choice:not([hidden]) svg.live').focus()")
        self.browser.key("Escape")  # whatever the mouse reads
        said, heard = "document.querySelector('.choice:not([hidden]) .for-ears').textContent", []
        for _ in range(25):  # lines are smooth: measured runs and many points between the study's slips
            self.browser.key("ArrowRight")
            heard.append(self.js(said))
        self.assertIn("slip [%]: 0;", "".join(heard))
        self.js("document.querySelector('.heat .cell').focus()")
        self.browser.key("ArrowRight")
        self.assertEqual(self.js("document.activeElement.dataset.column"), "1")
        self.assertEqual(self.js("document.querySelector('.reading').textContent"), self.js("document.activeElement.dataset.tip"))

    def test_4b_a_mouse_that_lies_still_takes_nothing_from_the_keys(self):
        focus = "document.querySelector('.heat .cell').focus()"
        self.js(focus)
        x, y = self.js("(r => [r.x + r.width / 2, r.y + r.height / 2])(document.querySelector('.heat .cell[data-column=\"2\"]').getBoundingClientRect())")
        self.browser.mouse("mouseMoved", x, y)
        pointed = self.js("document.querySelector('.heat .cell[data-column=\"2\"]').dataset.tip")
        self.assertTrue(self.browser.until(f"document.querySelector('.reading').textContent === {pointed!r}"))
        self.browser.key("ArrowRight")
        self.browser.mouse("mouseMoved", x, y)  # as the browser tells it where the page scrolls under the mouse
        self.assertEqual(self.js("document.querySelector('.reading').textContent"), self.js("document.activeElement.dataset.tip"))

    def test_5_choosing_a_condition_shows_that_one_alone(self):
        box = "[...document.querySelectorAll('.choices')].find(b => b.dataset.what === 'Condition')"
        self.js(f"(s => {{ s.value = 3; s.dispatchEvent(new Event('change')); }})({box}.querySelector('select'))")
        self.assertEqual(self.js(f"[...{box}.querySelectorAll(':scope > .choice')].map(c => c.hidden).indexOf(false)"), 3)
        self.assertGreater(self.js(f"{box}.querySelector('.choice:not([hidden]) svg.live').clientWidth"), 200)

    def test_6_the_replay_draws_and_plays(self):
        self.assertTrue(self.browser.until("document.querySelector('.replay').dataset.ready === 'yes'"))
        self.js("document.querySelector('.replay').scrollIntoView()")
        shade = ("(() => { const c = document.createElement('canvas'); c.width = 64; c.height = 64; const x = c.getContext('2d');"
                 "soilbin.replayView.refresh(); x.drawImage(document.querySelector('.replay canvas'), 0, 0, 64, 64);"
                 "return [...x.getImageData(0, 0, 64, 64).data].filter((v, i) => i % 4 === 3 && v > 0).length; })()")
        self.assertGreater(self.js(shade), 200)
        self.js("soilbin.replayView.go(0)")
        self.js("document.querySelector('.replay .bar button').click()")
        early = "(v => { v.go(0); v.tick(v.before - 100); return v.at; })(soilbin.replayView)"
        self.assertGreaterEqual(self.js(early), 0)  # a frame that began before the click
        self.assertTrue(self.browser.until("soilbin.replayView.at > 0.5", 60))
        self.assertTrue(self.browser.until("!soilbin.replayView.playing", 60))
        self.js("document.querySelector('.replay canvas').focus()")
        before = self.js("soilbin.replayView.scene.camera.position.x")
        self.browser.key("ArrowLeft")
        self.assertNotEqual(self.js("soilbin.replayView.scene.camera.position.x"), before)
        self.assertEqual(self.browser.errors, [])

    # The replay's places against the formula that made them, through the page's own unpacking.
    def test_7_the_replay_shows_the_grains_where_they_were(self):
        header = self.js("soilbin.replayView.replay.header")
        rest, last = replay_of_many.grains_at_rest(4000), header["wheel"][5][0]
        shown = self.js("[...soilbin.replayView.replay.frames[5]]")
        for k in range(0, 4000, 501):
            for axis, true in enumerate(replay_of_many.after(rest[k], last)):
                self.assertAlmostEqual(header["origin"][axis] + header["step"] * shown[3 * k + axis], true, delta=header["step"])

    def test_7b_axes_forces_contact_colours_and_a_series_of_pictures(self):
        view = "soilbin.replayView"
        self.assertTrue(self.browser.until(f"{view} && !{view}.playing", 60))
        self.assertEqual(self.js(f"{view}.scene.bin.map(w => w.map(x => Math.round(100 * x) / 100))"), [[0, 4], [0, 0.8], [-0.05, 0.32]])
        self.assertTrue(self.js(f"{view}.marks.click() || !{view}.scene.marks.visible"))
        self.js(f"{view}.marks.click()")
        forces = self.js(f"{view}.sheet.plots[0].series.map(s => [s.label, ...s.y])")
        header = self.js(f"{view}.replay.header")
        for axis, (label, *values) in enumerate(forces):
            for at, value in zip(header["force"], values):
                self.assertAlmostEqual(value, at[axis], delta=1e-5 * 5000)
        torque = self.js(f"{view}.sheet.plots[1].series[0].y")
        self.assertEqual(torque[0], -header["torque"][0][1], "a wheel that is driven against the soil's moment")
        marker = "document.querySelector('.forces .quiet-line').getAttribute('x1')"
        self.js(f"{view}.go(1)")
        before = float(self.js(marker))
        self.js(f"{view}.go(4)")
        self.assertGreater(float(self.js(marker)), before)
        self.js(f"(s => {{ s.value = 'force'; s.dispatchEvent(new Event('change')); }})({view}.colour)")
        self.assertIn("contact force", self.js("document.querySelector('.scale').textContent"))
        self.assertEqual(self.js(f"{view}.scene.uniforms.mode.value"), 2)
        pressed = self.js(f"[...{view}.replay.pressing[3]].map((p, k) => [p, k]).sort((a, b) => b[0] - a[0])[0]")
        shown = self.js(f"[...{view}.replay.frames[3].slice({3 * pressed[1]}, {3 * pressed[1] + 3})]")
        place = [header["origin"][a] + header["step"] * shown[a] for a in range(3)]
        self.assertLess(abs(place[0] - header["wheel"][3][0]), 0.15, "the grain pressed most lies under the wheel")
        self.js(f"soilbin.saveFile = (name, content) => {{ const r = new FileReader(); r.onload = () => {{ window.zip = r.result; }};"
                f"r.readAsDataURL(content); }}; {view}.series.click()")
        self.assertTrue(self.browser.until("window.zip", 60))
        with zipfile.ZipFile(io.BytesIO(base64.b64decode(self.js("window.zip").split(",")[1]))) as pictures:
            self.assertIsNone(pictures.testzip())
            self.assertEqual(pictures.namelist(), [f"frame-{k:03}.png" for k in range(6)])
            frames = [pictures.read(name) for name in pictures.namelist()]
        self.assertTrue(all(f.startswith(b"\x89PNG") for f in frames))
        self.assertEqual(len(set(frames)), 6)
        self.assertEqual(self.browser.errors, [])

    def test_8_fits_a_phone_a_desk_and_the_dark(self):
        browser.assert_fits_a_phone_a_desk_and_the_dark(self, self.browser)

    def test_8b_each_figure_is_saved_as_a_drawing_and_its_data_as_a_table(self):
        self.browser.scheme("dark")  # what is saved is for paper
        figures = self.js("[...document.querySelectorAll('figure')].filter(f => f.querySelector('svg') && f.offsetWidth"
                          " && !f.querySelector('.replay')).map((f, i) => (f.dataset.at = i, f.innerHTML.length)).length")
        self.assertGreater(figures, 3)
        kept = "(window.saved = {}, soilbin.saveFile = (name, content) => { window.saved[name.split('.').pop()] = content; })"
        self.js(f"{kept}; navigator.clipboard.writeText = async text => {{ window.copied = text; }}; 0")
        for i in range(figures):
            figure = f"document.querySelector('figure[data-at=\"{i}\"]')"
            takes = self.js(f"[...{figure}.querySelectorAll('[data-take]')].map(b => b.dataset.take)")
            self.assertEqual(takes[:4], ["svg", "png", "copy", "csv"], i)
            for take in takes:
                self.js(f"{figure}.querySelector('[data-take={take}]').click()")
            self.assertTrue(self.browser.until("Boolean(window.saved.png)", 60), i)
            drawn = ElementTree.fromstring(self.js("window.saved.svg"))
            words = {"".join(t.itertext()) for t in drawn.iter("{http://www.w3.org/2000/svg}text")}
            for text in self.js(f"[...{figure}.querySelectorAll('svg text')].map(t => t.textContent)"):
                self.assertIn(text, words, i)
            self.assertNotIn("class=", self.js("window.saved.svg"))
            styles = {t.get("fill") for t in drawn.iter("{http://www.w3.org/2000/svg}text")}
            self.assertLessEqual(styles, {"rgb(26, 29, 35)", "rgb(90, 98, 112)"}, "the light scheme's ink")
            self.assertEqual(self.js("window.saved.png.slice(1, 4).text()"), "PNG")
            table = list(csv.reader(io.StringIO(self.js("window.saved.csv"))))
            self.assertGreater(len(table), 2, i)
            self.assertEqual([line.split("\t") for line in self.js("window.copied").split("\n")], table)
            self.js("window.saved = {}; 0")
        self.browser.scheme("light")
        sheet = self.js("JSON.parse(document.getElementById('figures').textContent)['figure-1']")
        rows = list(csv.reader(io.StringIO(self.js("soilbin.csvOf(soilbin.rowsOf(null, JSON.parse(document.getElementById("
                                                   "'figures').textContent)['figure-1']))"))))
        first = sheet["plots"][0]["series"][0]
        self.assertEqual([float(r[3]) for r in rows[1:1 + len(first["y"])]], first["y"])

    def test_9_without_the_libraries_it_says_so_and_shows_drawings(self):
        self.browser.open(self.plain)
        self.assertTrue(self.browser.until("document.documentElement.dataset.ready === 'yes'"))
        self.assertEqual(self.browser.errors, [])
        self.assertIn("node-d3", self.js("document.querySelector('.warning').textContent"))
        self.assertIn("three.js was not installed", self.js("document.querySelector('.replay').textContent"))
        self.assertGreater(self.js("document.querySelectorAll('.choice:not([hidden]) svg.plot').length"), 3)


def take_pictures():
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        PICTURES.mkdir(parents=True, exist_ok=True)
        (folder / "run.replay").write_bytes(replay_of_many.replay(8000, 6))
        page = compare(folder, "page.html", "--replay", str(folder / "run.replay"))
        for name, width, dark in (("phone", 360, False), ("phone-dark", 360, True), ("desk", 1600, False), ("desk-dark", 1600, True)):
            with browser.Browser(width, 900, dark) as one:
                one.open(page)
                one.until("document.querySelector('.replay').dataset.ready === 'yes'")
                one.picture(PICTURES / f"{name}.png")
                if name == "desk":
                    one.pdf(PICTURES / "print.pdf")


if __name__ == "__main__":
    if not browser.find():
        print("no Chromium: skipped")
        sys.exit(77)
    if PICTURES:
        take_pictures()
    else:
        unittest.main(verbosity=2)
