"""What tests do on a live page of `soilbin serve` in a browser."""
import sys
import unittest
from pathlib import Path

from server import Server

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "report"))
import browser  # noqa: E402


class LivePage(unittest.TestCase):
    """A class of tests on one page: `words` start its server, `drawn` holds once its first answer is drawn."""
    words, drawn = (), "true"

    @classmethod
    def setUpClass(cls):
        if not browser.find():
            raise unittest.SkipTest("no Chromium")
        cls.server = Server(*cls.words)
        cls.browser = browser.Browser()
        cls.open("")

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.server.stop()

    @classmethod
    def open(cls, behind):
        cls.browser.open("about:blank")
        cls.browser.open(cls.server.address + behind)
        assert cls.browser.until(cls.drawn), cls.browser.errors

    def js(self, expression):
        return self.browser.js(expression)

    def move(self, key, value, control="range"):
        """Sets a slider or box as a person does, and waits for the answer."""
        self.js(f"(e => {{ e.value = {value}; e.dispatchEvent(new Event('input')); }})(soilbin.live.numbers.get('{key}')"
                f".{'slider' if control == 'range' else 'box'})")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))

    def listed(self, title):
        return f"[...document.querySelectorAll('.chooser')].find(l => l.firstChild.textContent === '{title} ').querySelector('select')"

    def choose(self, title, value):
        self.js(f"(s => {{ s.value = '{value}'; s.dispatchEvent(new Event('change')); }})({self.listed(title)})")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))

    def reset(self):
        self.js("document.getElementById('reset').click()")
        self.assertTrue(self.browser.until("!soilbin.live.asking"))

    def command(self):
        return self.js("document.getElementById('command').textContent")

    def wheel(self):
        return self.js("document.querySelector('#ground svg').outerHTML")

    def pull(self):
        return self.js("document.querySelector('#curves .line').getAttribute('d')")
