"""What places that take no file, kills and links do to the files that a command writes."""
import json
import random
import stat
import time
import unittest

from attack import SMALL_MAP, SMALL_TABLE, Attack, files_in, limited


class Outputs(Attack):
    """Every place is tried before the work; what fails after it costs nobody the answer."""

    PLACES = [[*SMALL_TABLE, "--csv"], [*SMALL_TABLE, "--plot"], [*SMALL_TABLE, "--output"],
              ["run", "paper-straight", "--model", "dem", "--record"], ["run", "paper-straight", "--model", "dem", "--replay"],
              ["drive", "rover-climb", "--plot"], ["drive", "rover-climb", "--csv"], ["drive", "rover-climb", "--report"],
              ["loop", "cmu-smooth", "--report"], ["loop", "cmu-smooth", "--save-model"], ["predict", "cmu-smooth", "--plot"],
              ["compare", "paper-straight", "--recorded", "--report"], ["compare", "paper-straight", "--csv"],
              ["compare", "paper-straight", "--markdown"], ["report", "rover-slip", "--output"], ["reproduce", "--report"],
              ["element-test", "repose", "paper-sand", "--plot"], ["bevameter", "paper-sand", "--output"],
              ["calibrate", "paper-sand", "--store"], ["calibrate", "paper-sand", "--output"],
              [*SMALL_MAP, "--report"], [*SMALL_MAP, "--store"]]

    def test_a_place_that_takes_no_file_is_refused_before_any_work(self):
        (self.here / "file").write_text("in the way")
        for words in self.PLACES:
            with self.subTest(flag=" ".join(words)):
                before = files_in(self.here)
                out, _ = self.expect(2, "where a folder is to be", *words, "file/deep/x.svg", within=10)
                self.assertEqual(out, "")
                self.assertEqual(files_in(self.here), before)

    def test_where_one_may_not_write_too(self):
        self.skip_unless_nobody_can_run()
        locked = self.here / "locked"
        locked.mkdir(mode=0o555)
        for words in self.PLACES:
            with self.subTest(flag=" ".join(words)):
                self.expect(2, "you may write to", *words, "locked/x.svg", within=10, preexec_fn=self.as_nobody)

    def test_missing_folders_are_made_by_all_alike(self):
        for k, words in enumerate(([*SMALL_TABLE, "--csv"], [*SMALL_TABLE, "--plot"], ["report", "rover-slip", "--output"],
                                   ["predict", "cmu-smooth", "--plot"], ["compare", "rover-slip", "--no-loop", "--report"])):
            place = self.here / f"new{k}" / "deep" / "x.svg"
            self.expect(0, [], *words, place)
            self.assertGreater(place.stat().st_size, 100)

    def test_a_drawing_is_what_its_ending_says(self):
        begins = {"svg": b"<?xml", "png": b"\x89PNG\r\n\x1a\n", "pdf": b"%PDF-"}
        for ending, begin in begins.items():
            self.expect(0, [], *SMALL_TABLE, "--plot", f"x.{ending}")
            self.assertTrue((self.here / f"x.{ending}").read_bytes().startswith(begin), ending)
        width, height = (int.from_bytes((self.here / "x.png").read_bytes()[at:at + 4], "big") for at in (16, 20))
        self.assertGreater(min(width, height), 400)
        self.assertIn(b"%%EOF", (self.here / "x.pdf").read_bytes()[-16:])
        for name in ("x.jpg", "x", "x.svgz"):
            self.expect(2, ".svg, .png or .pdf", "run", "paper-straight", "--model", "dem", "--plot", name, within=10)
            self.assertFalse((self.here / name).exists())

    def test_a_file_that_grows_too_large_leaves_nothing_and_the_answer_is_printed(self):
        out, _ = self.expect(1, "File too large", *SMALL_TABLE, "--json", "--plot", "x.svg", preexec_fn=limited(FSIZE=2000))
        self.assertEqual(json.loads(out)["format"], "soilbin-run/1")
        self.assertEqual(files_in(self.here), ["case.yaml", "pebbles.yaml"])

    def test_a_hundred_kills_leave_whole_files_and_no_others(self):
        draw = random.Random(28)
        self.expect(0, [], *SMALL_TABLE, "--csv", "x.csv")
        right = (self.here / "x.csv").read_bytes()
        for _ in range(100):
            process = self.start(*SMALL_TABLE, "--csv", "x.csv", "--plot", "x.svg", "--output", "all")
            time.sleep(draw.uniform(0.0, 0.12))
            process.kill()
            process.communicate()
            self.assertEqual((self.here / "x.csv").read_bytes(), right)
        self.expect(0, [], *SMALL_TABLE, "--csv", "x.csv", "--plot", "x.svg", "--output", "all")
        self.assertLessEqual(set(files_in(self.here)), {"case.yaml", "pebbles.yaml", "x.csv", "x.svg", "all/case.yaml",
                                                        "all/results.csv", "all/results.json"})

    def test_a_file_keeps_its_permissions_and_a_link_stays_a_link(self):
        secret = self.here / "secret.csv"
        secret.write_text("old")
        secret.chmod(0o600)
        (self.here / "link.csv").symlink_to("secret.csv")
        self.expect(0, [], *SMALL_TABLE, "--csv", "link.csv")
        self.assertTrue((self.here / "link.csv").is_symlink())
        self.assertGreater(len(secret.read_text()), 100)
        self.assertEqual(stat.S_IMODE(secret.stat().st_mode), 0o600)

    def test_a_record_that_is_a_link_stays_one(self):
        (self.here / "far").mkdir()
        (self.here / "record.json").symlink_to("far/record.json")
        self.expect(0, [], *self.grains("--record", "record.json"))
        self.assertTrue((self.here / "record.json").is_symlink())
        self.assertEqual(json.loads((self.here / "far/record.json").read_text())["format"], "soilbin-recorded/1")


if __name__ == "__main__":
    unittest.main(verbosity=1)
