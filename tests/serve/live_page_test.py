"""The page of `soilbin serve` in a real browser.

Usage: live_page_test.py SOILBIN [--pictures DIR]     the tests are left out where no Chromium is installed
"""
import json
import shlex
import sys
import time
import unittest
from pathlib import Path

from live_page import LivePage, browser
from server import Server, soilbin

PICTURES = Path(sys.argv.pop(1)) if "--pictures" in sys.argv[1:2] and sys.argv.pop(1) else None


class ThePage(LivePage):
    words, drawn = ("paper-straight", "--load", "4kN"), "document.querySelectorAll('#curves .line').length === 5"

    def test_1_opens_without_errors_and_asks_for_nothing_elsewhere(self):
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([a for a in self.browser.addresses if not a.startswith(self.server.address)], [])

    def test_2_each_number_moves_the_curves(self):
        for key, value in (("load", 6), ("longitudinal-incline", 5), ("transverse-incline", 10), ("yaw", 20)):
            before, readings = self.pull(), self.js("document.getElementById('now').textContent")
            self.move(key, value)
            self.assertNotEqual(self.pull(), before, key)
            self.assertNotEqual(self.js("document.getElementById('now').textContent"), readings, key)
        dot = "document.querySelector('#curves circle').getAttribute('cx')"
        before = self.js(dot)
        self.move("slip", 45)
        self.assertNotEqual(self.js(dot), before)
        self.assertEqual(self.js("soilbin.live.numbers.get('slip').box.value"), "45")
        self.assertEqual(self.browser.errors, [])

    def test_3_the_address_holds_the_setup(self):
        self.move("slip", 33)
        self.assertTrue(self.browser.until("location.hash.includes('slip=33')"))
        command, hash_ = self.js("document.getElementById('command').textContent"), self.js("location.hash")
        self.open(hash_)
        self.assertTrue(self.browser.until(f"document.getElementById('command').textContent === {json.dumps(command)}"))
        self.assertEqual(self.js("soilbin.live.numbers.get('slip').slider.value"), "33")
        self.js("document.getElementById('reset').click()")
        self.assertTrue(self.browser.until("soilbin.live.numbers.get('slip').box.value === '20'"))

    def test_4_effects_go_on_and_off_by_keys(self):
        before, box = self.pull(), "[...document.querySelectorAll('.effect label')].find(l => l.textContent === 'slip sinkage').firstChild"
        self.js(f"{box}.focus()")
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until("document.getElementById('command').textContent.includes('--effect=slip_sinkage')"))
        self.assertNotEqual(self.pull(), before)
        self.assertGreater(len(self.js(f"{box}.closest('.effect').querySelector('small').textContent")), 5)
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until("document.getElementById('command').textContent.includes('--effect=declared')"))
        self.assertEqual(self.pull(), before)

    def test_4_what_the_tire_declares_is_on_and_goes_off(self):
        box = "[...document.querySelectorAll('.effect label')].find(l => l.textContent === 'lug thrust').firstChild"
        self.assertTrue(self.js(f"{box}.checked"), "of the tire, though no model of the case has it")
        self.assertEqual(self.js("soilbin.live.effects.firstChild.textContent"), "Effects on: lug thrust")
        self.js("soilbin.live.go('effect=slip_sinkage')")
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && {box}.checked"))
        self.assertIn("As the tire declares", self.js(f"{box}.closest('.effect').querySelector('small').textContent"))
        self.assertEqual(self.js(f"{box}.closest('.effect').querySelector('select').value"), "passive_blade")
        lugged = self.pull()
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until("document.getElementById('command').textContent.includes('--no-lugs')"))
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && !{box}.checked"))
        self.assertNotEqual(self.pull(), lugged)
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && {box}.checked"))
        self.assertEqual(self.pull(), lugged)
        self.reset()

    def test_4_a_tire_of_the_library_brings_what_it_declares(self):
        self.choose("Tire", "14.00R20")
        self.move("load", 30)
        summary = "soilbin.live.effects.firstChild.textContent"
        self.assertTrue(self.browser.until(f"{summary} === 'Effects on: tire flexibility, lug thrust'"))
        self.assertGreater(self.js("soilbin.live.answer.wheels[0].deflection"), 0)
        box = "[...document.querySelectorAll('.effect label')].find(l => l.textContent === 'tire flexibility').firstChild"
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && {summary} === 'Effects on: lug thrust'"))
        self.assertIn("--rigid", self.command())
        self.assertEqual(self.js("soilbin.live.answer.wheels[0].deflection"), 0)
        self.reset()

    def test_4_an_effects_parameter_moves_the_curves(self):
        control = "soilbin.live.start.effects.find(e => e.id === 'slip_sinkage').controls.get('a')"
        self.js("soilbin.live.go('effect=slip_sinkage')")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))
        before = self.pull()
        self.js(f"(e => {{ e.value = 0.4; e.dispatchEvent(new Event('input')); }})({control}.slider)")
        self.assertTrue(self.browser.until("document.getElementById('command').textContent.includes('slip_sinkage:lyasko,a=0.4')"))
        self.assertNotEqual(self.pull(), before)
        self.js("soilbin.live.go('effect=slip_sinkage:lyasko,a=0.7')")
        self.assertTrue(self.browser.until(f"{control}.box.value === '0.7'"))
        self.js("soilbin.live.go('effect=slip_sinkage:reece')")
        self.assertTrue(self.browser.until(f"{control.replace(chr(39) + 'a', chr(39) + 'h')}.box.value === '10'"))
        self.js("document.getElementById('reset').click()")
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && {control[:control.rindex('.get')]}.size === 0"))

    def test_4_a_parameter_of_each_unit_is_spelled_as_the_server_reads_it(self):
        refused = self.js("""(async () => {
          const live = soilbin.live, seen = new Set(), refused = [];
          for (const effect of live.start.effects) for (const form of effect.forms) {
            const p = form.parameters.find(p => !seen.has(p.unit));
            if (!p) continue;
            seen.add(p.unit);
            effect.show(`${effect.id}:${form.form}`);
            const {slider, unit} = effect.controls.get(p.key);
            const word = live.spelled(effect, form, p.key, soilbin.quantity(slider.max, unit));
            const response = await fetch(`estimate?effect=${encodeURIComponent(word)}`);
            if (response.status === 400) refused.push(word);
          }
          live.showEffects();
          return seen.size > 5 ? refused : ['too few units'];
        })()""")
        self.assertEqual(refused, [])
        self.browser.errors.clear()

    def test_4_what_an_effect_hears_of_comes_with_it(self):
        shown = "['pass', 'moisture', 'position', 'run'].filter(k => !soilbin.live.numbers.get(k).element.hidden).join()"
        self.assertEqual(self.js(shown), "")
        self.js("soilbin.live.go('effect=multipass&effect=moisture')")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))
        self.assertEqual(self.js(shown), "pass,moisture")
        self.assertEqual(self.js("getComputedStyle(soilbin.live.numbers.get('run').element).display"), "none")
        before = self.pull()
        self.move("pass", 3)
        self.assertNotEqual(self.pull(), before)
        self.assertIn("--pass=3", self.js("document.getElementById('command').textContent"))
        self.js("document.getElementById('reset').click()")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))
        self.assertEqual(self.js(shown), "")

    def test_5_a_soil_of_the_library(self):
        before = self.pull()
        self.choose("Soil", "clayey-soil")
        self.assertTrue(self.browser.until("document.getElementById('chosen').textContent.includes('clayey-soil')"))
        self.assertNotEqual(self.pull(), before)
        self.reset()
        self.assertEqual(self.js(f"{self.listed('Soil')}.value"), "")

    def test_5b_a_tire_of_ones_own(self):
        for key, value in (("radius", 350), ("width", 200), ("load", 3)):
            before, drawn = self.pull(), self.wheel()
            self.move(key, value)
            self.assertNotEqual(self.pull(), before, key)
            self.assertNotEqual(self.wheel(), drawn if key != "width" else "", key)
        for title in ("document.title", "document.querySelector('h1').textContent"):
            self.assertIn("b 200 mm", self.js(title))
        self.move("inflation-pressure", 120, "box")
        self.assertIn("--inflation-pressure=120kPa", self.command())
        self.move("inflation-pressure", "''", "box")
        self.assertNotIn("inflation-pressure", self.command())
        self.choose("Tire", "rover-wheel")
        self.assertTrue(self.browser.until("soilbin.live.numbers.get('radius').box.value === '90'"))
        self.assertNotIn("--radius", self.command())
        self.reset()

    def test_5c_a_soil_of_ones_own_with_its_band(self):
        band = "document.querySelector('#curves .band').getAttribute('d')"
        curve, before = self.pull(), self.js(band)
        self.move("friction-angle", 40)
        self.assertNotEqual(self.pull(), curve)
        self.assertRegex(self.command(), "--friction-angle=40[+]-[0-9.]+deg")
        moved = self.js(band)
        self.assertNotEqual(moved, before)
        self.js("(e => { e.value = 0; e.dispatchEvent(new Event('input')); })(soilbin.live.numbers.get('friction-angle').deviation)")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))
        self.assertNotEqual(self.js(band), moved)
        self.assertIn("--friction-angle=40+-0deg", self.command())
        told = json.loads(soilbin(*shlex.split(self.command())[1:], "--json").stdout)
        self.assertEqual(told["rows"], self.js("soilbin.live.answer.rows"))
        self.reset()

    def test_5c2_numbers_fit_their_boxes(self):
        clipped = "[...document.querySelectorAll('input[type=number]')].filter(b => b.scrollWidth > b.clientWidth).map(b => b.value)"
        self.choose("Soil", "dry-sand")
        for width in (1100, 1400, 1600):
            self.browser.size(width, 1000)
            self.assertEqual(self.js(clipped), [], width)
        self.choose("Soil", "")
        self.reset()

    def test_5d_a_second_soil_and_tire_beside(self):
        lines = "document.querySelectorAll('#curves .line').length"
        self.choose("A second soil", "sandy-loam")
        self.assertTrue(self.browser.until(f"{lines} === 10"))
        self.assertEqual(self.js("document.querySelectorAll('#ground svg').length"), 2)
        self.assertEqual(self.js("document.querySelectorAll('#budget .chart').length"), 2)
        self.assertIn("sandy-loam:", self.js("document.getElementById('now').textContent"))
        self.assertEqual(self.js("[...document.querySelectorAll('#curves .legend li')].map(l => l.textContent).join()"),
                         "paper-sand,sandy-loam")
        self.choose("A second soil", "")
        self.choose("A second tire", "utility-vehicle")
        self.assertTrue(self.browser.until("document.getElementById('chosen').textContent.includes('utility-vehicle')"))
        for width in (500, 1400):
            self.browser.size(width, 900)
            covered = """(() => [...document.querySelectorAll('.chart')].filter(chart => {
              const buttons = chart.querySelector('.zoom').getBoundingClientRect();
              return [...chart.querySelectorAll('.title')].some(title => {
                const words = title.getBoundingClientRect();
                return words.right > buttons.left && words.top < buttons.bottom && words.bottom > buttons.top; }); }).length)()"""
            self.assertTrue(self.browser.until(f"{covered} === 0"), "titles under the buttons")
        self.browser.size(1600, 1000)
        points = self.js("soilbin.live.answer.curves.plots.flatMap(p => p.series.filter(s => s.label.endsWith('this point')))"
                         ".map(s => [s.x[0], s.shift || 0].join())")
        self.assertEqual(set(points), {"20,0"}, "both stand on their slip")
        self.choose("A second tire", "")
        self.assertTrue(self.browser.until(f"{lines} === 5"))
        self.assertEqual(self.js("document.querySelectorAll('#budget .chart').length"), 1)

    def test_5e_the_stacked_parts_are_read_as_their_own_forces(self):
        self.assertGreater(self.js("document.querySelectorAll('#budget .area').length"), 1)
        self.js("document.querySelector('#budget svg.live').focus()")
        self.browser.key("ArrowRight")
        said = self.js("document.querySelector('#budget .for-ears').textContent")
        self.assertIn("shear thrust", said)
        self.assertRegex(said, "compaction resistance \u2212[0-9]")
        self.browser.key("Escape")

    def test_5f_what_a_person_takes_along(self):
        self.js("(window.saved = [], soilbin.saveFile = (name, content) => { window.saved.push([name, content]); }); "
                "navigator.clipboard.writeText = async text => { window.copied = text; }; 0")
        for figure in ("ground", "budget", "curves", "stresses"):
            for take in ("svg", "png", "copy", "csv", "json"):
                self.js(f"document.querySelector('#{figure} [data-take={take}]').click()")
            self.assertTrue(self.browser.until("window.saved.length === 4", 60), figure)
            self.assertEqual(self.js("window.saved.map(s => s[0].split('.').pop()).sort().join()"), "csv,json,png,svg")
            self.assertGreater(self.js("window.copied.length"), 100)
            self.js("window.saved = []; 0")
        self.js("document.getElementById('save-png').click()")
        self.assertTrue(self.browser.until("window.saved.length === 1 && window.saved[0][1].size > 30000", 60))
        self.js("document.getElementById('copy').click()")
        self.assertTrue(self.browser.until("window.copied.startsWith('soilbin estimate')"))
        self.assertEqual(self.js("window.copied"), self.command())
        for link, begins in (("save-case", "format: soilbin-case/1"), ("save-csv", "model,load_N"),
                             ("save-csv-comma", "model;load_N")):
            text = self.js(f"fetch(document.getElementById('{link}').href).then(r => r.text())")
            self.assertIn(begins, text[:400])

    def test_6b_an_impossible_load_offers_one_that_is_possible(self):
        before = self.pull()
        self.move("load", 2000, "box")
        self.assertTrue(self.browser.until("document.getElementById('carried') !== null"))
        self.assertEqual(self.pull(), before, "the last curves stay")
        offered = self.js("document.getElementById('carried').textContent")
        self.assertRegex(offered, "^Set the load to [0-9.]+ kN$")
        self.js("document.getElementById('carried').click()")
        self.assertTrue(self.browser.until("!soilbin.live.asking && !soilbin.live.refused"))
        self.assertEqual(self.js("soilbin.live.numbers.get('load').box.value") + " kN", offered.split("to ")[1])
        self.browser.errors.clear()
        self.reset()

    def test_6_what_is_refused_is_said_and_the_curves_stay(self):
        self.assertTrue(self.browser.until("!soilbin.live.asking"))
        before = self.pull()
        self.move("slip", 150, "box")
        self.assertTrue(self.browser.until("!document.getElementById('say').hidden"))
        self.assertIn("\u2018Slip\u2019: '150%' is out of range", self.js("document.getElementById('say').textContent"))
        self.assertEqual(self.pull(), before)
        self.move("slip", 20, "box")
        self.assertTrue(self.browser.until("!document.getElementById('say').textContent.includes('out of range')"))
        self.browser.errors.clear()  # the browser itself notes each status 400

    def test_6c_an_emptied_box_says_what_holds(self):
        self.move("load", 2000, "box")
        self.assertTrue(self.browser.until("document.getElementById('say').textContent.includes('no solution')"))
        self.js("(e => { e.value = ''; e.dispatchEvent(new Event('input')); })(soilbin.live.numbers.get('load').box)")
        said = self.js("document.getElementById('say').textContent")
        self.assertNotIn("no solution", said)
        self.assertIn("a number is missing", said)
        self.browser.errors.clear()
        self.reset()

    def test_7_kept_curves_stay_beside_the_new_ones(self):
        self.js("document.getElementById('keep').click()")
        self.move("load", 2)
        self.assertEqual(self.js("document.querySelectorAll('#curves .line').length"), 10)
        self.js("document.getElementById('keep').click()")
        self.assertEqual(self.js("document.querySelectorAll('#curves .line').length"), 5)

    def test_8_names_for_ears(self):
        self.assertEqual(self.js("[...document.querySelectorAll('input, select')].filter(e => !e.labels.length && "
                                 "!e.getAttribute('aria-label')).length"), 0)
        self.assertTrue(self.browser.until("document.getElementById('spoken').textContent.includes('Drawbar pull')"))

    def test_9_fits_a_phone_a_desk_and_the_dark(self):
        browser.assert_fits_a_phone_a_desk_and_the_dark(self, self.browser)
        self.assertEqual(self.browser.errors, [])


def take_pictures():
    PICTURES.mkdir(parents=True, exist_ok=True)
    setup = "#slip=33%25&yaw=10deg&effect=slip_sinkage"
    with Server("paper-straight", "--load", "4kN") as server:
        for name, width, dark, behind in (("phone", 360, False, setup), ("phone-dark", 360, True, setup),
                                          ("desk", 1600, False, setup), ("desk-dark", 1600, True, "#slip=150%25")):
            with browser.Browser(width, 1000, dark) as one:
                one.open(server.address + ("" if "150" in behind else behind))
                one.until("document.querySelectorAll('#curves .line').length === 5")
                if "150" in behind:
                    one.js(f"location.hash = '{behind}'")
                time.sleep(1)
                if name == "phone":  # what stands still while a finger moves
                    one.size(360, 740)
                    one.js("document.querySelector('.number').scrollIntoView({block: 'center'})")
                    one.picture(PICTURES / "phone-slider.png", whole=False)
                    one.js("scrollTo(0, 0)")
                one.picture(PICTURES / f"{name}.png")


if __name__ == "__main__":
    if PICTURES:
        take_pictures()
    else:
        unittest.main(verbosity=2)
