"""The page of `soilbin serve VEHICLE` in a real browser.

Usage: vehicle_page_test.py SOILBIN [--pictures DIR]     the tests are left out where no Chromium is installed
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


class VehiclePage(LivePage):
    drawn = "document.querySelectorAll('#curves .line').length >= 3"

    def rest(self):
        """Waits for what is asked once nothing moves."""
        self.assertTrue(self.browser.until("!soilbin.live.asking && soilbin.live.answer.in_full", 60))

    def now(self):
        return self.js("document.getElementById('now').textContent")

    def drive(self):
        self.js("delete document.documentElement.dataset.driven; document.getElementById('drive').click()")
        self.assertTrue(self.browser.until("document.documentElement.dataset.driven !== undefined", 60))

    def tick(self, axle):
        self.js(f"soilbin.live.axleBoxes.find(b => b.value === '{axle}').click()")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))


class ThePage(VehiclePage):
    words = ("rover", "--soil", "sandy-loam")

    def test_1_opens_without_errors_and_asks_for_nothing_elsewhere(self):
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([a for a in self.browser.addresses if not a.startswith(self.server.address)], [])
        self.assertIn("slip of the drive line", self.now())
        self.rest()
        self.assertRegex(self.now(), r"steepest down[0-9.]+ \u00b1 [0-9.]+ degsteepest across|[0-9.]+ \u00b1 [0-9.]+ degsteepest down")
        sections = self.js("[...document.querySelectorAll('#tables h2')].map(h => h.textContent).join()")
        self.assertIn("How steep", sections)
        self.assertIn("Wheel by wheel", sections)
        self.assertEqual(self.js("document.querySelectorAll('#ground .hub.driven').length"), 2)

    def test_2_each_number_moves_the_answer(self):
        shown = "JSON.stringify([soilbin.live.answer.state, soilbin.live.answer.sentences, soilbin.live.answer.key_figures])"
        for key, value in (("slope", 4), ("cross-slope", 5), ("speed", 0.2), ("pull", 20), ("mass", 60), ("power", 0.01),
                           ("centre-of-gravity-x", 0.5), ("centre-of-gravity-z", 0.9), ("cohesion", 3)):
            before = self.js(shown)
            self.move(key, value, "box" if key == "power" else "range")
            self.assertNotEqual(self.js(shown), before, key)
            self.assertIn(f"--{key}=", self.command())
        self.assertEqual(self.browser.errors, [])
        self.reset()

    def test_3_the_command_says_the_same_to_the_bit(self):
        self.move("slope", 3)
        self.choose("Drive line", "sides")
        self.rest()
        told = json.loads(soilbin(*shlex.split(self.command())[1:], "--json").stdout)
        self.assertEqual(told, {key: value for key, value in self.js("soilbin.live.answer").items() if key in told})
        self.reset()

    def test_3_the_rest_is_given_up_where_something_moves(self):
        self.rest()
        self.move("slope", 1)
        self.assertFalse(self.js("soilbin.live.answer.in_full"))
        time.sleep(0.3)  # now the rest is asked for
        began = time.perf_counter()
        self.move("slope", 2)
        self.assertLess(time.perf_counter() - began, 1.0)
        self.rest()
        self.assertIn("--slope=2deg", self.command())
        self.assertEqual(self.browser.errors, [])
        self.reset()

    def test_3_an_axle_rolls_freely(self):
        self.tick("front")
        self.assertIn("--driven=rear", self.command())
        self.assertEqual(self.js("document.querySelectorAll('#ground .hub.driven').length"), 1)
        self.tick("front")
        self.assertNotIn("--driven", self.command())
        self.reset()

    def test_3_a_centre_differential_is_offered_beside_drive_lines_that_take_one(self):
        hidden = f"{self.listed('Centre differential')}.parentNode.hidden"
        self.assertTrue(self.js(hidden), "the rover has a motor a wheel")
        self.choose("Drive line", "open_axles")
        self.assertFalse(self.js(hidden))
        self.choose("Centre differential", "open")
        self.assertIn("--centre-differential=open", self.command())
        self.choose("Drive line", "sides")
        self.assertTrue(self.js(hidden))
        self.assertNotIn("centre-differential", self.command())
        self.assertFalse(self.js("Boolean(soilbin.live.refused)"))
        self.reset()

    def test_3_one_axle_at_least_is_driven(self):
        self.tick("front")
        self.tick("rear")
        self.assertIn("no axle is driven", self.js("document.getElementById('say').textContent"))
        self.assertIn("--driven=rear", self.command())
        self.reset()
        self.assertEqual(self.js("soilbin.live.axleBoxes.every(box => box.checked)"), True)

    def test_4_the_address_holds_the_setup(self):
        self.move("slope", 6)
        self.tick("rear")
        self.assertTrue(self.browser.until("location.hash.includes('slope=6')"))
        command, hash_ = self.command(), self.js("location.hash")
        self.open(hash_)
        self.assertTrue(self.browser.until(f"document.getElementById('command').textContent === {json.dumps(command)}"))
        self.assertEqual(self.js("soilbin.live.numbers.get('slope').slider.value"), "6")
        self.assertEqual(self.js("soilbin.live.axleBoxes.map(box => box.checked).join()"), "true,false")
        self.reset()

    def test_5_what_does_not_travel_says_why_and_is_drawn_faint(self):
        self.move("slope", 40, "box")
        self.assertIn("It does not travel", self.now())
        self.assertIn("its wheels pull too little at any slip", self.js("document.getElementById('sentences').textContent"))
        self.assertEqual(self.js("document.querySelectorAll('#ground svg.ghost').length"), 1)
        self.assertTrue(self.js("document.getElementById('say').textContent") == "" or
                        not self.js("soilbin.live.refused"))
        self.reset()
        self.assertEqual(self.js("document.querySelectorAll('#ground svg.ghost').length"), 0)

    def test_5_a_soil_of_the_library(self):
        before = self.now()
        self.choose("Soil", "dry-sand")
        self.assertIn("dry-sand", self.js("document.getElementById('chosen').textContent"))
        self.assertNotEqual(self.now(), before)
        self.reset()

    def test_6_the_drive_is_played_and_read_at_any_time(self):
        self.move("slope", 5)
        self.drive()
        self.assertFalse(self.js("document.getElementById('in-time').hidden"))
        self.assertIn("It still travels", self.js("document.getElementById('driven').textContent"))
        self.assertEqual(self.js("document.getElementById('play').textContent"), "Pause")
        self.assertTrue(self.browser.until("soilbin.live.player.time > 0.3"))
        self.js("document.getElementById('play').click()")
        self.assertFalse(self.js("soilbin.live.player.playing"))
        self.js("(e => { e.value = 12; e.dispatchEvent(new Event('input')); })(document.getElementById('scrub'))")
        shown = self.js("document.getElementById('clock').textContent")
        samples = self.js("soilbin.live.drive.samples")
        at = min(range(len(samples["time_s"])), key=lambda i: abs(samples["time_s"][i] - 12))
        self.assertIn(f"12.0 s, {samples['travelled_m'][at]:.2f} m", shown)
        self.assertEqual(self.js("document.getElementById('drive-command').textContent"), self.command() + " --drive")
        drawn = self.js("document.querySelector('#ground svg').outerHTML")
        self.js("(e => { e.value = 13; e.dispatchEvent(new Event('input')); })(document.getElementById('scrub'))")
        self.assertNotEqual(self.js("document.querySelector('#ground svg').outerHTML"), drawn)
        self.js("document.getElementById('pace').value = '16'; document.getElementById('pace').dispatchEvent(new Event('change'));"
                "document.getElementById('play').click()")
        self.assertTrue(self.browser.until("soilbin.live.player.time === soilbin.live.player.last", 20))
        self.assertEqual(self.js("document.getElementById('play').textContent"), "Play")
        self.move("slope", 6)
        self.assertFalse(self.js("document.getElementById('outdated').hidden"))
        self.assertTrue(self.js("document.getElementById('play').hidden"))
        self.assertEqual(self.browser.errors, [])
        self.reset()

    def test_6_a_drive_that_is_refused_says_why(self):
        self.move("cross-slope", 5)
        self.drive()
        self.assertIn("cross slope", self.js("document.getElementById('say').textContent"))
        self.browser.errors.clear()  # the browser itself notes each status 400
        self.reset()

    def test_7_who_wants_less_motion_begins_it_by_hand(self):
        with browser.Browser(reduced_motion=True) as calm:
            calm.open(self.server.address)
            self.assertTrue(calm.until(self.drawn))
            calm.js("document.getElementById('drive').click()")
            self.assertTrue(calm.until("document.documentElement.dataset.driven !== undefined", 60))
            time.sleep(0.3)
            self.assertEqual(calm.js("[soilbin.live.player.time, soilbin.live.player.playing].join()"), "0,false")

    def test_8_what_a_person_takes_along(self):
        self.js("(window.saved = [], soilbin.saveFile = (name, content) => { window.saved.push([name, content]); }); 0")
        for figure in ("ground", "curves"):
            for take in ("svg", "csv", "json"):
                self.js(f"document.querySelector('#{figure} [data-take={take}]').click()")
        self.assertTrue(self.browser.until("window.saved.length === 6", 60))
        for link, begins in (("save-vehicle", "format: soilbin-vehicle-case/1"), ("save-csv", "slip,pull_N"),
                             ("save-csv-comma", "slip;pull_N")):
            text = self.js(f"fetch(document.getElementById('{link}').href).then(r => r.text())")
            self.assertIn(begins, text[:400])
        self.js("document.getElementById('keep').click()")
        lines = self.js("document.querySelectorAll('#curves .line').length")
        self.move("slope", 2)
        self.assertGreaterEqual(self.js("document.querySelectorAll('#curves .line').length"), lines)
        self.js("document.getElementById('keep').click()")
        self.reset()

    def test_8_names_for_ears(self):
        self.assertEqual(self.js("[...document.querySelectorAll('input, select')].filter(e => !e.labels.length && "
                                 "!e.getAttribute('aria-label')).length"), 0)
        self.assertTrue(self.browser.until("document.getElementById('spoken').textContent.includes('slip of the drive line')"))

    def test_9_fits_a_phone_a_desk_and_the_dark(self):
        browser.assert_fits_a_phone_a_desk_and_the_dark(self, self.browser)
        self.assertEqual(self.browser.errors, [])


class OfATruck(VehiclePage):
    words = ("truck",)

    def test_an_effect_goes_off(self):
        box = "[...document.querySelectorAll('.effect label')].find(l => l.textContent === 'multipass').firstChild"
        self.assertTrue(self.js(f"{box}.checked"))
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))
        self.assertIn("--effect=declared", self.command())
        self.reset()

    def test_5_what_the_tires_declare_is_on_and_goes_off(self):
        box = "[...document.querySelectorAll('.effect label')].find(l => l.textContent === 'tire flexibility').firstChild"
        self.assertTrue(self.js(f"{box}.checked"))
        before = self.now()
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && !{box}.checked"))
        self.assertIn("--rigid", self.command())
        self.assertNotEqual(self.now(), before)
        self.js(f"{box}.click()")
        self.assertTrue(self.browser.until(f"!soilbin.live.asking && {box}.checked"))
        self.assertEqual(self.now(), before)


def take_pictures():
    PICTURES.mkdir(parents=True, exist_ok=True)
    with Server("truck") as server:
        for width in (1400, 500):
            with browser.Browser(width, 1000) as one:
                one.open(server.address)
                one.until(VehiclePage.drawn)
                one.until("soilbin.live.answer && soilbin.live.answer.in_full", 60)
                one.picture(PICTURES / f"start-{width}.png")
                for name, behind in (("moved", "#slope=9deg&pull=6kN&cross-slope=6deg"), ("stays", "#slope=40deg")):
                    one.js(f"location.hash = '{behind}'")
                    time.sleep(1)
                    one.picture(PICTURES / f"{name}-{width}.png")
                one.js("location.hash = '#slope=12deg&soil=dry-sand'")
                time.sleep(1.5)
                one.js("document.getElementById('drive').click()")
                one.until("document.documentElement.dataset.driven !== undefined", 60)
                one.js("document.getElementById('play').click(); (e => { e.value = e.max / 2; e.dispatchEvent(new Event('input')); })"
                       "(document.getElementById('scrub'))")
                one.picture(PICTURES / f"drive-{width}.png")


if __name__ == "__main__":
    if PICTURES:
        take_pictures()
    else:
        unittest.main(verbosity=2)
