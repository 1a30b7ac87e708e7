"""Whatever soilbin writes, soilbin reads: each output goes to the command that takes it, and none holds nan or inf."""
import csv
import http.client
import io
import json
import re
import unittest

from attack import BOARD, Attack

PLATES = "test,plate_diameter_mm,sinkage_mm,pressure_kPa\n"
WHEEL = ["estimate", "--tire", "paper-lugged"]
REST_OF_A_SOIL = """  cohesion: {value: 1 kPa, sd: 0.3 kPa}
  friction_angle: {value: 30 deg, sd: 2 deg}
  shear_modulus: {value: 15 mm, sd: 5 mm}
"""


def plates(pressure, sizes=(100, 150, 100, 150), extra=()):
    """Tests of these plates, every 2 mm to 16 mm; `extra` rows (sinkage, pressure) at the end of each."""
    text = PLATES
    for test, size in enumerate(sizes, 1):
        rows = [(z, pressure(size, z)) for z in range(2, 17, 2)] + list(extra)
        text += "".join(f"{test},{size},{z:.6g},{p:.6g}\n" for z, p in rows)
    return text


def bekker(n):
    """k_c 10 and k_phi 1000 at n = 1, as much pressure at 10 mm at another n."""
    return lambda size, z: (20 / size + 1) * 10 * (z / 10) ** n


# Clean, and as files are that have gone wrong.
PLATE_FILES = {
    "clean.csv": plates(bekker(1)), "steep.csv": plates(bekker(2.5)), "flat.csv": plates(bekker(0.2)),
    "as steep as one that was measured.csv": plates(bekker(3.57)),
    "one size.csv": plates(bekker(1), sizes=(100,) * 13), "once each.csv": plates(bekker(1), sizes=(100, 150)),
    "a sensor that sticks.csv": plates(bekker(1), (100, 150), [(16, p) for p in (25, 35, 45, 60, 80)]),
    "a spike.csv": plates(lambda size, z: bekker(1)(size, 240 if (size, z) == (100, 10) else z)),
    'na"me: {of} #a \'file\'.csv': plates(bekker(0.9)),
}


