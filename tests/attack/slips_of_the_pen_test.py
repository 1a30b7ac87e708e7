"""Mistakes of a newcomer in a case, a campaign and at the command line: each message says what to type instead."""
import unittest

from attack import Attack

CASE = """format: soilbin-case/1
name: mine
tire: {radius: 110 mm, width: 100 mm}
soil: dry-sand
study:
  conditions: {load: 80 N, slip: 20 %}
"""
CAMPAIGN = """format: soilbin-campaign/1
name: rig
wheel: {radius: 150 mm, width: 120 mm}
soil: dry-sand
data: runs.csv
columns:
  Load: {quantity: load, unit: lbf}
  Slip: {quantity: slip, unit: "%"}
  Pull: {quantity: drawbar_pull, unit: lbf}
"""
ROWS = "Load,Slip,Pull\n18,5,-1.4\n18,20,0.6\n36,35,2.3\n"


class SlipsOfThePen(Attack):
    def expect_of_case(self, wrong, right, hint):
        (self.here / "mine.yaml").write_text(CASE.replace(right, wrong))
        self.expect(2, ["mine.yaml:", hint], "check", "mine.yaml")

    def expect_of_campaign(self, hint, yaml=("", ""), rows=("", "")):
        (self.here / "campaign.yaml").write_text(CAMPAIGN.replace(*yaml) if yaml[0] else CAMPAIGN)
        (self.here / "runs.csv").write_text(ROWS.replace(*rows) if rows[0] else ROWS)
        self.expect(2, hint, "check", "campaign.yaml")

    def test_a_file_that_is_no_yaml(self):
        for right, wrong, hint in (("  conditions", "\tconditions", "indent with blanks"),
                                   ("slip: 20 %}", "slip: 20 %", "'}' is missing"),
                                   ("load: 80 N", "load: [80 N", "']' is missing"),
                                   ("name: mine", "name:mine", "a blank is missing after ':'")):
            with self.subTest(hint=hint):
                self.expect_of_case(wrong, right, hint)

    def test_a_campaign(self):
        self.expect_of_campaign("in quotes, \"Run #\"", yaml=("  Load:", "  Load #:"))
        self.expect_of_campaign("put the percent sign in quotes", yaml=('"%"', "%"))
        self.expect_of_campaign("its columns: Load, Slip, Pull", yaml=("  Pull:", "  Depth: {quantity: sinkage, unit: mm}\n  Pull:"))
        self.expect_of_campaign("or leave it aside: ignored: [Remarks]", rows=("Pull\n", "Remarks\n"),
                                yaml=("  Pull:", "  Slip2:"))
        self.expect_of_campaign("a decimal point is '.': 4.4, not 4,4", rows=("-1.4", "-1,4"))
        self.expect_of_campaign("leave the cell empty", rows=("-1.4", "n.a."))

    def test_another_file_than_the_one_that_is_asked_for(self):
        (self.here / "mine").mkdir()
        (self.here / "mine/case.yaml").write_text(CASE)
        (self.here / "runs.csv").write_text(ROWS)
        (self.here / "runs.xlsx").write_bytes(b"PK\x03\x04")
        self.expect(2, "in it there is mine/case.yaml", "run", "mine")
        self.expect(2, "soilbin run, estimate or compare takes it", "predict", "mine/case.yaml")
        self.expect(2, "name its folder, or the campaign.yaml beside it", "loop", "runs.csv")
        self.expect(2, "export it as CSV", "plates", "runs.xlsx")

    def test_words_that_another_flag_means(self):
        self.expect(2, "--radius takes half of it", "estimate", "--diameter", "220mm")
        self.expect(2, "bekker_wong is the analytic wheel, dem the grains", "run", "rover-slip", "--model", "grains")
        self.expect(2, "these have: cmu-sand, cullinan-sand-24mm, nakanishi-sand", "run", "rover-slip", "--model", "dem", "--dry-run")


if __name__ == "__main__":
    unittest.main()
