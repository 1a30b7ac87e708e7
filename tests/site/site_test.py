"""The site of the documents in a real browser: its theme runs without an error, dark for who prefers dark, and its button
changes the background. Two pages are enough for that; docs/site/make, in ./check --full, makes all of them.

Usage: site_test.py PROJECT_ROOT [--pictures DIR]     skipped (exit status 77) without Chromium, Sphinx or Furo
"""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tests/report"))
import browser  # noqa: E402

PICTURES = Path(sys.argv.pop(1)) if "--pictures" in sys.argv[1:2] and sys.argv.pop(1) else None
PAGES = ("README", "docs/theory/wheel")
LIGHT, DARK = "rgb(255, 255, 255)", "rgb(19, 20, 22)"  # Furo's own
BACKGROUND = "getComputedStyle(document.body).backgroundColor"


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        wanted = ",".join(f"{page}.md" for page in PAGES)
        subprocess.run([sys.executable, "-m", "sphinx", "-q", "-E", "-b", "html", "-c", str(ROOT / "docs/site"), "-D",
                        f"include_patterns={wanted}", "-d", f"{cls.folder.name}/.doctrees", str(ROOT), cls.folder.name],
                       check=True, stderr=subprocess.DEVNULL, env=os.environ | {"LC_ALL": "C.UTF-8"})
        cls.tab = browser.Browser(1400, 900)

    @classmethod
    def tearDownClass(cls):
        cls.tab.__exit__()
        cls.folder.cleanup()

    def open(self, page):
        self.tab.open(f"{self.folder.name}/{page}.html")
        self.assertEqual(self.tab.errors, [], page)
        self.assertEqual([a for a in self.tab.addresses if not a.startswith((f"file://{self.folder.name}", "data:"))], [])

    def test_the_background_is_what_the_reader_prefers_and_the_button_changes_it(self):
        for scheme, own, other in (("light", LIGHT, DARK), ("dark", DARK, LIGHT)):
            self.tab.scheme(scheme)
            for width in (1400, 500):
                self.tab.size(width, 900)
                for page in PAGES:
                    self.open(page)
                    self.assertEqual(self.tab.js(BACKGROUND), own, f"{page}, {scheme}")
                    if PICTURES:
                        self.tab.picture(PICTURES / f"site-{Path(page).name}-{scheme}-{width}.png", whole=False)
                seen = []
                for _ in range(3):  # to the other, to one's own by choice, back to what the reader prefers
                    self.tab.js("[...document.querySelectorAll('.theme-toggle')].find(b => b.offsetParent).click()")
                    seen.append(self.tab.js(BACKGROUND))
                self.assertEqual(seen, [other, own, own])
                self.assertEqual(self.tab.errors, [])

    def test_the_style_that_evens_out_browsers_is_there(self):
        self.open(PAGES[0])
        self.assertEqual(self.tab.js("getComputedStyle(document.body).margin"), "0px")  # of normalize.css; 8px without it

    def test_the_place_in_the_page_is_marked_in_its_contents(self):
        self.tab.size(1400, 900)
        self.open(PAGES[1])
        self.tab.js("document.querySelectorAll('article h2')[1].scrollIntoView()")
        self.assertTrue(self.tab.until("document.querySelector('.toc-tree .scroll-current') !== null"))


if __name__ == "__main__":
    needed = (browser.find(), *map(importlib.util.find_spec, ("sphinx", "furo", "myst_parser")))
    if not all(needed):
        print("no Chromium, Sphinx or Furo: skipped")
        sys.exit(77)
    unittest.main(verbosity=2)