class WhatIsWritten(Attack):
    def strict(self, text):
        """JSON as RFC 8259 has it: json.loads takes NaN and Infinity else."""
        def refuse(word):
            self.fail(f"{word} in JSON")
        return json.loads(text, parse_constant=refuse)

    def no_empty_words(self, text):
        self.assertIsNone(re.search(r"(?i)(?<![\w.])-?(nan|inf|infinity)(?![\w])", text), text)

    def answer(self, *words, status=0, **more):
        found, out, err = self.soilbin(*words, **more)
        self.assertEqual(found, status, f"{words}: {out}{err}")
        self.no_empty_words(out)
        return out

    def taken(self, case):
        """A case is valid, and a wheel can be asked on it."""
        self.answer("check", case)
        return self.answer("run", case)

    def test_lines_of_plates_make_a_soil(self):
        for name, text in PLATE_FILES.items():
            with self.subTest(file=name):
                (self.here / name).write_text(text)
                self.strict(self.answer("plates", name, "--json"))
                out = self.answer("plates", name)
                lines = out.split("For campaign.yaml or a soil file:\n\n")[1]
                rft = out.split("For the model rft, in a soil file:\n\n")[1].split("\n\n")[0]
                soil = self.here / "soil.yaml"
                soil.write_text(f"format: soilbin-soil/1\nname: of plates\nsemi_empirical:\n{lines}{REST_OF_A_SOIL}{rft}\n")
                self.answer("check", soil)
                self.answer(*WHEEL, "--soil", soil, "--load", "50N", "--slip", "20%")

    def test_no_lines_of_plates_that_no_soil_takes(self):
        (self.here / "p.csv").write_text(plates(bekker(7)))
        out = self.answer("plates", "p.csv")
        self.assertIn("None for a file: a soil file takes n from 0.05 to 5.", out)
        self.assertNotIn("exponent:", out)

    def test_the_case_of_a_study_is_the_study(self):
        for study in ("rover-slip", "paper-straight"):
            with self.subTest(study=study):
                first = self.answer("run", study, "--output", "first")
                self.assertEqual(self.taken(self.here / "first/case.yaml"), first)
                self.answer("run", self.here / "first/case.yaml", "--output", "again")
                for name in ("case.yaml", "results.csv"):
                    self.assertEqual((self.here / "first" / name).read_text(), (self.here / "again" / name).read_text())
                self.strict((self.here / "first/results.json").read_text())
                document = self.strict(self.answer("run", study, "--json"))
                (self.here / "of-json.yaml").write_text(document["case"])
                self.taken(self.here / "of-json.yaml")

    def test_what_init_writes_is_checked_run_and_predicted(self):
        self.answer("init", "case")
        self.taken(self.here / "case/case.yaml")
        self.answer("init", "campaign", "--campaign")
        self.answer("check", "campaign")
        self.strict(self.answer("predict", "campaign", "--json"))

    def test_a_saved_model_is_a_case_and_predicts(self):
        self.answer("loop", "made-lesson", "--folds", "2", "--save-model", "model.yaml", within=300)
        self.answer("check", "model.yaml")
        self.strict(self.answer("predict", "made-lesson", "--model", "model.yaml", "--json"))
        self.strict(self.answer("estimate", "model.yaml", "--load", "60N", "--slip", "10%", "--json"))

    def test_a_design_takes_measured_values_and_is_a_campaign(self):
        campaign = self.here / "campaign"
        self.answer("init", "campaign", "--campaign")
        self.answer("design", campaign, "--runs", "12", "--csv", "design.csv")
        runs = next(campaign.glob("*.csv"))
        channels = next(csv.reader(io.StringIO(runs.read_text())))
        header, *rows = list(csv.reader(io.StringIO((self.here / "design.csv").read_text())))
        self.assertEqual(len(rows), 12)
        names = header + [name for name in channels if name not in header]
        filled = [dict(zip(header, row)) for row in rows]
        with open(runs, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, names)
            writer.writeheader()
            for number, row in enumerate(filled):
                writer.writerow({name: row.get(name) or f"{1 + 0.1 * number:.3f}" for name in names})
        self.answer("check", campaign)

    def test_a_record_answers_and_is_merged_and_shown(self):
        out, _ = self.expect(0, [], *self.grains("--record", "one.json"))
        self.strict(out)
        self.strict((self.here / "one.json").read_text())
        self.strict(self.answer("run", self.case, "--model", "dem", "--recorded", "one.json", "--json"))
        self.answer("record", "show", "one.json")
        self.answer("record", "merge", "two.json", "one.json")
        self.strict(self.answer("run", self.case, "--model", "dem", "--recorded", "two.json", "--json"))

    def test_a_calibrated_soil_is_a_soil(self):
        status, out, err = self.soilbin(*BOARD, "--output", "calibrated.yaml")
        self.assertIn(status, (0, 1), err)  # 1: no candidate is near enough, and the nearest is written
        self.strict(out)
        self.answer("check", "calibrated.yaml")

    def test_the_live_page_gives_a_case_and_strict_json(self):
        process = self.start("serve", "--port", "0", "paper-straight", "--load", "4kN")
        port = int(process.stdout.readline().strip().rstrip("/").rsplit(":", 1)[1])

        def ask(target):
            line = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
            line.request("GET", target)
            reply = line.getresponse()
            text = reply.read().decode()
            line.close()
            self.assertEqual(reply.status, 200, text)
            return text

        for query in ("", "?soil=dry-sand&load=80N", "?effect=slip_sinkage&exponent=1.2%2B-0.1"):
            with self.subTest(query=query):
                (self.here / "page.yaml").write_text(ask("/case.yaml" + query))
                self.taken(self.here / "page.yaml")
                self.strict(ask("/estimate" + (query or "?") + "&slip=20%25"))
                self.no_empty_words(ask("/curves.csv" + query))
        self.strict(ask("/case"))

    def test_soils_of_the_library_survive_an_answer(self):
        """Each soil's values, as an answer writes them, are the same soil."""
        names = [soil["name"] for soil in self.strict(self.answer("list", "soils", "--json"))["soils"]]
        self.assertGreater(len(names), 5)
        for name in names:
            with self.subTest(soil=name):
                status, out, err = self.soilbin(*WHEEL, "--soil", name, "--load", "60N", "--slip", "10%", "--json")
                self.assertIn(status, (0, 1, 2), err)
                if status == 2:  # a soil of grains alone
                    self.assertIn("semi_empirical", err)
                    continue
                document = self.strict(out)
                if "case" in document:
                    (self.here / "of.yaml").write_text(document["case"])
                    self.answer("check", self.here / "of.yaml")

    def test_numbers_at_the_edges_are_numbers_in_every_table(self):
        for load, slip in (("1e-6N", "0%"), ("60N", "-100%"), ("60N", "100%"), ("1e9N", "10%")):
            with self.subTest(load=load, slip=slip):
                status, out, err = self.soilbin(*WHEEL, "--soil=dry-sand", "--load", load, f"--slip={slip}", "--json")
                self.assertIn(status, (0, 1), err)
                if out:
                    self.strict(out)
        self.answer("run", "rover-slip", "--csv", "table.csv")
        self.no_empty_words((self.here / "table.csv").read_text())


if __name__ == "__main__":
    unittest.main()
