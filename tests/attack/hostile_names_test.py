"""Names that are programs for whoever prints, quotes or writes them: shells, spreadsheets, terminals, pages, folders."""
import csv
import io
import os
import shlex
import subprocess
import unittest
from pathlib import Path

from attack import BED, PEBBLES, SOILBIN, Attack

STUDY = """format: soilbin-case/1
name: rover
tire: {radius: 90 mm, width: 110 mm}
soil: dry-sand
study:
  name: NAME
  models: [{model: bekker_wong, label: LABEL}]
  conditions: {load: 60 N, slip: 20 %}
"""


class HostileNames(Attack):
    def study(self, name="rover", label="plain", text=STUDY):
        self.case.write_text(text.replace("NAME", name).replace("LABEL", label))

    def test_a_name_is_one_line_without_control_characters(self):
        for name in (r'"x\ntouch PWNED\n#"', '|\n    x\n    touch PWNED', r'"a\tb"', r'"a\rb"'):
            self.study(name)
            self.expect(2, ["case.yaml:6", "a name is one line"], "run", self.case)
        for name in (r'"\e]0;owned\a"', r'"\x07"', r'"\x9b2J"', r'"\0"', r'"\x7f"'):
            self.study(name)
            self.expect(2, ["case.yaml:6", "control character"], "run", self.case)
            self.study(label=name)
            self.expect(2, "control character", "run", self.case)
        self.study("plain\x9b2J")
        self.expect(2, "control characters", "run", self.case)

    def test_no_file_drives_the_terminal(self):
        name = "x\x1b]0;owned\x07\u009b2J.yaml"
        _, err = self.expect(2, r"x\u001b]0;owned\u0007\u009b2J.yaml", "run", self.here / name)
        self.assertFalse(any(c in err for c in "\x1b\x07\u009b"), repr(err))
        swept = self.here / "swept"
        (swept / "logs").mkdir(parents=True)
        self.study_of_grains()
        self.expect(0, [], "sweep", self.case, *BED, "--on", "local", "--output", "swept")
        (swept / "logs/run-1.log").write_text("\x1b[2Jall is well\n")
        out, _ = self.expect(3, [], "sweep", "status", "swept")
        self.assertIn(r"\u001b[2Jall is well", out)
        self.assertNotIn("\x1b", out)

    def study_of_grains(self, name="pebbles"):
        text = self.case.read_text() if name is None else ""
        self.case.write_text(text or "format: soilbin-case/1\nname: pebbles\ntire: {radius: 150 mm, width: 100 mm}\n"
                             f"soil: pebbles.yaml\nstudy:\n  name: {name}\n  models: [dem]\n"
                             "  conditions: {load: 60 N, slip: 20 %, speed: 0.6 m/s}\n")

    def test_a_script_runs_nothing_but_its_jobs(self):
        stub = self.folder / "stub"
        stub.write_text("#!/bin/bash\nexit 0\n")
        stub.chmod(0o755)
        self.study_of_grains("'x$(touch PWNED)`touch PWNED`; touch PWNED @shards@ @merge@'")
        for output in ("o\ntouch PWNED\n#", "it's $(touch PWNED)", "NUMBER {} @beds@", "\\' ; touch PWNED"):
            self.expect(0, [], "sweep", self.case, *BED, "--on", "local", "--output", output)
            script = self.here / output / "sweep.sh"
            text = script.read_text()
            self.assertFalse(any(line.startswith("touch") for line in text.splitlines()), text)
            script.write_text(text.replace(f"soilbin={shlex.quote(SOILBIN)}", f"soilbin={shlex.quote(str(stub))}"))
            self.assertIn(str(stub), script.read_text())
            done = subprocess.run(["bash", str(script)], cwd=self.here, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), output)
            self.assertTrue((self.here / output / "logs/run-1.log").exists(), "xargs reached the script")
        self.assertEqual([p.name for p in self.folder.rglob("PWNED")], [])

    def test_the_usual_folder_of_a_sweep_is_here(self):
        self.study_of_grains("/../../esc")
        self.expect(0, [], "sweep", self.case, *BED, "--on", "local")
        self.assertTrue((self.here / "sweep--..-..-esc/sweep.sh").exists())
        self.assertFalse((self.folder / "esc").exists())

    def test_completion_expands_no_name_and_offers_no_heading(self):
        soils = self.folder / "cases/soils"
        soils.mkdir(parents=True)
        for name in ("$(touch PWNED)", "`touch PWNED`", "a; touch PWNED", "plain-sand"):
            (soils / (name + ".yaml")).write_text(PEBBLES)
        environment = self.environment(SOILBIN_CASES=str(self.folder / "cases"),
                                       PATH=f"{Path(SOILBIN).parent}:{os.environ['PATH']}")

        def completed(word):
            typed = ('eval "$(soilbin manual --bash-completion)"; COMP_WORDS=(soilbin estimate --soil "$1"); COMP_CWORD=3; '
                     '_soilbin; printf "%s\\n" "${COMPREPLY[@]}"')
            done = subprocess.run(["bash", "-c", typed, "bash", word], cwd=self.here, env=environment, text=True,
                                  capture_output=True, check=True)
            return done.stdout.split("\n")[:-1]
        self.assertEqual(completed("plain"), ["plain-sand"])
        offered = completed("")
        for word in offered:  # as the shell reads the line that is typed
            done = subprocess.run(["bash", "-c", f"printf '%s' {word}"], cwd=self.here, capture_output=True, text=True,
                                  check=True)
            self.assertIn(done.stdout + ".yaml", os.listdir(soils) + os.listdir(self.library() / "soils"))
        self.assertIn("dry-sand", offered)
        self.assertEqual(list(self.folder.rglob("PWNED")), [])

    @staticmethod
    def library():
        return Path(__file__).resolve().parents[2] / "cases"

    def test_a_label_is_no_formula_of_a_spreadsheet(self):
        for label in ("=cmd|' /C calc'!A0", "+1+cmd|'x'!A0", "-2+3", "@SUM(A1)"):
            self.study(label='"' + label + '"')
            self.expect(0, [], "run", self.case, "--csv", "out.csv")
            rows = list(csv.reader(io.StringIO((self.here / "out.csv").read_text())))
            self.assertEqual(rows[1][0], "'" + label)
        numbers = [float(cell) for cell in rows[1][1:] if cell.lstrip("-").replace(".", "").isdigit()]
        self.assertGreater(len(numbers), 5, "numbers stay numbers, negative ones too")

    def test_a_linked_page_brings_no_program(self):
        self.study()
        self.expect(0, [], "report", "rover-slip", "--output", "first.html")
        page = (self.here / "first.html").read_text()
        self.expect(0, [], "report", self.case, "--link", "first.html", "--output", "whole.html")
        self.assertEqual((self.here / "whole.html").read_text().count('class="card"'), 1)
        card = (self.here / "whole.html").read_text().split('class="card"')[1].split("</a>")[0]
        self.assertIn("<svg", card, "a page as it was written is shown with its drawing")
        begins = page.index('<svg class="plot"')
        attacks = [
            page[:begins] + '<svg class="plot" onload="alert(1)"' + page[begins + len('<svg class="plot"'):],
            page[:begins] + '<svg class="plot"><script>alert(1)</script><g/></svg>' + page[begins:],
            page[:begins] + '<svg class="plot"><path/onload="alert(1)"/></svg>' + page[begins:],
            page[:begins] + '<svg class="plot"><foreignObject><iframe src="//x"></iframe></foreignObject></svg>' + page[begins:],
            page[:begins] + '<svg class="plot"><path fill="url(//x/y)"/></svg>' + page[begins:],
            page.replace("<title>", "<title><img src=x onerror=alert(1)>"),
            page.replace('name="description" content="', 'name="description" content="<script>alert(1)</script>')]
        for attack in attacks:
            (self.here / "evil.html").write_text(attack)
            self.expect(0, [], "report", self.case, "--link", "evil.html", "--output", "whole.html")
            card = (self.here / "whole.html").read_text().split('class="card"')[1].split("</a>")[0]
            for program in ("onload", "<script", "<iframe", "<img", "url(//"):
                self.assertNotIn(program, card)


if __name__ == "__main__":
    unittest.main(verbosity=1)
